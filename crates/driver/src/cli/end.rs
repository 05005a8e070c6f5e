//! Outcomes of a command.

/// Outcome of a command.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum End {
    /// Completed as requested.
    Done,
    /// The stepper stopped early; everything up to then was written.
    Stopped(String),
    /// Interrupted by a signal or by the limit of wall time.
    Interrupted(String),
}
