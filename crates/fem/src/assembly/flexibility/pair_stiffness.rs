//! Stiffness of pairs, which acts on their relative displacements.

use crate::relative::RelativeDisplacements;
use faer::Mat;
use faer::traits::ComplexField;

/// Matrices of the pairs, one after another, then springs to ground that are taken away.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PairStiffness {
    /// Components of a relative displacement.
    components: usize,
    /// Rows of each pair's matrix, one after another.
    values: Vec<f64>,
    /// Minus the stiffness of each spring.
    springs: Vec<f64>,
}

impl PairStiffness {
    pub fn clear(&mut self) {
        self.values.clear();
    }

    /// Adds the pairs of a term with these values.
    pub fn add(&mut self, relative: &RelativeDisplacements, values: &[f64]) {
        self.components = relative.components;
        relative.reduce(values, &mut self.values);
    }

    /// Springs to ground, to be taken away.
    pub fn set_springs(&mut self, springs: &[f64]) {
        self.springs.clear();
        self.springs.extend(springs.iter().map(|stiffness| -stiffness));
    }

    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The same pairs with other matrices, if these are as many.
    pub fn with_values(&self, values: Vec<f64>) -> Option<Self> {
        (values.len() == self.values.len()).then(|| Self { values, ..self.clone() })
    }

    fn matrices(&self) -> std::slice::ChunksExact<'_, f64> {
        self.values.chunks_exact(self.components.pow(2).max(1))
    }

    /// Components of closed pairs, and springs.
    pub fn closed(&self) -> Vec<usize> {
        let components = self.components;
        let is_closed = |(k, m): (usize, &[f64])| m.iter().any(|&v| v != 0.0).then_some(k);
        let pairs = self.matrices().enumerate().filter_map(is_closed);
        let first = self.matrices().len() * components;
        pairs
            .flat_map(|k| k * components..(k + 1) * components)
            .chain(first..first + self.springs.len())
            .collect()
    }

    /// Forces `D w`.
    pub fn multiply(&self, w: &[f64], forces: &mut [f64]) {
        let components = self.components;
        for (m, (w, forces)) in
            self.matrices().zip(w.chunks(components.max(1)).zip(forces.chunks_mut(components.max(1))))
        {
            for (row, force) in m.chunks_exact(components).zip(forces) {
                *force = row.iter().zip(w).map(|(m, w)| m * w).sum();
            }
        }
        let first = self.matrices().len() * components;
        for (k, spring) in self.springs.iter().enumerate() {
            forces[first + k] = spring * w[first + k];
        }
    }

    /// `1 + D F` over the components `closed`, in numbers of another precision.
    pub fn system<T: ComplexField>(
        &self,
        flexibility: &Mat<f64>,
        closed: &[usize],
        round: impl Fn(f64) -> T,
    ) -> Mat<T> {
        let mut system = Mat::zeros(closed.len(), closed.len());
        let mut forces = vec![0.0; flexibility.nrows()];
        for (j, &col) in closed.iter().enumerate() {
            self.multiply(flexibility.col_as_slice(col), &mut forces);
            forces[col] += 1.0;
            let target = system.col_as_slice_mut(j).iter_mut().zip(closed);
            target.for_each(|(target, &row)| *target = round(forces[row]));
        }
        system
    }
}
