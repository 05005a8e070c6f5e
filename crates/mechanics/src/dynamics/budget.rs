//! Energy of a run.
//!
//! With the kinetic energy ½ vⁿ⁺¹ᐟ²·M vⁿ⁻¹ᐟ² and the elastic energy ½ uⁿ·K uⁿ, central differences keep the balance exactly, if the work of
//! each force over a step is the mean of its values at both ends times the displacement: rounding alone is left.

use serde::{Deserialize, Serialize};

/// Parts of the energy at a step \[J, or J/m of thickness\].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Budget {
    /// Time \[s\].
    pub time: f64,
    /// Kinetic energy.
    pub kinetic: f64,
    /// Elastic energy of the displacements, without the work of the initial stress; in bodies with a history, all work of their
    /// stresses beyond those at the start.
    pub elastic: f64,
    /// Dissipated by Kelvin-Voigt damping.
    pub viscous: f64,
    /// Dissipated by friction, and work of normal tractions on openings.
    pub friction: f64,
    /// Carried away through absorbing sides.
    pub absorbed: f64,
    /// Work of loads and prescribed motions.
    pub loads: f64,
    /// Work that the initial and imposed tractions of faults release.
    pub released: f64,
    /// Kinetic energy at the start.
    pub initial: f64,
}

impl Budget {
    /// Energy that is missing: what was given minus what is kept and lost \[J, or J/m of thickness\].
    #[must_use]
    pub fn missing(&self) -> f64 {
        let given = self.initial + self.loads + self.released;
        given - (self.kinetic + self.elastic) - (self.viscous + self.friction + self.absorbed)
    }

    /// Magnitude of the largest part.
    #[must_use]
    pub fn largest(&self) -> f64 {
        let parts = [
            self.kinetic,
            self.elastic,
            self.viscous,
            self.friction,
            self.absorbed,
            self.loads,
            self.released,
            self.initial,
        ];
        parts.into_iter().fold(0.0, |largest, part| f64::max(largest, part.abs()))
    }
}

/// Works of the forces of a kind: up to the present step, and over the half step that begins there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Work {
    /// Work up to tⁿ.
    pub done: f64,
    /// Work of the forces at tⁿ over the half step after it, which counts once the next step is taken.
    next: f64,
}

impl Work {
    /// Work of the last forces over the half step after them.
    pub fn pending(&self) -> f64 {
        self.next
    }

    /// Adds the work of forces at tⁿ: `before` and `after` are their powers at the velocities of the half steps before and after it, times half
    /// the step.
    pub fn add(&mut self, before: f64, after: f64) {
        self.done += self.next + before;
        self.next = after;
    }
}
