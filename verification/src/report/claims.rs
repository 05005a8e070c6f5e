//! Claims as blocks of a page: the comparison on top, reasons and sources folded.

use super::page::{Depth, escape, number, word};
use crate::claim::{Evidence, JudgedClaim, Mark, Test, Verdict};
use crate::suite::Summary;
use std::fmt::Write as _;

/// Values of a list that are shown unfolded.
const SHOWN: usize = 4;

/// Counts in a sentence, with links to the explanation of each term.
pub fn summary(summary: &Summary, depth: Depth) -> String {
    let class = if summary.passes() { "good" } else { "bad" };
    let mut text = format!("<p class=\"summary {class}\">{}</p>\n", escape(&summary.to_string()));
    let words = [("near", "near its tolerance", summary.thin), ("loose", "loose", summary.slack_unexplained)];
    let words = words.iter().filter(|(_, _, count)| *count > 0);
    let words: Vec<String> = words.map(|(anchor, text, _)| word(anchor, text, depth)).collect();
    if !words.is_empty() {
        let _ = writeln!(text, "<p class=\"warn\">{} ({})</p>", escape(&summary.remarks()), words.join(", "));
    }
    text
}

/// All claims of a case with their permalinks and a remark on each claim's values at the last release.
pub fn all(claims: &[JudgedClaim], ids: &[String], before: &[String]) -> String {
    claims.iter().zip(ids).zip(before).map(|((judged, id), before)| one(judged, id, before)).collect()
}

fn one(judged: &JudgedClaim, id: &str, before: &str) -> String {
    let claim = &judged.claim;
    let state = match judged.verdict {
        Verdict::Holds => "holds",
        Verdict::Disagrees => "disagrees",
        Verdict::NotCovered(_) => "uncovered",
    };
    let norm = if claim.norm.is_empty() {
        String::new()
    } else {
        format!("<span class=\"small\">{}</span>", escape(&claim.norm))
    };
    format!(
        "<section class=\"claim {state}\" id=\"{id}\">\n<div class=\"what\"><h4>{} <a class=\"anchor\" \
         href=\"#{id}\" title=\"link to this claim\">#</a></h4>{norm}{}</div>\n<dl class=\"numbers\">{}</dl>\n\
         {}</section>\n",
        escape(&claim.quantity),
        verdict(judged),
        numbers(judged, id),
        details(judged, before),
    )
}

fn verdict(judged: &JudgedClaim) -> String {
    match &judged.verdict {
        Verdict::Holds => "<p class=\"good\">holds</p>".to_owned(),
        Verdict::Disagrees => {
            let problem = escape(judged.problem.as_deref().unwrap_or(""));
            format!("<p class=\"bad\"><b>disagrees: {problem}</b></p>")
        }
        Verdict::NotCovered(reason) => format!("<p>not covered: {}</p>", escape(reason)),
    }
}

fn entry(name: &str, value: &str) -> String {
    if value.is_empty() { String::new() } else { format!("<div><dt>{name}</dt><dd>{value}</dd></div>\n") }
}

fn numbers(judged: &JudgedClaim, id: &str) -> String {
    let claim = &judged.claim;
    let mut list = values(judged, id);
    if let Some(m) = &judged.measured {
        list += &entry("error", &number(m.error));
        list += &entry("bound", &format!("{}{}", number(m.bound), scale(&claim.test)));
        list += &entry("error / bound", &bar(m.ratio, judged.mark));
    }
    let kind = claim.evidence.map_or("", Evidence::name);
    list + &entry("evidence", &if kind.is_empty() { String::new() } else { word(kind, kind, Depth::Below) })
}

/// Unit of the bound if it differs from that of the value.
fn scale(test: &Test) -> &'static str {
    match test {
        Test::Relative { .. } => " <span class=\"small\">relative</span>",
        Test::Order(_) => " <span class=\"small\">in the order</span>",
        _ => "",
    }
}

