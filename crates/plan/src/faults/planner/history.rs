//! Loads of faults through a run.

use asperity_cycles::Loading;

/// Loads of faults until the end of a run.
#[derive(Clone, Copy)]
pub(super) struct LoadHistory<'a> {
    pub loading: &'a Loading,
    /// End of the run \[s\].
    pub end: f64,
}
