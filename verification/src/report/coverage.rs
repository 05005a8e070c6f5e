//! The coverage matrix: kinds of evidence for each capability.

use super::ids::slug;
use super::page::{Depth, escape, page, word};
use super::provenance::Provenance;
use super::read;
use super::test_files::Group;
use crate::capability::Capability;
use crate::case::Outcome;
use crate::claim::{Evidence, Verdict};
use crate::numbers::Number;

/// One cell of the matrix.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Cell {
    /// Claims that hold.
    pub hold: usize,
    /// Claims that disagree.
    pub disagree: usize,
    /// Cases with these claims, in the order of the report.
    pub cases: Vec<&'static str>,
}

/// The cells of one capability, one for each of [`Evidence::ALL`].
pub fn row(outcomes: &[Outcome], capability: Capability) -> Vec<Cell> {
    Evidence::ALL.iter().map(|&kind| cell(outcomes, capability, kind)).collect()
}

fn cell(outcomes: &[Outcome], capability: Capability, kind: Evidence) -> Cell {
    let mut cell = Cell::default();
    for outcome in outcomes {
        let claims = &outcome.record.claims;
        for judged in
            claims.iter().filter(|j| j.claim.evidence == Some(kind) && j.claim.covers.contains(&capability))
        {
            match judged.verdict {
                Verdict::Holds => cell.hold += 1,
                Verdict::Disagrees => cell.disagree += 1,
                Verdict::NotCovered(_) => continue,
            }
            if cell.cases.last() != Some(&outcome.case.name) {
                cell.cases.push(outcome.case.name);
            }
        }
    }
    cell
}

/// The page of the matrix. Tests are evidence where no case can make a claim.
pub fn whole(outcomes: &[Outcome], (groups, numbers): (&[Group], &[Number]), run: &Provenance) -> String {
    let mut body = format!(
        "<h1>Coverage</h1>\n<p>Number of {} that hold, by {} and kind of evidence, and the cases that make them. \
         Capabilities without a number have no evidence in this run.</p>\n",
        word("claim", "claims", Depth::Top),
        word("capability", "capability", Depth::Top)
    );
    for &capability in Capability::ALL {
        body += &entry(capability, &row(outcomes, capability), groups);
    }
    body += &read::section(numbers, outcomes);
    page("Coverage", Depth::Top, run, &body)
}

fn entry(capability: Capability, cells: &[Cell], groups: &[Group]) -> String {
    let title = capability.title();
    let kinds = Evidence::ALL.iter().zip(cells).filter(|(_, cell)| cell.hold + cell.disagree > 0);
    let claimed: String = kinds.map(|(kind, cell)| kind_of(*kind, cell)).collect();
    let group = groups.iter().find(|group| group.capability == capability && group.count() > 0);
    let tested = group.map_or(String::new(), |group| {
        format!(
            "<div><dt>tests</dt><dd><a href=\"tests.html#{}\"><b class=\"good\">{}</b></a></dd></div>\n",
            slug(title),
            group.count()
        )
    });
    let all = claimed + &tested;
    let all = if all.is_empty() { "<div class=\"none\">no evidence</div>\n".to_owned() } else { all };
    format!(
        "<section class=\"covered\" id=\"{}\"><h4>{}</h4><dl>{all}</dl></section>\n",
        slug(title),
        escape(title)
    )
}

fn kind_of(kind: Evidence, cell: &Cell) -> String {
    let links: Vec<String> =
        cell.cases.iter().map(|name| format!("<a href=\"cases/{name}.html\">{name}</a>")).collect();
    let bad = match cell.disagree {
        0 => String::new(),
        n => format!(" <b class=\"bad\">{n} disagree</b>"),
    };
    format!(
        "<div><dt>{}</dt><dd><b class=\"good\">{}</b>{bad} <span class=\"small\">{}</span></dd></div>\n",
        word(kind.name(), kind.name(), Depth::Top),
        cell.hold,
        links.join(", ")
    )
}
