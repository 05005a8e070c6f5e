//! The HTML pages: self-contained, readable without a network and without scripts.

use super::coverage::{self, Cell};
use super::provenance::Provenance;
use crate::capability::Capability;
use crate::case::Outcome;
use crate::claim::{Evidence, Judged, Mark, Test, Verdict};
use crate::ledger::Table;
use crate::plot::Plot;
use crate::readme;
use crate::suite::Summary;
use std::fmt::Write as _;

const STYLE: &str = include_str!("style.css");

/// Escapes text for HTML.
pub fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            _ => out.push(c),
        }
    }
    out
}

/// A number as the report prints it: four significant digits, plain where that is short.
pub fn number(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    if (1e-2..1e5).contains(&size) {
        // Significant digits after the point: fewer for larger numbers.
        let decimals = (3 - size.log10().floor() as i32).max(0) as usize;
        let text = format!("{value:.decimals$}");
        return if text.contains('.') {
            text.trim_end_matches('0').trim_end_matches('.').to_owned()
        } else {
            text
        };
    }
    format!("{value:.3e}")
}

fn page(title: &str, body: &str) -> String {
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n\
         <style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n{body}</main>\n</body>\n</html>\n",
        escape(title)
    )
}

/// The first page: outcome, cases, coverage matrix.
pub fn index(outcomes: &[Outcome], run: &Provenance) -> String {
    let summary = Summary::of_all(outcomes);
    let mut body = String::from("<h1>asperity: verification</h1>\n");
    body += &summary_line(&summary);
    body += &format!(
        "<p class=\"small\">{} · {} · version {}{} · {} · {} threads · {} s</p>\n",
        escape(&run.date),
        if run.full { "all cases" } else { "quick cases" },
        escape(&run.version),
        if run.commit.is_empty() { String::new() } else { format!(", commit {}", escape(&run.commit)) },
        escape(&run.machine),
        run.threads,
        number(run.wall),
    );
    body += "<h2>Cases</h2>\n";
    body += &case_list(outcomes);
    body += "<h2>Coverage</h2>\n<p class=\"small\">Number of claims that hold, by capability and kind of evidence, and the \
             cases they stand in.</p>\n";
    body += &matrix(outcomes);
    page("asperity: verification", &body)
}

fn summary_line(summary: &Summary) -> String {
    let class = if summary.passes() { "good" } else { "bad" };
    let mut line = format!("<p class=\"summary {class}\">{summary}</p>\n");
    if summary.slack_unexplained + summary.thin > 0 {
        let _ = writeln!(
            line,
            "<p class=\"warn\">{} slack without a reason, {} thin</p>",
            summary.slack_unexplained, summary.thin
        );
    }
    line
}

fn case_list(outcomes: &[Outcome]) -> String {
    let mut rows = String::new();
    for outcome in outcomes {
        let summary = Summary::of(&outcome.record.claims);
        let class = if summary.passes() { "good" } else { "bad" };
        let _ = writeln!(
            rows,
            "<tr><td><a href=\"cases/{name}.html\">{name}</a></td><td>{}</td>\
             <td class=\"number\">{}</td><td class=\"number {class}\">{}</td><td class=\"number\">{}</td>\
             <td class=\"number\">{}</td><td class=\"number\">{} s</td></tr>",
            escape(page_title(outcome)),
            summary.hold,
            summary.disagree,
            summary.not_covered,
            worst(outcome).map_or("–".to_owned(), number),
            number(outcome.wall),
            name = outcome.case.name,
        );
    }
    format!(
        "<div class=\"wide\"><table>\n<tr><th>case</th><th></th><th class=\"number\">hold</th>\
         <th class=\"number\">disagree</th><th class=\"number\">not covered</th>\
         <th class=\"number\">largest error/bound</th><th class=\"number\">wall time</th></tr>\n{rows}</table></div>\n"
    )
}

fn worst(outcome: &Outcome) -> Option<f64> {
    let ratios = outcome.record.claims.iter().filter_map(|judged| judged.measured.map(|m| m.ratio));
    ratios.max_by(f64::total_cmp)
}

fn matrix(outcomes: &[Outcome]) -> String {
    let mut table = String::from("<div class=\"wide\"><table class=\"matrix\">\n<tr><th>capability</th>");
    for kind in Evidence::ALL {
        let _ = write!(table, "<th>{}</th>", kind.name());
    }
    table.push_str("</tr>\n");
    for &capability in Capability::ALL {
        let _ = write!(table, "<tr><td>{}</td>", escape(capability.title()));
        for cell in coverage::row(outcomes, capability) {
            table += &matrix_cell(&cell);
        }
        table.push_str("</tr>\n");
    }
    table + "</table></div>\n"
}

