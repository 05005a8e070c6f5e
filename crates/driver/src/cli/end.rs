//! Outcomes of a command.

/// Outcome of a command.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum End {
    /// Completed as requested.
    Done,
    /// The stepper stopped early; everything up to then was written.
    Stopped(String),
    /// The result does not agree with its benchmark.
    Differs,
    /// Input that cannot be read.
    Unreadable(String),
    /// Interrupted by a signal or by the limit of wall time.
    Interrupted(String),
}
