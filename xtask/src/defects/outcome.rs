//! Results of the suite for planted defects.

use crate::stage::Failure;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

/// File of the results, from the root of the workspace.
pub const RESULTS: &str = "verification/defects/results.json";

/// Status of building and running the suite.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// The suite ran.
    #[default]
    Ran,
    /// The changed source does not build.
    DoesNotBuild,
    /// A run was killed because it took too long.
    DoesNotEnd,
}

/// A claim that failed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FailedClaim {
    /// Name of the case.
    pub case: String,
    /// Quantity of the claim.
    pub claim: String,
    /// Error over bound; `None` if no error was computed.
    pub margin: Option<f64>,
}

/// The result of a defect.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// Commit of the sources.
    pub commit: String,
    /// Hash of the tree of that commit.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub tree: String,
    /// Hashes of the files that the defect touches, by their paths: the result is stale once one of them has changed.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub files: BTreeMap<String, String>,
    /// Status of the run.
    pub status: Status,
    /// Cases that ran; empty for all quick cases.
    pub cases: Vec<String>,
    /// Claims that failed.
    pub noticed: Vec<FailedClaim>,
    /// Tests that failed; `None` if they were not run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tests: Option<Vec<String>>,
}

/// Results by the names of the defects.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Results(BTreeMap<String, Outcome>);

impl Results {
    /// Reads the results stored in the workspace; empty if there is no file.
    pub fn read(root: &Path) -> Result<Self, Failure> {
        let path = root.join(RESULTS);
        match std::fs::read_to_string(&path) {
            Ok(text) => Self::parse(&text).map_err(|source| Failure::Report { path, source }),
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(Self::default()),
            Err(source) => Err(Failure::Read { path, source }),
        }
    }

    /// Reads results from their text.
    pub fn parse(text: &str) -> Result<Self, serde_json::Error> {
        serde_json::from_str(text)
    }

    /// The result of a defect.
    pub fn get(&self, name: &str) -> Option<&Outcome> {
        self.0.get(name)
    }

    /// Names of the defects.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.keys().map(String::as_str)
    }

    /// The results with that of a defect added or replaced.
    #[must_use]
    pub fn with(mut self, name: &str, outcome: Outcome) -> Self {
        self.0.insert(name.to_owned(), outcome);
        self
    }

    /// Stores the results in the workspace.
    pub fn write(&self, root: &Path) -> Result<(), Failure> {
        let path = root.join(RESULTS);
        let text = serde_json::to_string_pretty(self)
            .map_err(|source| Failure::Report { path: path.clone(), source })?;
        std::fs::write(&path, text + "\n").map_err(|source| Failure::Read { path, source })
    }
}

impl Outcome {
    /// True if a claim failed.
    pub fn is_noticed(&self) -> bool {
        !self.noticed.is_empty()
    }

    /// Adds the failed claims of a report.
    pub fn add(&mut self, report: &Path) -> Result<(), Failure> {
        let text = std::fs::read_to_string(report)
            .map_err(|source| Failure::Read { path: report.to_owned(), source })?;
        let value: Value = serde_json::from_str(&text)
            .map_err(|source| Failure::Report { path: report.to_owned(), source })?;
        self.noticed.extend(disagreeing(&value));
        Ok(())
    }

    /// Summary of the result: for each case the number of failed claims and the largest margin.
    pub fn words(&self) -> String {
        let mut parts: Vec<String> = Vec::new();
        match self.status {
            Status::Ran => {}
            Status::DoesNotBuild => parts.push("does not build".into()),
            Status::DoesNotEnd => parts.push("a run did not end".into()),
        }
        let mut cases: Vec<&str> = self.noticed.iter().map(|n| n.case.as_str()).collect();
        cases.dedup();
        for case in cases {
            let of: Vec<&FailedClaim> = self.noticed.iter().filter(|n| n.case == case).collect();
            let margin = of.iter().filter_map(|n| n.margin).fold(0.0, f64::max);
            parts.push(format!("{case}: {} ({margin:.1e})", of.len()));
        }
        if parts.is_empty() { "NOT NOTICED".into() } else { parts.join(", ") }
    }
}

/// Failed claims of a report.
fn disagreeing(report: &Value) -> Vec<FailedClaim> {
    let list = |value: &Value| value.as_array().cloned().unwrap_or_default();
    let mut found = Vec::new();
    for case in list(&report["cases"]) {
        for claim in list(&case["claims"]).iter().filter(|c| c["verdict"] == "disagrees") {
            let margin = match (claim["measured"]["error"].as_f64(), claim["measured"]["bound"].as_f64()) {
                (Some(error), Some(bound)) if bound > 0.0 => Some(error / bound),
                _ => None,
            };
            found.push(FailedClaim {
                case: case["name"].as_str().unwrap_or_default().to_owned(),
                claim: claim["quantity"].as_str().unwrap_or_default().to_owned(),
                margin,
            });
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::{Outcome, disagreeing};
    use serde_json::json;

    #[test]
    fn claims_that_disagree_are_found_with_their_margin() {
        let measured = json!({ "error": 3.0, "bound": 0.5 });
        let holds = json!({ "verdict": "holds", "measured": measured, "quantity": "p" });
        let off = json!({ "verdict": "disagrees", "measured": measured, "quantity": "q" });
        let found = disagreeing(&json!({ "cases": [{ "name": "hertz_line", "claims": [holds, off] }] }));
        let outcome = Outcome { noticed: found, ..Outcome::default() };
        assert!(outcome.is_noticed());
        assert_eq!(outcome.words(), "hertz_line: 1 (6.0e0)");
    }

    #[test]
    fn a_defect_that_no_claim_notices_says_so() {
        let outcome = Outcome::default();
        assert_eq!(outcome.words(), "NOT NOTICED");
    }
}
