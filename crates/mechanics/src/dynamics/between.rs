//! Surroundings of a fault in a step: its nodes and their motion.

use super::nodes::{Special, dot};

/// Mobility over that of free nodes below which a point is held: the square of the rounding of unit vectors is far below, absorbing sides far above.
const HELD: f64 = 1e-12;

/// Surroundings of the points of a fault: the special nodes of each, and the step.
pub(super) struct Between<'a> {
    pub nodes: &'a [Special],
    /// Accelerations without the change of tractions; the tractions add theirs \[m/s²\].
    pub acceleration: &'a mut [[f64; 3]],
    /// Velocities at the half step before \[m/s\].
    pub velocity: &'a [[f64; 3]],
    /// Displacements \[m\].
    pub displacement: &'a [[f64; 3]],
    /// Special nodes of each point: minus, plus.
    pub pairs: &'a [[usize; 2]],
    /// Special nodes of each tie.
    pub tied: &'a [[usize; 2]],
    /// Number of components of displacements.
    pub components: usize,
    pub time: f64,
    pub dt: f64,
    /// Time over which velocities change: Δt, but half of it in the first step.
    pub kick: f64,
    /// True in the first step, where rate laws keep their initial traction.
    pub first: bool,
}

impl Between<'_> {
    /// Difference plus - minus of values at the nodes of a point, along a unit vector.
    pub fn jump(&self, values: &[[f64; 3]], point: usize, e: &[f64; 3]) -> f64 {
        let [minus, plus] = self.pairs[point];
        dot(&values[plus], e) - dot(&values[minus], e)
    }

    /// Adds the accelerations by a force on the plus node of a pair, and its reaction \[N\].
    pub fn push(&mut self, pair: [usize; 2], force: &[f64; 3]) {
        for (&node, sign) in pair.iter().zip([-1.0, 1.0]) {
            let caused = self.nodes[node].accelerated(&force.map(|f| sign * f));
            self.acceleration[node].iter_mut().zip(caused).for_each(|(a, c)| *a += c);
        }
    }

    /// The mobility along a direction of slip; `None` if conditions hold both nodes along it, as on a plane of symmetry.
    pub fn slides(&self, point: usize, area: f64, e: &[f64; 3]) -> Option<f64> {
        let mobility = self.mobility(point, area, e);
        let free: f64 = self.pairs[point].iter().map(|&k| area / self.nodes[k].mass).sum();
        (mobility > HELD * free).then_some(mobility)
    }

    /// Inverse mass of a point for motion apart, times its area \[m²/kg\].
    pub fn mobility(&self, point: usize, area: f64, e: &[f64; 3]) -> f64 {
        let [minus, plus] = self.pairs[point];
        area * (self.nodes[minus].along(e) + self.nodes[plus].along(e))
    }
}
