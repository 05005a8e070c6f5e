//! Quantities along a line through time.

use serde::{Deserialize, Serialize};

/// Quantity along a line through time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum MappedQuantity {
    /// log10 of the slip rate \[m/s\].
    Rate,
    /// log10 of the state θ \[s\].
    Theta,
    /// First state variable of a law without θ.
    State,
    /// Coupling to the motion of plates, between events.
    Coupling,
}

impl MappedQuantity {
    /// Last part of the file name.
    pub(super) fn stem(self) -> &'static str {
        match self {
            Self::Rate => "rate",
            Self::Theta | Self::State => "state",
            Self::Coupling => "coupling",
        }
    }

    /// Words of the title and label of the colours.
    pub(super) fn words(self) -> (&'static str, &'static str) {
        match self {
            Self::Rate => ("slip rate", "log₁₀ of slip rate [m/s]"),
            Self::Theta => ("state θ", "log₁₀ of θ [s]"),
            Self::State => ("state variable", "State variable [–]"),
            Self::Coupling => ("coupling between events", "Coupling [–], below 0 as 0"),
        }
    }
}
