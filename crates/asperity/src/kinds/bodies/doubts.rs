//! Warnings about the results of a run of bodies.

use super::report::InterfaceResult;
use asperity_run::Warning;

/// Warnings about interfaces that were open at the end of every stage.
#[must_use]
pub fn never_closed(results: &[InterfaceResult]) -> Vec<Warning> {
    let mut names: Vec<&str> = results.iter().map(|r| r.interface.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    let open = |name: &&str| {
        let mut own = results.iter().filter(|r| r.interface == *name);
        own.all(|r| r.status[1] + r.status[2] == 0)
    };
    let told = |name: &str| {
        Warning::at(
            0..0,
            format!("interface `{name}` was open at the end of every stage and transmitted nothing"),
            "is the gap at the start right, and do the bodies move towards each other?",
        )
    };
    names.into_iter().filter(open).map(told).collect()
}
