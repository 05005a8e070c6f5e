//! Values at the special nodes in a step. They are kept from step to step: to ask for memory would cost more than to fill it.

/// See the module.
#[derive(Debug, Default)]
pub(super) struct Room {
    /// Accelerations \[m/s²\].
    pub acceleration: Vec<[f64; 3]>,
    /// Internal forces \[N\].
    pub internal: Vec<[f64; 3]>,
    /// Loads \[N\].
    pub external: Vec<[f64; 3]>,
    /// Velocities half a step before \[m/s\].
    pub before: Vec<[f64; 3]>,
    /// Velocities half a step after \[m/s\].
    pub after: Vec<[f64; 3]>,
    /// Displacements \[m\].
    pub displacement: Vec<[f64; 3]>,
}

impl Room {
    /// Room for so many nodes, without loads.
    pub fn clear(&mut self, nodes: usize) {
        let Self { acceleration, internal, external, before, displacement, .. } = self;
        for values in [acceleration, internal, before, displacement] {
            values.resize(nodes, [0.0; 3]);
        }
        external.clear();
        external.resize(nodes, [0.0; 3]);
    }
}
