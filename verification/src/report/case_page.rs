//! The page of a case.

use super::history::Release;
use super::page::{Depth, escape, number, page, time};
use super::provenance::Provenance;
use super::sources::Files;
use super::{claims, fields, figures, ids, mathml, precision, sheets, subjects, tables};
use crate::case::Outcome;
use crate::claim::Test;
use crate::suite::Summary;
use std::fmt::Write as _;

/// Context of a page.
#[derive(Clone, Copy, Debug)]
pub struct Context<'a> {
    /// Previous and next case.
    pub neighbours: [Option<&'a str>; 2],
    /// Sources of the case.
    pub files: &'a Files,
    /// Releases of the history.
    pub releases: &'a [Release],
    /// Provenance of the run.
    pub run: &'a Provenance,
}

/// The page.
pub fn whole(outcome: &Outcome, context: Context<'_>) -> String {
    let record = &outcome.record;
    let ids = ids::unique(&record.claims);
    let mut body = links(outcome, context);
    let (heading, text) = split(outcome.case.readme);
    let _ = writeln!(body, "<h1>{}</h1>", escape(heading));
    body += &claims::summary(&Summary::from_claims(&record.claims), Depth::Below);
    body += &contents(outcome, context);
    let sketch = crate::sketches::draw(outcome.case.name);
    let sketch = sketch.map(|svg| figures::figure("sketch", "The problem", &svg, "")).unwrap_or_default();
    body += &figures::side_by_side(
        &(sketch + &fields::pictures(outcome.case.name) + &figures::case_figures(record)),
    );
    let _ = writeln!(body, "<article>\n{}</article>", mathml::html_of(text));
    let _ = writeln!(
        body,
        "<h2 id=\"all-claims\">Claims</h2>\n{}",
        claims::all(&record.claims, &ids, &before(outcome, context.releases))
    );
    body += &figures::order_figures(&record.claims, &ids);
    body += &costs(outcome);
    record.tables.iter().for_each(|table| body += &tables::free(table));
    body += &sheets::links(outcome.case.name, &record.sheets);
    if !record.notes.is_empty() {
        body += "<h2>Notes</h2>\n";
    }
    for note in &record.notes {
        let _ = writeln!(body, "<p>{}</p>", escape(note));
    }
    page(outcome.case.title(), Depth::Below, context.run, &body)
}

/// The title of a README and its text.
fn split(readme: &str) -> (&str, &str) {
    match readme.split_once('\n') {
        Some((first, rest)) if first.starts_with("# ") => (first[2..].trim(), rest),
        _ => ("", readme),
    }
}

/// Links of the page: subject, neighbours, scenes, sources, JSON.
fn links(outcome: &Outcome, context: Context<'_>) -> String {
    let name = outcome.case.name;
    let subject = subjects::subject(&subjects::all(), name);
    let [before, after] = context.neighbours;
    let neighbour = |name: Option<&str>, arrow: [&str; 2]| {
        name.map(|name| format!("<a href=\"{name}.html\">{}{name}{}</a>\n", arrow[0], arrow[1]))
    };
    let scenes: String = context
        .files
        .keys()
        .filter(|path| path.ends_with(".toml"))
        .map(|path| {
            let file = path.rsplit('/').next().unwrap_or(path);
            format!("<a href=\"../sources/{name}.html#{}\">{}</a>\n", ids::slug(path), escape(file))
        })
        .collect();
    let scenes = if scenes.is_empty() { String::new() } else { format!("scenes: {scenes}") };
    format!(
        "<p class=\"links\"><a href=\"../index.html#{}\">{}</a>\n{}{}<a href=\"../sources/{name}.html\">source</a>\n\
         <a href=\"{name}.json\">JSON</a>\n{scenes}</p>\n",
        ids::slug(&subject),
        escape(&subject),
        neighbour(before, ["← ", ""]).unwrap_or_default(),
        neighbour(after, ["", " →"]).unwrap_or_default(),
    )
}

/// Contents of the page, and the cost of the case.
fn contents(outcome: &Outcome, context: Context<'_>) -> String {
    let name = outcome.case.name;
    let before = context.releases.last().and_then(|r| Some((&r.tag, r.cases.get(name)?)));
    let before =
        before.map(|(tag, kept)| format!(" (at {}: {})", escape(tag), time(kept.wall))).unwrap_or_default();
    let orders = outcome.record.claims.iter().any(|j| matches!(j.claim.test, Test::Order(_)));
    let convergence = if orders { ", <a href=\"#convergence\">convergence</a>" } else { "" };
    format!(
        "<p class=\"small\">The case ran for {}{before}. On this page: \
         <a href=\"#all-claims\">claims</a>{convergence}.</p>\n",
        time(outcome.wall)
    )
}

fn costs(outcome: &Outcome) -> String {
    let diagrams = outcome.record.plots.iter().filter(|plot| plot.precision);
    let tables: String = diagrams
        .map(|diagram| format!("<h4>{}</h4>{}", escape(&diagram.title), precision::table(diagram)))
        .collect();
    if tables.is_empty() { tables } else { format!("<h2 id=\"costs\">Work and precision</h2>\n{tables}") }
}

/// Error and bound of each claim at the last release, where they differ from the current ones.
fn before(outcome: &Outcome, releases: &[Release]) -> Vec<String> {
    let ids = ids::unique(&outcome.record.claims);
    let last = releases.last().and_then(|r| Some((&r.tag, r.cases.get(outcome.case.name)?)));
    let Some((tag, kept)) = last else { return vec![String::new(); ids.len()] };
    let show = |value: Option<f64>| value.map_or("–".to_owned(), number);
    let words = |id: &String| match kept.claims.get(id) {
        Some(&(error, bound)) => format!("at {}: error {}, bound {}", escape(tag), show(error), show(bound)),
        None => format!("new since {}", escape(tag)),
    };
    ids.iter().map(words).collect()
}