fn bar(ratio: f64, mark: Option<Mark>) -> String {
    let class = match mark {
        _ if ratio > 1.0 || ratio.is_nan() => "bad",
        Some(Mark::Thin | Mark::SlackUnexplained) => "warn",
        _ => "good",
    };
    let width = if ratio.is_finite() { (100.0 * ratio).clamp(0.0, 100.0) } else { 100.0 };
    let remark = match mark {
        Some(Mark::Slack) => word("loose", "loose, with a reason", Depth::Below),
        Some(Mark::SlackUnexplained) => word("loose", "loose, without a reason yet", Depth::Below),
        Some(Mark::Thin) => word("near", "near its tolerance", Depth::Below),
        None => String::new(),
    };
    format!(
        "{}<span class=\"bar\"><i class=\"{class}\" style=\"width:{width:.1}%\"></i></span>\
         <span class=\"small\">{remark}</span>",
        number(ratio)
    )
}

fn values(judged: &JudgedClaim, id: &str) -> String {
    let unit = escape(&judged.claim.unit);
    let with_unit = |value: f64| format!("{} {unit}", number(value));
    match &judged.claim.test {
        Test::Absolute { values, references, .. } | Test::Relative { values, references, .. } => {
            entry("value", &list(values, &unit)) + &entry("reference", &list(references, &unit))
        }
        Test::AtMost { value, .. } => entry("value, at most the bound", &with_unit(*value)),
        Test::AtLeast { value, .. } => entry("value, at least the bound", &with_unit(*value)),
        Test::Order(order) => {
            let observed = order.observed().map_or("–".to_owned(), number);
            let better = if order.or_better { " or better" } else { "" };
            let figure = format!("<a href=\"#figure-{id}\">{observed}</a>");
            entry("observed order", &figure)
                + &entry("expected", &format!("{}{better}", number(order.expected)))
        }
        Test::Count { value, expected } => {
            entry("count", &value.to_string()) + &entry("exactly", &expected.to_string())
        }
        Test::NotRun { .. } | Test::NotCovered { .. } => String::new(),
    }
}

/// Values with seven digits; of long lists the first ones are shown.
fn list(values: &[f64], unit: &str) -> String {
    let digits =
        |v: &f64| if v.abs() < 1e6 && v.abs() > 1e-3 { format!("{v:.7}") } else { format!("{v:.7e}") };
    let shown: Vec<String> = values.iter().take(SHOWN).map(|v| format!("{} {unit}", digits(v))).collect();
    match values.len().saturating_sub(SHOWN) {
        0 => shown.join("<br>"),
        more => format!("{}<br><span class=\"small\">and {more} more</span>", shown.join("<br>")),
    }
}

/// Reasons, sources and costs, folded.
fn details(judged: &JudgedClaim, before: &str) -> String {
    let claim = &judged.claim;
    let uncertainty = if claim.uncertainty > 0.0 {
        format!("{} {}", number(claim.uncertainty), escape(&claim.unit))
    } else {
        String::new()
    };
    let list = [
        entry("why this bound", &escape(&claim.because)),
        entry("why not tighter", &escape(&claim.why_not_tighter)),
        entry("source of the reference", &escape(&claim.source)),
        entry("its uncertainty", &uncertainty),
        entry("levels", &levels(&claim.test)),
        entry("cost", &cost(judged)),
        entry("last release", before),
        entry("covers", &covers(judged)),
    ]
    .concat();
    if list.is_empty() {
        return String::new();
    }
    format!("<details><summary>reason, source, cost</summary><dl>{list}</dl></details>\n")
}

fn levels(test: &Test) -> String {
    let Test::Order(order) = test else { return String::new() };
    let pairs = order.levels.iter().zip(order.pairwise());
    let lines: Vec<String> = pairs
        .map(|(level, between)| {
            let between = between.map_or(String::new(), |order| format!(" (order {})", number(order)));
            format!("{}: {}{between}", number(level.size), number(level.error))
        })
        .collect();
    lines.join("<br>")
}

fn covers(judged: &JudgedClaim) -> String {
    let link = |c: &crate::Capability| {
        let title = c.title();
        format!("<a href=\"../coverage.html#{}\">{}</a>", super::ids::slug(title), escape(title))
    };
    judged.claim.covers.iter().map(link).collect::<Vec<_>>().join(", ")
}

fn cost(judged: &JudgedClaim) -> String {
    let cost = &judged.claim.cost;
    let wall = cost.wall.map(|wall| format!("{} s", number(wall)));
    let words = |name: &str| name.split('_').collect::<Vec<_>>().join(" ");
    let work = cost.work.iter().map(|(name, count)| format!("{} {}", number(*count), escape(&words(name))));
    wall.into_iter().chain(work).collect::<Vec<_>>().join(", ")
}
