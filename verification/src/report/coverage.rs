//! The coverage matrix: which capability rests on which kind of evidence.

use crate::capability::Capability;
use crate::case::Outcome;
use crate::claim::{Evidence, Verdict};

/// One cell of the matrix.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Cell {
    /// Claims that hold.
    pub hold: usize,
    /// Claims that disagree.
    pub disagree: usize,
    /// Cases they stand in, in the order of the report.
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
