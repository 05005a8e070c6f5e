//! Selection of cases, and the outcome of the suite.

use crate::case::{Case, Outcome};
use crate::claim::{JudgedClaim, Mark, Verdict};
use crate::glob;
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt;

/// Selection of cases.
#[derive(Clone, Debug, Default)]
pub struct Selection {
    /// True if long cases are included.
    pub full: bool,
    /// Pattern that the names of cases must match.
    pub glob: Option<String>,
}

/// Reason why a selection has no cases.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SelectionError {
    /// The list of cases is empty.
    #[error("there is no case to run: a suite without cases is no evidence")]
    NoCases,
    /// The pattern matches no case.
    #[error("no case matches `{pattern}`; there are: {}", .names.join(", "))]
    NoMatch {
        /// The pattern.
        pattern: String,
        /// Names of all cases.
        names: Vec<String>,
    },
    /// All selected cases are long.
    #[error("only long cases are chosen ({}); add --full to run them", .names.join(", "))]
    OnlyLong {
        /// Names of the selected cases.
        names: Vec<String>,
    },
}

impl Selection {
    /// The selected cases, in the order of the list.
    ///
    /// # Errors
    /// If no case is selected.
    pub fn select<'a>(&self, cases: &'a [Case]) -> Result<Vec<&'a Case>, SelectionError> {
        if cases.is_empty() {
            return Err(SelectionError::NoCases);
        }
        let fits =
            |case: &&Case| self.glob.as_deref().is_none_or(|pattern| glob::matches(pattern, case.name));
        let named: Vec<&Case> = cases.iter().filter(fits).collect();
        if named.is_empty() {
            let pattern = self.glob.clone().unwrap_or_default();
            return Err(SelectionError::NoMatch { pattern, names: names(&cases.iter().collect::<Vec<_>>()) });
        }
        let chosen: Vec<&Case> = named.iter().copied().filter(|case| self.full || case.quick).collect();
        if chosen.is_empty() {
            return Err(SelectionError::OnlyLong { names: names(&named) });
        }
        Ok(chosen)
    }
}

fn names(cases: &[&Case]) -> Vec<String> {
    cases.iter().map(|case| case.name.to_owned()).collect()
}

/// Counts of claims by outcome.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Summary {
    /// Claims that hold.
    pub hold: usize,
    /// Claims that disagree.
    pub disagree: usize,
    /// Quantities not covered.
    pub not_covered: usize,
    /// Claims whose bound is slack without a reason.
    pub slack_unexplained: usize,
    /// Claims with an error close to the bound.
    pub thin: usize,
}

impl Summary {
    /// Counts claims.
    pub fn from_claims<'a>(claims: impl IntoIterator<Item = &'a JudgedClaim>) -> Summary {
        let mut summary = Summary::default();
        for claim in claims {
            match claim.verdict {
                Verdict::Holds => summary.hold += 1,
                Verdict::Disagrees => summary.disagree += 1,
                Verdict::NotCovered(_) => summary.not_covered += 1,
            }
            match claim.mark {
                Some(Mark::SlackUnexplained) => summary.slack_unexplained += 1,
                Some(Mark::Thin) => summary.thin += 1,
                Some(Mark::Slack) | None => {}
            }
        }
        summary
    }

    /// Counts the claims of all outcomes.
    pub fn from_outcomes(outcomes: &[Outcome]) -> Summary {
        Summary::from_claims(outcomes.iter().flat_map(|outcome| &outcome.record.claims))
    }

    /// Remarks on slack and thin bounds, in a sentence; empty if there are none.
    pub fn remarks(&self) -> String {
        let near = match self.thin {
            0 => None,
            1 => Some("1 check within 20 % of its tolerance".to_owned()),
            n => Some(format!("{n} checks within 20 % of their tolerance")),
        };
        let loose = match self.slack_unexplained {
            0 => None,
            1 => Some("1 tolerance more than ten times looser than needed, without a reason yet".to_owned()),
            n => Some(format!("{n} tolerances more than ten times looser than needed, without a reason yet")),
        };
        near.into_iter().chain(loose).collect::<Vec<_>>().join("; ")
    }

    /// True if the suite passes: there are claims, and none disagrees.
    pub fn passes(&self) -> bool {
        self.disagree == 0 && self.hold > 0
    }
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "claims: {} hold, {} disagree, {} not covered", self.hold, self.disagree, self.not_covered)
    }
}