fn matrix_cell(cell: &Cell) -> String {
    if cell.hold + cell.disagree == 0 {
        return "<td class=\"none\">no evidence</td>".to_owned();
    }
    let links: Vec<String> =
        cell.cases.iter().map(|name| format!("<a href=\"cases/{name}.html\">{name}</a>")).collect();
    let bad = match cell.disagree {
        0 => String::new(),
        n => format!(" <span class=\"bad\">{n} disagree</span>"),
    };
    format!(
        "<td><b class=\"good\">{}</b>{bad}<div class=\"small\">{}</div></td>",
        cell.hold,
        links.join(", ")
    )
}

/// The page of one case, with its plots drawn.
pub fn case_page(outcome: &Outcome, plots: &[String]) -> String {
    let record = &outcome.record;
    let mut body =
        String::from("<p class=\"small\"><a href=\"../index.html\">all cases</a></p>\n<article>\n");
    let parser = pulldown_cmark::Parser::new_ext(outcome.case.readme, pulldown_cmark::Options::ENABLE_TABLES);
    pulldown_cmark::html::push_html(&mut body, parser);
    body.push_str("</article>\n<h2>Claims</h2>\n");
    body += &summary_line(&Summary::of(&record.claims));
    let _ = writeln!(body, "<p class=\"small\">The case ran for {} s.</p>", number(outcome.wall));
    body += &claims(&record.claims);
    for (plot, drawing) in record.plots.iter().zip(plots) {
        body += &figure(plot, drawing);
    }
    for table in &record.tables {
        body += &free_table(table);
    }
    if !record.notes.is_empty() {
        body.push_str("<h2>Notes</h2>\n");
    }
    for note in &record.notes {
        let _ = writeln!(body, "<p>{}</p>", escape(note));
    }
    page(page_title(outcome), &body)
}

fn claims(claims: &[Judged]) -> String {
    let mut table = String::from(
        "<div class=\"wide\"><table>\n<tr><th>quantity</th><th class=\"number\">value and reference</th>\
         <th class=\"number\">error</th><th class=\"number\">bound</th><th class=\"number\">error/bound</th>\
         <th>evidence</th><th>why this bound</th><th>cost</th></tr>\n",
    );
    for judged in claims {
        table += &claim_row(judged);
    }
    table + "</table></div>\n"
}

fn claim_row(judged: &Judged) -> String {
    let claim = &judged.claim;
    let (error, bound, ratio) = match &judged.measured {
        Some(m) => (number(m.error), number(m.bound) + scale(&claim.test), bar(m.ratio, judged.mark)),
        None => ("–".to_owned(), "–".to_owned(), "–".to_owned()),
    };
    let class = if judged.verdict == Verdict::Disagrees { " class=\"disagrees\"" } else { "" };
    let norm = if claim.norm.is_empty() { String::new() } else { format!("<br>{}", escape(&claim.norm)) };
    format!(
        "<tr{class}><td>{}<div class=\"small\">{}{norm}</div></td><td class=\"number\">{}</td>\
         <td class=\"number\">{error}</td><td class=\"number\">{bound}</td><td class=\"number\">{ratio}</td>\
         <td>{}</td><td>{}</td><td class=\"small\">{}</td></tr>\n",
        escape(&claim.quantity),
        verdict(judged),
        values(judged),
        evidence(judged),
        reason(judged),
        cost(judged),
    )
}

/// Unit of the bound, where it is not the unit of the value.
fn scale(test: &Test) -> &'static str {
    match test {
        Test::Relative { .. } => "<div class=\"small\">relative</div>",
        Test::Order(_) => "<div class=\"small\">in the order</div>",
        _ => "",
    }
}

fn verdict(judged: &Judged) -> String {
    match &judged.verdict {
        Verdict::Holds => "<span class=\"good\">holds</span>".to_owned(),
        Verdict::Disagrees => {
            format!("<b class=\"bad\">disagrees: {}</b>", escape(judged.problem.as_deref().unwrap_or("")))
        }
        Verdict::NotCovered(reason) => format!("not covered: {}", escape(reason)),
    }
}

fn bar(ratio: f64, mark: Option<Mark>) -> String {
    let class = match mark {
        _ if ratio > 1.0 || ratio.is_nan() => "bad",
        Some(Mark::Thin) => "warn",
        _ => "good",
    };
    let word = match mark {
        Some(Mark::Slack) => "<div class=\"small\">slack</div>",
        Some(Mark::SlackUnexplained) => "<div class=\"small warn\">slack, no reason given</div>",
        Some(Mark::Thin) => "<div class=\"small warn\">thin</div>",
        _ => "",
    };
    let width = if ratio.is_finite() { (100.0 * ratio).clamp(0.0, 100.0) } else { 100.0 };
    format!(
        "{}<div class=\"bar\"><i class=\"{class}\" style=\"width:{width:.1}%\"></i></div>{word}",
        number(ratio)
    )
}

