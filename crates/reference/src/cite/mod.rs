//! Citations of the program, of a benchmark, and of the laws and methods that a scene declares.

pub mod benchmarks;
pub mod cases;
pub mod laws;
pub mod references;
pub mod scene;
pub mod titles;

pub use cases::{keys, names};
pub use references::{Reference, reference, references};
pub use scene::{scene_citations, slider_citations};

use std::fmt::Write as _;

/// Key of the program itself.
pub const PROGRAM: &str = "asperity";

/// References in the order in which they were asked for, each with the reasons for it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Citations(Vec<Citation>);

/// A reference and the reasons for it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Citation {
    /// Key in the table of references.
    pub key: &'static str,
    /// Reasons for citing it.
    pub reasons: Vec<String>,
}

impl Default for Citations {
    /// The program alone.
    fn default() -> Self {
        Self(vec![Citation { key: PROGRAM, reasons: vec!["the program".into()] }])
    }
}

impl Citations {
    /// Citations of a verification case; `None` if there is no such case.
    #[must_use]
    pub fn from_case(name: &str) -> Option<Self> {
        let mut citations = Self::default();
        for key in keys(name)? {
            citations.add(key, format!("literature of the case {name}"));
        }
        Some(citations)
    }

    /// Citations of a benchmark; `None` if there is no such benchmark.
    #[must_use]
    pub fn from_benchmark(name: &str) -> Option<Self> {
        let mut citations = Self::default();
        for key in benchmarks::keys(name)? {
            citations.add(key, format!("the benchmark {name}"));
        }
        Some(citations)
    }

    /// Adds a reference, or a reason for one that is there.
    pub fn add(&mut self, key: &'static str, reason: impl Into<String>) {
        let reason = reason.into();
        match self.0.iter_mut().find(|c| c.key == key) {
            Some(known) if known.reasons.contains(&reason) => {}
            Some(known) => known.reasons.push(reason),
            None => self.0.push(Citation { key, reasons: vec![reason] }),
        }
    }

    /// The citations in order.
    #[must_use]
    pub fn list(&self) -> &[Citation] {
        &self.0
    }

    /// BibTeX, with the reasons as comments above each entry.
    #[must_use]
    pub fn bibtex(&self) -> String {
        let mut text = String::new();
        for citation in &self.0 {
            for reason in &citation.reasons {
                let _ = writeln!(text, "% {reason}");
            }
            if let Some(reference) = reference(citation.key) {
                let _ = writeln!(text, "{}\n", reference.text);
            }
        }
        text
    }
}
