//! Reasons why a file cannot be used.

/// Reason why a file has not the numbers that are asked for, and what would be right.
#[derive(Debug)]
pub struct Wrong {
    /// Message.
    pub message: String,
    /// Help.
    pub help: String,
}

impl Wrong {
    pub(crate) fn new(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { message: message.into(), help: help.into() }
    }
}