fn values(judged: &Judged) -> String {
    let unit = &escape(&judged.claim.unit);
    match &judged.claim.test {
        Test::Absolute { values, references, .. } | Test::Relative { values, references, .. } => {
            pairs(values, references, unit)
        }
        Test::AtMost { value, .. } => format!("{} {unit}<div class=\"small\">at most</div>", number(*value)),
        Test::AtLeast { value, .. } => {
            format!("{} {unit}<div class=\"small\">at least</div>", number(*value))
        }
        Test::Order(order) => {
            let observed = order.observed().map_or("–".to_owned(), number);
            let mut text =
                format!("order {observed}<div class=\"small\">expected {}", number(order.expected));
            text.push_str(if order.or_better { " or better" } else { "" });
            if let Some(plateau) = &order.plateau {
                let _ = write!(text, "<br>{} floor {}", plateau.floor.name(), number(plateau.level));
            }
            for (level, order) in order.levels.iter().zip(order.pairwise()) {
                let order = order.map_or(String::new(), |order| format!(" ({})", number(order)));
                let _ = write!(text, "<br>{}: {}{order}", number(level.size), number(level.error));
            }
            text + "</div>"
        }
        Test::Count { value, expected } => format!("{value}<div class=\"small\">exactly {expected}</div>"),
        Test::NotRun { .. } | Test::NotCovered { .. } => "–".to_owned(),
    }
}

/// Values with their references; long lists show their first rows.
fn pairs(values: &[f64], references: &[f64], unit: &str) -> String {
    const SHOWN: usize = 4;
    let digits =
        |v: f64| if v.abs() < 1e6 && v.abs() > 1e-3 { format!("{v:.7}") } else { format!("{v:.7e}") };
    let rows: Vec<String> = values
        .iter()
        .zip(references)
        .take(SHOWN)
        .map(|(v, r)| format!("{} {unit}<div class=\"small\">{}</div>", digits(*v), digits(*r)))
        .collect();
    let more = if values.len() > SHOWN {
        format!("<div class=\"small\">and {} more</div>", values.len() - SHOWN)
    } else {
        String::new()
    };
    rows.concat() + &more
}

fn evidence(judged: &Judged) -> String {
    let claim = &judged.claim;
    let kind = claim.evidence.map_or("", Evidence::name);
    let uncertainty = if claim.uncertainty > 0.0 {
        format!("<br>uncertainty {} {}", number(claim.uncertainty), escape(&claim.unit))
    } else {
        String::new()
    };
    format!("{kind}<div class=\"small\">{}{uncertainty}</div>", escape(&claim.source))
}

fn reason(judged: &Judged) -> String {
    let claim = &judged.claim;
    let mut text = escape(&claim.because);
    if !claim.why_not_tighter.is_empty() {
        let _ = write!(text, "<div class=\"small\">not tighter: {}</div>", escape(&claim.why_not_tighter));
    }
    text
}

fn cost(judged: &Judged) -> String {
    let cost = &judged.claim.cost;
    let wall = cost.wall.map(|wall| format!("{} s", number(wall)));
    let work = cost
        .work
        .iter()
        .map(|(name, count)| format!("{} {}", number(*count), escape(&name.replace('_', " "))));
    wall.into_iter().chain(work).collect::<Vec<_>>().join("<br>")
}

fn figure(plot: &Plot, drawing: &str) -> String {
    let mut caption = escape(&plot.caption);
    for series in &plot.series {
        for failed in &series.failed {
            let (name, at) = (escape(&series.name), number(failed.x));
            let _ = write!(caption, "<br>× {name} at {at}: {}", escape(&failed.reason));
        }
    }
    let all = || plot.series.iter().flat_map(|s| &s.points);
    let left_out = all().filter(|&&p| !plot.drawable(p)).count();
    if left_out > 0 {
        let _ = write!(caption, "<br>{left_out} points cannot be drawn on these axes.");
    }
    format!(
        "<h3>{}</h3>\n<figure>{drawing}<figcaption>{caption}</figcaption></figure>\n",
        escape(&plot.title)
    )
}

fn free_table(table: &Table) -> String {
    let cells = |cells: &[String], tag: &str| -> String {
        cells.iter().map(|cell| format!("<{tag}>{}</{tag}>", escape(cell))).collect()
    };
    let rows: String = table.rows.iter().map(|row| format!("<tr>{}</tr>\n", cells(row, "td"))).collect();
    format!(
        "<h3>{}</h3>\n<div class=\"wide\"><table>\n<tr>{}</tr>\n{rows}</table></div>\n",
        escape(&table.title),
        cells(&table.head, "th")
    )
}

/// The title of a case's page: the README's, or the case's name.
fn page_title(outcome: &Outcome) -> &str {
    let title = readme::title(outcome.case.readme);
    if title.is_empty() { outcome.case.name } else { title }
}
