//! Progress of a run into a stage.

use serde::{Deserialize, Serialize};

/// Progress of a run into its present stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Phase {
    /// The first stage has not begun.
    First,
    /// A later stage has not begun.
    Between,
    /// The stage has begun.
    Within,
}

impl Phase {
    /// Phase where the conditions of a stage are applied.
    #[must_use]
    pub fn at_conditions(self) -> Self {
        if self == Self::Within { Self::Between } else { self }
    }
}
