//! Energy of a run.
//!
//! With the kinetic energy ½ vⁿ⁺¹ᐟ²·M vⁿ⁻¹ᐟ² and the elastic energy ½ uⁿ·K uⁿ, central differences keep the balance exactly, if the work of
//! each force over a step is the mean of its values at both ends times the displacement: rounding alone is left.

use asperity_run::Energies;
use serde::{Deserialize, Serialize};

/// Parts of the energy at a step \[J, or J/m of thickness\].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Budget {
    /// Time \[s\].
    pub time: f64,
    /// Kinetic energy.
    pub kinetic: f64,
    /// Elastic energy of the displacements, without the work of the initial stress.
    pub elastic: f64,
    /// Dissipated by plastic flow.
    pub plastic: f64,
    /// Dissipated by Kelvin-Voigt damping, and by viscous flow.
    pub viscous: f64,
    /// Dissipated by friction, and work of normal tractions on openings.
    pub friction: f64,
    /// Carried away through absorbing sides.
    pub absorbed: f64,
    /// Work of loads, and of springs.
    pub loads: f64,
    /// Work of prescribed motions.
    pub motions: f64,
    /// Work that the initial and imposed tractions of faults release.
    pub released: f64,
    /// Kinetic energy at the start.
    pub initial: f64,
}

impl Budget {
    /// The budget by the names of its parts.
    #[must_use]
    pub fn energies(&self) -> Energies {
        Energies {
            given: vec![
                ("start", self.initial),
                ("loads", self.loads),
                ("motions", self.motions),
                ("released", self.released),
            ],
            kept: vec![("kinetic", self.kinetic), ("elastic", self.elastic)],
            lost: vec![
                ("plastic", self.plastic),
                ("viscous", self.viscous),
                ("friction", self.friction),
                ("absorbed", self.absorbed),
            ],
            exchanged: 0.0,
        }
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
