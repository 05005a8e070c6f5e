//! Resolution of the length scales of friction by the points of a fault.

mod critical;
mod ground;

pub use critical::{Softening, critical_slope, softening};
pub(crate) use ground::check;
pub use ground::{Ground, GroundPoint, from_points, links, modulus, spacings};

use crate::shared::words::length;
use schemars::JsonSchema;
use serde::Serialize;

/// Points per cohesive zone below which a plan warns: three, to the printed digit. About as many are needed (S. M. Day et al., JGR 110 (2005),
/// B12307).
pub const FEW: f64 = 2.95;
/// Points per cohesive zone that help texts recommend.
pub const ENOUGH: f64 = 3.0;
/// Points per cohesive zone below which a scene is refused: each point then fails on its own, and events are artefacts of the mesh (Rice 1993).
pub const TOO_FEW: f64 = 1.0;

/// A length scale of friction at the point where it is resolved worst.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Coarsest {
    /// Length scale \[m\].
    pub length: f64,
    /// Distance of the point from its farthest neighbour in a cell \[m\].
    pub spacing: f64,
    /// Ratio of the length scale to that distance.
    pub points: f64,
    /// Position \[m\].
    pub at: [f64; 3],
    /// Distance along the fault from its upper end \[m\]; 0 in 3D.
    pub along: f64,
}

/// Resolution of a fault on which friction weakens.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Resolution {
    /// Fault.
    pub fault: String,
    /// Resolution of the cohesive zone.
    pub cohesive_zone: Coarsest,
    /// Resolution of the nucleation length.
    pub nucleation: Coarsest,
}

impl Resolution {
    /// Description for the plan.
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
    pub(crate) fn place(&self, in_space: bool) -> String {
        let [x, y, z] = self.at;
        if in_space {
            format!("({}, {}, {})", length(x), length(y), length(z))
        } else {
            format!("{} along it", length(self.along))
        }
    }
}
