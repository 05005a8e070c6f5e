//! A case and its execution.

use crate::capability::Capability;
use crate::ledger::{Ledger, Record};
use crate::readme;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

/// Reason why a case could not complete: any error type, so that `?` works on all of them.
pub type CaseError = Box<dyn std::error::Error + Send + Sync>;

/// A case of the suite.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Name of the case and of its folder under `verification/cases`.
    pub name: &'static str,
    /// README of the case, shown on its page of the report.
    pub readme: &'static str,
    /// Capabilities for which its claims are evidence, unless a claim names others.
    pub covers: &'static [Capability],
    /// True if the case belongs to the quick suite (seconds); the others run only with `--full`.
    pub quick: bool,
    /// Function that computes and makes the claims.
    pub run: fn(&mut Ledger) -> Result<(), CaseError>,
}

/// Result of running a case.
#[derive(Debug)]
pub struct Outcome {
    /// The case.
    pub case: Case,
    /// Record of the case.
    pub record: Record,
    /// Wall time \[s\].
    pub wall: f64,
}

impl Case {
    /// Title of the README, or the name of the case.
    pub fn title(&self) -> &'static str {
        let title = readme::title(self.readme);
        if title.is_empty() { self.name } else { title }
    }

    /// Runs the case. An error, a panic and a run without claims each become one claim that disagrees; earlier claims are kept.
    pub fn execute(&self) -> Outcome {
        let start = Instant::now();
        let mut ledger = Ledger::new(self.covers);
        let end = catch_unwind(AssertUnwindSafe(|| (self.run)(&mut ledger)));
        match end {
            Ok(Ok(())) if ledger.is_empty() => ledger.did_not_run("the case recorded no claim"),
            Ok(Ok(())) => {}
            Ok(Err(error)) => ledger.did_not_run(&chain(error.as_ref())),
            Err(payload) => ledger.did_not_run(&format!("panicked: {}", panic_message(payload.as_ref()))),
        }
        Outcome { case: *self, record: ledger.finish(), wall: start.elapsed().as_secs_f64() }
    }

    /// Outcome of a case that could not be run to its end, after a time \[s\]: one claim that disagrees.
    pub fn lost(&self, why: &str, wall: f64) -> Outcome {
        let mut ledger = Ledger::new(self.covers);
        ledger.did_not_run(why);
        Outcome { case: *self, record: ledger.finish(), wall }
    }
}

/// The error with its chain of sources.
fn chain(error: &(dyn std::error::Error + 'static)) -> String {
    let mut text = error.to_string();
    let mut source = error.source();
    while let Some(cause) = source {
        text.push_str(": ");
        text.push_str(&cause.to_string());
        source = cause.source();
    }
    text
}

fn panic_message(payload: &(dyn std::any::Any + Send)) -> &str {
    let text = payload.downcast_ref::<&str>().copied();
    text.or_else(|| payload.downcast_ref::<String>().map(String::as_str)).unwrap_or("without a message")
}
