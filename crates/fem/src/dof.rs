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
        Equations { number, free, tied: Vec::new() }
    }
}

/// Numbering of the free degrees of freedom.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Equations {
    /// Equation of each degree of freedom, or [`Equations::FIXED`].
    pub number: Vec<usize>,
    /// Degree of freedom of each equation; the first of those that share it.
    pub free: Vec<usize>,
    /// Degrees of freedom that share the equation of another, ascending.
    pub tied: Vec<usize>,
}

impl Equations {
    /// Marks a degree of freedom without an equation.
    pub const FIXED: usize = usize::MAX;

    /// The same degrees of freedom, with one equation for those of each group, which move as one. No group has a fixed degree of
    /// freedom, or one of another group.
    #[must_use]
    pub fn with_groups<'a>(mut self, groups: impl IntoIterator<Item = &'a [usize]>) -> Self {
        let mut leader: Vec<usize> = (0..self.number.len()).collect();
        for group in groups {
            if let Some(&first) = group.iter().min() {
                group.iter().for_each(|&dof| leader[dof] = first);
            }
        }
        let (mut free, mut tied) = (Vec::with_capacity(self.free.len()), Vec::new());
        for dof in self.free {
            if leader[dof] == dof {
                self.number[dof] = free.len();
                free.push(dof);
            } else {
                self.number[dof] = self.number[leader[dof]];
                tied.push(dof);
            }
        }
        Self { number: self.number, free, tied }
    }

    /// Sums of values over the degrees of freedom of each equation.
    #[must_use]
    pub fn gather(&self, values: &[f64]) -> Vec<f64> {
        let mut sums: Vec<f64> = self.free.iter().map(|&dof| values[dof]).collect();
        for &dof in &self.tied {
            sums[self.number[dof]] += values[dof];
        }
        sums
    }

    /// Writes a value of each equation at its degrees of freedom.
    pub fn spread(&self, values: &[f64], out: &mut [f64]) {
        for &dof in self.free.iter().chain(&self.tied) {
            out[dof] = values[self.number[dof]];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn degrees_of_freedom_that_move_as_one_share_an_equation() {
        let fixed = Constraints { fixed: vec![1], channels: Vec::new() };
        let equations = fixed.equations(7).with_groups([&[5, 2][..], &[6, 3][..]]);
        assert_eq!((equations.free.as_slice(), equations.tied.as_slice()), (&[0, 2, 3, 4][..], &[5, 6][..]));
        assert_eq!(equations.gather(&[1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0]), [1.0, 36.0, 72.0, 16.0]);
        let mut out = [-1.0; 7];
        equations.spread(&[1.0, 2.0, 3.0, 4.0], &mut out);
        assert_eq!(out, [1.0, -1.0, 2.0, 3.0, 4.0, 2.0, 3.0]);
    }
}
