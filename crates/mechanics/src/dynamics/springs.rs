//! Springs that load sets of bodies with mass.
//!
//! A spring acts on the mean displacement of its set, weighted with the masses of its nodes, and its force is shared by them
//! in the same way. Bodies without mass keep such a set straight; with mass only its mean is drawn.

use crate::{Spring, Travel};

/// A spring with its degrees of freedom: special node, component and share.
#[derive(Debug)]
struct AttachedSpring {
    places: Vec<(usize, usize, f64)>,
    /// \[N/m; N/m per metre of thickness in the plane\].
    stiffness: f64,
    /// Displacement of its far end.
    drawn: Travel,
}

/// Springs of a stage.
#[derive(Debug, Default)]
pub(super) struct Springs(Vec<AttachedSpring>);

impl Springs {
    /// Springs of a stage; `place` finds the special node, the component and the mass of a degree of freedom.
    pub fn new(
        springs: &[Spring],
        start: f64,
        end: f64,
        place: impl Fn(usize) -> (usize, usize, f64),
    ) -> Self {
        let attached = |spring: &Spring| {
            let mut places: Vec<_> = spring.dofs.iter().map(|&dof| place(dof)).collect();
            let mass: f64 = places.iter().map(|(_, _, mass)| mass).sum();
            places.iter_mut().for_each(|(_, _, share)| *share /= mass);
            AttachedSpring { places, stiffness: spring.stiffness, drawn: spring.rate.drawn(start, end) }
        };
        Self(springs.iter().map(attached).collect())
    }

    /// True without springs.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Adds the forces at `time` to those of the special nodes; `displacement` is that of a component of such a node \[N\].
    pub fn add(&self, time: f64, displacement: impl Fn(usize, usize) -> f64, forces: &mut [[f64; 3]]) {
        for AttachedSpring { places, stiffness, drawn } in &self.0 {
            let mean: f64 = places.iter().map(|&(node, c, share)| share * displacement(node, c)).sum();
            let force = stiffness * (drawn.at(time) - mean);
            places.iter().for_each(|&(node, c, share)| forces[node][c] += share * force);
        }
    }
}
