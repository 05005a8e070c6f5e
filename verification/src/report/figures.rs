//! Figures of a page, drawn by the product's plots, each with a title and a caption.

use super::page::{escape, number};
use crate::claim::{JudgedClaim, Test};
use crate::ledger::{Picture, Record};
use asperity_output::figures::Diagram;
use std::fmt::Write as _;

/// Largest number of convergence figures of a case that are shown unfolded.
const UNFOLDED: usize = 9;

/// A figure with its title above the drawing.
pub fn figure(id: &str, title: &str, drawing: &str, caption: &str) -> String {
    let title = if title.is_empty() { String::new() } else { format!("<h4>{title}</h4>") };
    let caption =
        if caption.is_empty() { String::new() } else { format!("<figcaption>{caption}</figcaption>") };
    let id = if id.is_empty() { String::new() } else { format!(" id=\"{id}\"") };
    format!("<figure{id}>{title}{drawing}{caption}</figure>\n")
}

/// Figures side by side if there is room.
pub fn side_by_side(figures: &str) -> String {
    if figures.is_empty() { String::new() } else { format!("<div class=\"figures\">\n{figures}</div>\n") }
}

/// A diagram.
pub fn diagram(diagram: &Diagram) -> String {
    let drawn = Diagram { title: String::new(), ..diagram.clone() };
    figure("", &escape(&diagram.title), &drawn.svg(), &caption(diagram))
}

/// Caption of a diagram, with a note on points that could not be drawn.
fn caption(diagram: &Diagram) -> String {
    let mut caption = escape(&diagram.caption);
    for series in &diagram.series {
        for failed in &series.failed {
            let (name, at) = (escape(&series.name), number(failed.x));
            let _ = write!(caption, "<br>× {name} at {at}: {}", escape(&failed.reason));
        }
    }
    let all = || diagram.series.iter().flat_map(|s| &s.points);
    let left_out = all().filter(|&&(x, y)| !diagram.drawable(x, y)).count();
    if left_out > 0 {
        let _ = write!(caption, "<br>{left_out} points cannot be drawn on these axes.");
    }
    caption
}

/// Pictures and diagrams of a case.
pub fn case_figures(record: &Record) -> String {
    let pictures = record.pictures.iter().map(picture);
    let diagrams = record.plots.iter().map(diagram);
    pictures.chain(diagrams).collect()
}

/// A drawing provided by a case.
pub fn picture(picture: &Picture) -> String {
    figure("", &escape(&picture.title), &picture.svg, &escape(&picture.caption))
}

/// A convergence figure for each claim on an order; folded if there are many.
pub fn order_figures(claims: &[JudgedClaim], ids: &[String]) -> String {
    let one = |(judged, id): (&JudgedClaim, &String)| {
        let Test::Order(order) = &judged.claim.test else { return None };
        let diagram = super::convergence::diagram(&judged.claim, order);
        let title = format!("<a href=\"#{id}\">{}</a>", escape(&judged.claim.quantity));
        Some(figure(&format!("figure-{id}"), &title, &diagram.svg(), &caption(&diagram)))
    };
    let figures: Vec<String> = claims.iter().zip(ids).filter_map(one).collect();
    let all = side_by_side(&figures.concat());
    match figures.len() {
        0 => String::new(),
        n if n <= UNFOLDED => format!("<h2 id=\"convergence\">Convergence</h2>\n{all}"),
        n => format!(
            "<h2 id=\"convergence\">Convergence</h2>\n<details class=\"many\"><summary>{n} figures</summary>\n\
             {all}</details>\n"
        ),
    }
}
