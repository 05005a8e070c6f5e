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
    /// The plan has so many warnings, and none were to be accepted.
    Doubtful(usize),
    /// Input that cannot be read.
    Unreadable(String),
    /// Interrupted by a signal or by the limit of wall time.
    Interrupted(String),
}

impl End {
    /// Exit code of the program.
    #[must_use]
    pub fn code(&self) -> u8 {
        match self {
            Self::Done => 0,
            Self::Differs | Self::Doubtful(_) => 1,
            Self::Stopped(_) | Self::Unreadable(_) => 2,
            Self::Interrupted(_) => 3,
        }
    }
}
