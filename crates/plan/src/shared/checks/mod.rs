//! Checks of a plan: sizes, counts of points and lengths of friction, by which a wrong unit or an empty set shows before a run.

mod cost;
mod double_loads;
mod fault;
pub(crate) mod meetings;
pub(crate) mod model_checks;
pub mod rates;
mod words;

use crate::shared::resolution::{Coarsest, Softening};
use schemars::JsonSchema;
use serde::Serialize;

pub use cost::Cost;
pub use fault::{FaultCheck, PatchCheck, ProfileCheck, StationCheck};

/// Checks of a plan.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct Checks {
    /// True if surfaces have areas; false if they have lengths.
    pub in_space: bool,
    /// Bodies.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub bodies: Vec<BodyCheck>,
    /// Sets that the scene uses.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub sets: Vec<SetCheck>,
    /// Interfaces.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub interfaces: Vec<InterfaceCheck>,
    /// Faults.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub faults: Vec<FaultCheck>,
    /// Spring-sliders.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub sliders: Vec<SliderCheck>,
    /// Estimated cost of the run.
    pub cost: Cost,
}

impl Checks {
    /// The checks without the memory, which depends on the number of threads where faults are condensed.
    #[must_use]
    pub fn without_memory(&self) -> Self {
        Self { cost: Cost { memory_bytes: None, ..self.cost }, ..self.clone() }
    }
}

/// Extent and cells of a body.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct BodyCheck {
    /// Body.
    pub body: String,
    /// Least coordinates \[m\].
    pub from: Vec<f64>,
    /// Largest coordinates \[m\].
    pub to: Vec<f64>,
    /// Nodes.
    pub nodes: usize,
    /// Cells.
    pub cells: usize,
    /// Shortest and longest edge of its cells, between corners \[m\].
    pub edges: [f64; 2],
}

/// Faces of a set that the scene uses.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct SetCheck {
    /// Set.
    pub set: String,
    /// Uses of it.
    pub used: Vec<String>,
    /// Faces.
    pub faces: usize,
    /// Nodes of a set of nodes, which has no faces.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub nodes: Option<usize>,
    /// Area \[m²; m per metre of thickness\].
    pub area: f64,
}

/// Stiffness of the springs that drive a surface, compared with that below which steady sliding is unstable.
///
/// Bodies deform, so that a surface is driven less stiffly than by its springs alone. Below the critical stiffness it is
/// therefore unstable for certain; above it may be stable.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct MachineCheck {
    /// Stiffness of the springs over the area that they drive \[Pa/m\].
    pub stiffness: f64,
    /// Critical stiffness f_n (b - a)/L, in the mean over the area; absent if f_n is not known in advance \[Pa/m\].
    pub critical: Option<f64>,
    /// Normal traction at which this stiffness is critical; absent if friction does not weaken with slip \[Pa\].
    pub critical_normal: Option<f64>,
    /// Fall of the strength where it falls most.
    pub softening: Softening,
}

/// Points and lengths of an interface.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct InterfaceCheck {
    /// Interface.
    pub interface: String,
    /// Slave nodes, at which contact acts.
    pub points: usize,
    /// Slave and master faces.
    pub faces: [usize; 2],
    /// Area of the slave side \[m²; m per metre of thickness\].
    pub area: f64,
    /// Radiation damping of its friction; absent if nothing is radiated \[Pa s/m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damping: Option<f64>,
    /// Lengths of friction, if it weakens.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub weakening: Option<WeakeningCheck>,
    /// Springs that drive it, if there are any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub machine: Option<MachineCheck>,
}

/// Lengths of friction that weakens on an interface. They fall with the normal traction.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct WeakeningCheck {
    /// Largest distance between neighbouring points \[m\].
    pub spacing: f64,
    /// Position of a point with this distance \[m\].
    pub at: [f64; 3],
    /// Normal traction under which the cohesive zone and the nucleation length are one such distance long \[Pa\].
    pub one_point: [f64; 2],
    /// Mean normal traction, if the loads alone determine it \[Pa\].
    pub normal: Option<f64>,
    /// The cohesive zone under that traction.
    pub cohesive_zone: Option<Coarsest>,
    /// The nucleation length under that traction.
    pub nucleation: Option<Coarsest>,
}

/// Stability of a spring-slider at the rate of the load point.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct SliderCheck {
    /// Spring-slider.
    pub slider: String,
    /// Stiffness of all its springs \[Pa/m\].
    pub stiffness: f64,
    /// Critical stiffness; 0 if it is stable on any spring \[Pa/m\].
    pub critical: f64,
    /// True if steady sliding is unstable.
    pub unstable: bool,
}
