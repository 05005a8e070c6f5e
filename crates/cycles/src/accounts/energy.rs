//! Parts of an energy budget.

use asperity_run::Energies;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Energy budget \[J; J per metre of thickness in the plane; J/m² of spring-sliders\].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Energy {
    /// Work done by the initial tractions and by the loads on slip.
    pub loads: f64,
    /// Energy that slip stores in the bodies or the springs.
    pub elastic: f64,
    /// Work done against friction.
    pub friction: f64,
    /// Work done against radiation damping, and energy of waves where bodies have mass.
    pub radiated: f64,
    /// Kinetic energy in excess of its initial value.
    #[serde(default, skip_serializing_if = "nothing")]
    pub kinetic: f64,
    /// Work done on openings by the fluid, the loads and the initial normal tractions.
    #[serde(default, skip_serializing_if = "nothing")]
    pub opening: f64,
    /// Sum over steps of the absolute value of that work. Its net value is smaller, since closing returns the work of
    /// opening.
    #[serde(default, skip_serializing_if = "nothing")]
    pub exchanged: f64,
}

#[allow(clippy::trivially_copy_pass_by_ref)]
fn nothing(value: &f64) -> bool {
    *value == 0.0
}

impl Energy {
    /// The budget by the names of its parts.
    #[must_use]
    pub fn energies(&self) -> Energies {
        Energies {
            given: vec![("loads", self.loads), ("opening", self.opening)],
            kept: vec![("elastic", self.elastic), ("kinetic", self.kinetic)],
            lost: vec![("friction", self.friction), ("radiated", self.radiated)],
            exchanged: self.exchanged,
        }
    }

    /// Missing energy over the largest part \[-\].
    #[must_use]
    pub fn imbalance(&self) -> f64 {
        self.energies().imbalance()
    }

    /// Difference from an earlier budget.
    #[must_use]
    pub fn since(&self, before: &Self) -> Self {
        Self {
            loads: self.loads - before.loads,
            elastic: self.elastic - before.elastic,
            friction: self.friction - before.friction,
            radiated: self.radiated - before.radiated,
            kinetic: self.kinetic - before.kinetic,
            opening: self.opening - before.opening,
            exchanged: self.exchanged - before.exchanged,
        }
    }
}

/// State of the run at the end of an event.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mark {
    /// Time \[s\].
    pub time: f64,
    /// Slip since the start integrated over the area \[m³; m²\]; where slip has two directions, its component along the
    /// rake.
    pub potency: f64,
    /// Energy budget up to then.
    pub energy: Energy,
}
