//! A case, and running it.

use crate::capability::Capability;
use crate::ledger::{Ledger, Record};
use crate::readme;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

/// Reason why a case could not run to its end: any error, so that `?` works on all of them.
pub type CaseError = Box<dyn std::error::Error + Send + Sync>;

/// A case of the suite.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Name: that of its folder under `verification/cases`.
    pub name: &'static str,
    /// Its README, which is its page in the report.
    pub readme: &'static str,
    /// Capabilities its claims are evidence for, unless a claim names its own.
    pub covers: &'static [Capability],
    /// True if it belongs to the quick suite (seconds); the others run with `--full` only.
    pub quick: bool,
    /// Computes and claims.
    pub run: fn(&mut Ledger) -> Result<(), CaseError>,
}

/// Result of running a case.
#[derive(Debug)]
pub struct Outcome {
    /// The case.
    pub case: Case,
    /// Its record.
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

    /// Runs the case. An error, a panic and silence each become one claim that disagrees; what was recorded before stays.
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
}

/// The error with its sources.
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
