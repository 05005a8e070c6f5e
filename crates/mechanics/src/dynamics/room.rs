//! Values at the special nodes in a step. They are kept from step to step: to ask for memory would cost more than to fill it.

use super::surroundings::PointForces;

/// See the module. Loads are those of all special nodes, all else is at the nodes of faults.
#[derive(Debug, Default)]
pub(super) struct Room {
    /// Loads \[N\]; empty where nothing loads a special node.
    pub external: Vec<[f64; 3]>,
    /// Accelerations \[m/s²\].
    pub acceleration: Vec<[f64; 3]>,
    /// Velocities half a step before \[m/s\].
    pub before: Vec<[f64; 3]>,
    /// Velocities half a step after \[m/s\].
    pub after: Vec<[f64; 3]>,
    /// Displacements \[m\].
    pub displacement: Vec<[f64; 3]>,
    /// Forces of the tractions at the points of faults.
    pub forces: Vec<PointForces>,
}

impl Room {
    /// Room for so many nodes of faults, and for loads of so many special nodes, which are zero.
    pub fn clear(&mut self, faulted: usize, loaded: usize) {
        let Self { acceleration, external, before, after, displacement, .. } = self;
        for values in [acceleration, before, after, displacement] {
            values.resize(faulted, [0.0; 3]);
        }
        external.clear();
        external.resize(loaded, [0.0; 3]);
    }

    /// Jumps of the velocities half a step before and after, from the first node of a pair to the second.
    pub fn velocity_jumps(&self, pair: [usize; 2]) -> [[f64; 3]; 2] {
        [jump(&self.before, pair), jump(&self.after, pair)]
    }

    /// Jump of the displacements.
    pub fn jump(&self, pair: [usize; 2]) -> [f64; 3] {
        jump(&self.displacement, pair)
    }
}

fn jump(values: &[[f64; 3]], [minus, plus]: [usize; 2]) -> [f64; 3] {
    std::array::from_fn(|c| values[plus][c] - values[minus][c])
}
