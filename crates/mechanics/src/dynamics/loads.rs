//! Loads and prescribed motions of a stage.

use asperity_fem::dof::Constraints;
use asperity_fem::table::Table;

/// Special node, component and force at unit amplitude \[N\].
type Place = (usize, usize, f64);

/// Forces of the channels of a stage on its special nodes.
#[derive(Debug, Default)]
pub(super) struct Loads {
    channels: Vec<(Table, Vec<Place>)>,
}

impl Loads {
    /// Loads of a stage; `place` finds the special node and the component of a degree of freedom.
    pub fn new(constraints: &Constraints, place: impl Fn(usize) -> (usize, usize)) -> Self {
        let channels = constraints.channels.iter().filter(|c| !c.forces.is_empty());
        let placed = |forces: &[(usize, f64)]| {
            let at = |&(dof, force): &(usize, f64)| (place(dof).0, place(dof).1, force);
            forces.iter().map(at).collect()
        };
        Self { channels: channels.map(|c| (c.amplitude.clone(), placed(&c.forces))).collect() }
    }

    /// True without loads.
    pub fn is_empty(&self) -> bool {
        self.channels.is_empty()
    }

    /// Adds the forces at `time` to those of the special nodes \[N\].
    pub fn add(&self, time: f64, forces: &mut [[f64; 3]]) {
        for (amplitude, places) in &self.channels {
            let amplitude = amplitude.value(time);
            places.iter().for_each(|&(node, component, force)| forces[node][component] += amplitude * force);
        }
    }
}
