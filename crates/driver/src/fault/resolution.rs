//! Resolution of the lengths of friction by the points of a fault.

use super::words::length;
use schemars::JsonSchema;
use serde::Serialize;

/// Points to a cohesive zone below which a plan warns: three, to the digit that is printed; about as many are needed (S. M. Day et al., JGR 110 (2005), B12307).
pub const FEW: f64 = 2.95;
/// Points to a cohesive zone that help texts ask for.
pub const ENOUGH: f64 = 3.0;
/// Points to a cohesive zone below which a scene is refused: each point then breaks by itself, and events are those of the mesh (Rice 1993).
pub const TOO_FEW: f64 = 1.0;

/// A length of friction at the point where the points stand coarsest beside it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Coarsest {
    /// The length \[m\].
    pub length: f64,
    /// Distance of the point from the farthest of its neighbours in a cell \[m\].
    pub spacing: f64,
    /// The length over that distance.
    pub points: f64,
    /// Position \[m\].
    pub at: [f64; 3],
    /// Distance along the fault from its upper end \[m\]; 0 in space.
    pub along: f64,
}

/// Resolution of a fault, where friction weakens on it.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Resolution {
    /// Fault.
    pub fault: String,
    /// Over the cohesive zone.
    pub cohesive_zone: Coarsest,
    /// Over the length of nucleation.
    pub nucleation: Coarsest,
}

impl Resolution {
    /// In words, for the plan.
    #[must_use]
    pub fn words(&self, in_space: bool) -> String {
        let (zone, nucleation) = (&self.cohesive_zone, &self.nucleation);
        format!(
            "fault `{}`: {:.1} points to the cohesive zone ({} at {}) and {:.1} to the length of nucleation ({}), where they are fewest",
            self.fault,
            zone.points,
            length(zone.length),
            zone.place(in_space),
            nucleation.points,
            length(nucleation.length)
        )
    }
}

impl Coarsest {
    pub(super) fn place(&self, in_space: bool) -> String {
        let [x, y, z] = self.at;
        if in_space {
            format!("({}, {}, {})", length(x), length(y), length(z))
        } else {
            format!("{} along it", length(self.along))
        }
    }
}
