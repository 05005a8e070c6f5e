//! Prescribed degrees of freedom and loads that vary in time, as channels: a spatial pattern times an amplitude.

use crate::table::Table;

/// A loading channel: at time t it contributes `amplitude(t)` times its patterns.
#[derive(Clone, Debug)]
pub struct Channel {
    /// Prescribed displacements: degree of freedom and value at unit amplitude \[m\].
    pub prescribed: Vec<(usize, f64)>,
    /// External nodal forces: degree of freedom and value at unit amplitude \[N, or N/m of thickness\].
    pub forces: Vec<(usize, f64)>,
    /// Amplitude over time \[-\].
    pub amplitude: Table,
}

/// The fixed degrees of freedom of a phase of the run, and every channel acting in it.
#[derive(Clone, Debug, Default)]
pub struct Constraints {
    /// Prescribed degrees of freedom, sorted, without repetition.
    pub fixed: Vec<usize>,
    /// Channels; `prescribed` entries lie in `fixed`.
    pub channels: Vec<Channel>,
}

impl Constraints {
    /// Writes the prescribed displacements at `time` into `u`: the sum over the channels at each fixed degree of freedom.
    pub fn impose(&self, time: f64, u: &mut [f64]) {
        for &dof in &self.fixed {
            u[dof] = 0.0;
        }
        for channel in &self.channels {
            let amplitude = channel.amplitude.value(time);
            for &(dof, value) in &channel.prescribed {
                u[dof] += amplitude * value;
            }
        }
    }

    /// Numbers the degrees of freedom that are not fixed.
    #[must_use]
    pub fn equations(&self, dofs: usize) -> Equations {
        let mut number = vec![0_usize; dofs];
        for &dof in &self.fixed {
            number[dof] = Equations::FIXED;
        }
        let mut free = Vec::with_capacity(dofs - self.fixed.len());
        for (dof, entry) in number.iter_mut().enumerate() {
            if *entry != Equations::FIXED {
                *entry = free.len();
                free.push(dof);
            }
        }
        Equations { number, free }
    }
}

/// Numbering of the free degrees of freedom.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Equations {
    /// Equation of each degree of freedom, or [`Equations::FIXED`].
    pub number: Vec<usize>,
    /// Degree of freedom of each equation.
    pub free: Vec<usize>,
}

impl Equations {
    /// Marks a degree of freedom without an equation.
    pub const FIXED: usize = usize::MAX;
}
