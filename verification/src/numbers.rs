//! Numbers that users read in the files of a run, and the claims that would notice a wrong one.

use crate::case::Outcome;
use crate::claim::Verdict;
use crate::glob;
use std::collections::BTreeMap;

/// The list, by kind of run, file and number.
const LIST: &str = include_str!("../numbers.toml");

/// A number in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Number {
    /// Kind of run.
    pub kind: String,
    /// Name of the file.
    pub file: String,
    /// Name of the column, array or entry.
    pub name: String,
    /// Cases, and patterns of the quantities of their claims.
    pub claims: Vec<(String, String)>,
}

/// All numbers.
///
/// # Errors
/// If the list cannot be read.
pub fn all() -> Result<Vec<Number>, String> {
    type Files = BTreeMap<String, BTreeMap<String, BTreeMap<String, Vec<String>>>>;
    let list: Files = toml::from_str(LIST).map_err(|e| e.to_string())?;
    let mut all = Vec::new();
    for (kind, files) in list {
        for (file, numbers) in files {
            for (name, claims) in numbers {
                let split = |claim: &String| {
                    let (case, quantity) = claim.split_once(": ").ok_or(format!("no case in `{claim}`"))?;
                    Ok::<_, String>((case.to_owned(), quantity.to_owned()))
                };
                let claims = claims.iter().map(split).collect::<Result<_, _>>()?;
                all.push(Number { kind: kind.clone(), file: file.clone(), name, claims });
            }
        }
    }
    Ok(all)
}

impl Number {
    /// Claims of a run of the suite about this number that hold, by their cases.
    #[must_use]
    pub fn held(&self, outcomes: &[Outcome]) -> BTreeMap<&'static str, usize> {
        let mut held = BTreeMap::new();
        for outcome in outcomes {
            let patterns = self.claims.iter().filter(|(case, _)| case == outcome.case.name);
            let patterns: Vec<&str> = patterns.map(|(_, quantity)| quantity.as_str()).collect();
            let claims = outcome.record.claims.iter().filter(|j| j.verdict == Verdict::Holds);
            let own = claims.filter(|j| patterns.iter().any(|p| glob::matches(p, &j.claim.quantity))).count();
            if own > 0 {
                held.insert(outcome.case.name, own);
            }
        }
        held
    }

    /// Patterns that fit no claim of a case that has run.
    #[must_use]
    pub fn unknown(&self, outcomes: &[Outcome]) -> Vec<String> {
        let fits = |outcome: &Outcome, quantity: &str| {
            outcome.record.claims.iter().any(|j| glob::matches(quantity, &j.claim.quantity))
        };
        let lost = |(case, quantity): &&(String, String)| {
            outcomes.iter().any(|o| o.case.name == case && !fits(o, quantity))
        };
        self.claims.iter().filter(lost).map(|(case, quantity)| format!("{case}: {quantity}")).collect()
    }
}
