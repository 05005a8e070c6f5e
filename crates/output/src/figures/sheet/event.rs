//! Events with figures of their own.

use serde::{Deserialize, Serialize};

/// An event with figures of its own.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct EventOnset {
    /// Number, from 0.
    pub number: usize,
    /// Onset \[s\].
    pub onset: f64,
}
