//! Parts of an energy budget.

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
    /// Energy that is missing: what was given minus what is kept and lost.
    #[must_use]
    pub fn missing(&self) -> f64 {
        self.loads + self.opening - self.elastic - self.friction - self.radiated - self.kinetic
    }

    /// Missing energy, divided by the largest part \[-\].
    #[must_use]
    pub fn imbalance(&self) -> f64 {
        let moved = [self.kinetic, self.opening, self.exchanged];
        let parts = [self.loads, self.elastic, self.friction, self.radiated].into_iter().chain(moved);
        let largest = parts.fold(0.0_f64, |l, v| l.max(v.abs()));
        if largest == 0.0 {
            return 0.0;
        }
        self.missing().abs() / largest
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
