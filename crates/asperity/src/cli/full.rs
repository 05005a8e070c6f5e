//! Ends of runs for want of room to write.

use super::end::End;
use asperity_run::report::Status;
use std::io::{self, ErrorKind};

/// Advice where a run can be resumed.
const RESUMES: &str = "free some, and the same command with --resume resumes it at its last checkpoint";
/// Advice where it cannot.
const BEGINS: &str =
    "there was no checkpoint yet, so that nothing can be resumed: free some, and run it again";

/// Beginning of the reason in the report of a run that found no room to write.
pub(super) const REASON: &str = "no room to write: ";

/// True if the system refused to write because the disk is full, a quota is used up, or a file may not become larger (`ulimit -f`).
#[must_use]
pub fn is_full(error: &miette::Report) -> bool {
    let kind =
        |cause: &(dyn std::error::Error + 'static)| cause.downcast_ref::<io::Error>().map(io::Error::kind);
    let full = [ErrorKind::StorageFull, ErrorKind::QuotaExceeded, ErrorKind::FileTooLarge];
    error.chain().filter_map(kind).any(|kind| full.contains(&kind))
}

/// End of a run that found no room to write, with its status and the reason for the report.
#[must_use]
pub fn end(error: &miette::Report, resumable: bool) -> (End, Status, String) {
    let reason = format!("{REASON}{}", root(error));
    if resumable {
        return (End::Interrupted(format!("interrupted: {reason}; {RESUMES}")), Status::Interrupted, reason);
    }
    let reason = format!("{reason}; {BEGINS}");
    (End::Stopped(reason.clone()), Status::Stopped, reason)
}

/// All messages of an error, of which the last is that of the system.
fn root(error: &miette::Report) -> String {
    // Most errors repeat the message of their cause.
    let mut words = String::new();
    for cause in error.chain().map(ToString::to_string) {
        if !words.contains(&cause) {
            words = if words.is_empty() { cause } else { format!("{words}: {cause}") };
        }
    }
    words
}
