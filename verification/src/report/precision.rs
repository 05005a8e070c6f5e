//! Work and precision: all diagrams of errors against computational work, with the cost to reach given errors.

use super::figures;
use super::page::{Depth, escape, number, page, word};
use super::provenance::Provenance;
use crate::case::Outcome;
use asperity_output::figures::{Diagram, Series};

/// Errors for which the cost is reported.
const TARGETS: [f64; 3] = [1e-2, 1e-3, 1e-4];

/// The cost of an error along a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CostToReach {
    /// Between measured points, interpolated on logarithms.
    At(f64),
    /// The cheapest run is already more accurate and has this cost.
    Below(f64),
    /// No run reaches this accuracy.
    Never,
}

/// Smallest cost to reach an error along the curve, in the order of its points.
pub fn cost_to_reach(series: &Series, target: f64) -> CostToReach {
    let usable = |p: &&(f64, f64)| p.0 > 0.0 && p.1 > 0.0 && p.0.is_finite() && p.1.is_finite();
    let points: Vec<(f64, f64)> = series.points.iter().filter(usable).copied().collect();
    let cheapest = points.iter().copied().min_by(|a, b| a.1.total_cmp(&b.1));
    match cheapest {
        None => return CostToReach::Never,
        Some((error, cost)) if error <= target => return CostToReach::Below(cost),
        Some(_) => {}
    }
    let crossing = |pair: &[(f64, f64)]| {
        let ((e0, w0), (e1, w1)) = (pair[0], pair[1]);
        let inside = (e0 - target) * (e1 - target) <= 0.0 && e0 != e1;
        let part = (target / e0).ln() / (e1 / e0).ln();
        inside.then(|| w0 * (w1 / w0).powf(part))
    };
    let least = points.windows(2).filter_map(crossing).min_by(f64::total_cmp);
    least.map_or(CostToReach::Never, CostToReach::At)
}

/// True if errors are relative: their label has no unit except [-].
fn is_relative(diagram: &Diagram) -> bool {
    diagram.x_label.split_once('[').is_none_or(|(_, unit)| unit.starts_with("-]") || unit.starts_with("–]"))
}

/// The table of costs of a diagram.
pub fn table(diagram: &Diagram) -> String {
    let heads = if is_relative(diagram) { ["1 %", "0.1 %", "0.01 %"] } else { ["1e-2", "1e-3", "1e-4"] };
    let heads: String = heads.iter().map(|head| format!("<th class=\"number\">{head}</th>")).collect();
    let row = |series: &Series| {
        let cells: String = TARGETS.iter().map(|&target| cell(cost_to_reach(series, target))).collect();
        format!("<tr><td>{}</td>{cells}</tr>\n", escape(&series.name))
    };
    let rows: String = diagram.series.iter().map(row).collect();
    format!(
        "<table class=\"costs\"><caption>Cost to reach an error of 1, 0.1, 0.01 %: {}</caption>\n\
         <tr><th></th>{heads}</tr>\n{rows}</table>\n",
        escape(&diagram.y_label)
    )
}

fn cell(reached: CostToReach) -> String {
    let text = match reached {
        CostToReach::At(cost) => number(cost),
        CostToReach::Below(cost) => format!("≤ {}", number(cost)),
        CostToReach::Never => "–".to_owned(),
    };
    format!("<td class=\"number\">{text}</td>")
}

/// The page of all diagrams.
pub fn whole(outcomes: &[Outcome], run: &Provenance) -> String {
    let mut body = format!(
        "<h1>Work and precision</h1>\n<p>Methods are compared at equal error. The tables interpolate on \
         logarithms between runs; ≤ marks a method whose cheapest run is already more precise, – one without a \
         run as precise. {} depends on the machine; other work does not.</p>\n",
        word("wall", "Wall time", Depth::Top)
    );
    for outcome in outcomes {
        let diagrams: Vec<&Diagram> = outcome.record.plots.iter().filter(|plot| plot.precision).collect();
        if diagrams.is_empty() {
            continue;
        }
        let name = outcome.case.name;
        body += &format!(
            "<h2 id=\"{name}\"><a href=\"cases/{name}.html\">{}</a></h2>\n<div class=\"figures\">\n",
            escape(outcome.case.title())
        );
        for diagram in diagrams {
            body += &format!("<div>{}{}</div>\n", figures::diagram(diagram), table(diagram));
        }
        body += "</div>\n";
    }
    page("Work and precision", Depth::Top, run, &body)
}
