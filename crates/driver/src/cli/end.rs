//! End of a command.

/// End of a command.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum End {
    /// As asked.
    Done,
    /// The stepper stopped early; everything until then was written.
    Stopped(String),
    /// Ended by a signal or its wall time.
    Interrupted(String),
}
