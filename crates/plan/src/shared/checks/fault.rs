//! Checks of a fault.

use super::MachineCheck;
use crate::shared::resolution::Resolution;
use schemars::JsonSchema;
use serde::Serialize;

/// Points and lengths of a fault.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct FaultCheck {
    /// Fault.
    pub fault: String,
    /// Points that slide by the law.
    pub points: usize,
    /// Points that creep at a prescribed rate, or are locked.
    pub prescribed: usize,
    /// Area of the points that slide \[m²; m per metre of thickness\].
    pub area: f64,
    /// Points at which friction weakens with slip.
    pub weakening_points: usize,
    /// Their area \[m²; m per metre of thickness\].
    pub weakening_area: f64,
    /// Smallest and largest distance of a point from its farthest neighbour \[m\].
    pub spacing: [f64; 2],
    /// Cells per cohesive zone and per nucleation length where they are fewest, if friction weakens.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub resolution: Option<Resolution>,
    /// Smallest and largest radiation damping \[Pa s/m\].
    pub damping: [f64; 2],
    /// Profiles of its parameters.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub profiles: Vec<ProfileCheck>,
    /// Its patches, in the order of the scene.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub patches: Vec<PatchCheck>,
    /// Its stations.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub stations: Vec<StationCheck>,
    /// Mean rate of shear traction when loads first act, positive along `rate`; absent if loads do not shear it, or if its bodies
    /// have mass \[Pa/s\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub loading: Option<f64>,
    /// Springs that drive it, if there are any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub machine: Option<MachineCheck>,
}

/// Points of a profile.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ProfileCheck {
    /// Parameter.
    pub key: String,
    /// Sliding points between its ends.
    pub points: usize,
    /// Sliding points beyond them, which have the value of the nearer end.
    pub beyond: usize,
}

/// Points of a patch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct PatchCheck {
    /// Sliding points in the patch.
    pub points: usize,
    /// Sliding points in its edge.
    pub edge: usize,
}

/// A station and its point.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct StationCheck {
    /// Requested coordinates, or the distance along the fault \[m\].
    pub requested: Vec<f64>,
    /// Position of the nearest point that slides \[m\].
    pub at: [f64; 3],
    /// Distance between the two \[m\].
    pub off: f64,
}
