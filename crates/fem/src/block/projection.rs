//! The projected dilatation of B-bar.
//!
//! With φ_k polynomials orthonormal over the cell, θ̄ = Σ_k φ_k ∫ φ_k θ dV = Σ_k φ_k c_k·u, where c_k = ∫ φ_k ∂θ/∂u dV. The
//! energy κ/2 ∫ θ̄² dV is κ/2 Σ_k (c_k·u)².

use super::geometry::{CHUNK, CellGeometry, Geometry};
use crate::kinematics::Dilatation;
use rayon::prelude::*;

/// Largest number of polynomials: 1, x, y, z.
const MOST_TERMS: usize = 4;

/// Projections of all cells of a block.
#[derive(Clone, Debug)]
pub(super) struct Projection {
    terms: usize,
    points: usize,
    width: usize,
    /// c_k: cell, term, degree of freedom of the cell.
    moments: Vec<f64>,
    /// φ_k: cell, point, term.
    values: Vec<f64>,
}

impl Projection {
    /// Projections of `cells` cells with `width` degrees of freedom each.
    pub fn new<const D: usize>(
        space: Dilatation,
        geometry: &Geometry<D>,
        cells: usize,
        width: usize,
    ) -> Self {
        let terms = if space == Dilatation::Linear { 1 + D } else { 1 };
        let points = if cells == 0 { 1 } else { geometry.cell(0).volumes.len() };
        let mut moments = vec![0.0; cells * terms * width];
        let mut values = vec![0.0; cells * points * terms];
        moments
            .par_chunks_mut(CHUNK * terms * width)
            .zip(values.par_chunks_mut(CHUNK * points * terms))
            .enumerate()
            .for_each(|(chunk, (moments, values))| {
                let parts =
                    moments.chunks_exact_mut(terms * width).zip(values.chunks_exact_mut(points * terms));
                for (k, (moments, values)) in parts.enumerate() {
                    let cell = geometry.cell(chunk * CHUNK + k);
                    orthonormal(&cell, terms, values);
                    for (q, phi) in values.chunks_exact(terms).enumerate() {
                        for (phi, moment) in phi.iter().zip(moments.chunks_exact_mut(width)) {
                            add_dilatation(&cell, q, phi * cell.volumes[q], moment);
                        }
                    }
                }
            });
        Self { terms, points, width, moments, values }
    }

    /// The vectors c_k of a cell.
    pub fn moments(&self, cell: usize) -> impl Iterator<Item = &[f64]> {
        let size = self.terms * self.width;
        self.moments[cell * size..(cell + 1) * size].chunks_exact(self.width)
    }

    /// θ̄ at the points of a cell, from the displacement of its nodes `u` \[-\].
    pub fn dilatation<'a>(&'a self, cell: usize, u: &[f64]) -> impl Iterator<Item = f64> + use<'a> {
        let mut amplitudes = [0.0; MOST_TERMS];
        for (amplitude, c) in amplitudes.iter_mut().zip(self.moments(cell)) {
            *amplitude = c.iter().zip(u).map(|(c, u)| c * u).sum();
        }
        let size = self.terms * self.points;
        self.values[cell * size..(cell + 1) * size]
            .chunks_exact(self.terms)
            .map(move |phi| phi.iter().zip(&amplitudes).map(|(p, a)| p * a).sum())
    }
}

/// Adds `factor` times ∂θ/∂u at a point: ∂N_a/∂x_i, and N_a/r for u_r about an axis.
fn add_dilatation<const D: usize>(cell: &CellGeometry<'_, D>, point: usize, factor: f64, sum: &mut [f64]) {
    let hoop = cell.hoop(point);
    let nodes = sum.chunks_exact_mut(D).zip(cell.gradients(point)).zip(cell.shapes(point));
    for ((sum, gradient), n) in nodes {
        for (s, g) in sum.iter_mut().zip(gradient) {
            *s += factor * g;
        }
        sum[0] += factor * hoop * n;
    }
}

/// Writes the first `terms` of 1, x, y, z, orthonormalised over the cell, at its points. Gram-Schmidt is applied twice for
/// accuracy on stretched cells. Positions are measured from the centre in units of the extent, so that the size does not matter.
fn orthonormal<const D: usize>(cell: &CellGeometry<'_, D>, terms: usize, values: &mut [f64]) {
    let volume: f64 = cell.volumes.iter().sum();
    let centre: [f64; D] = std::array::from_fn(|c| {
        cell.volumes.iter().zip(cell.positions).map(|(v, x)| v * x[c]).sum::<f64>() / volume
    });
    for (phi, x) in values.chunks_exact_mut(terms).zip(cell.positions) {
        phi[0] = 1.0;
        for (c, p) in phi[1..].iter_mut().enumerate() {
            *p = x[c] - centre[c];
        }
    }
    let product = |values: &[f64], i: usize, j: usize| -> f64 {
        values.chunks_exact(terms).zip(cell.volumes).map(|(phi, v)| v * phi[i] * phi[j]).sum()
    };
    for k in 0..terms {
        for _ in 0..2 {
            for earlier in 0..k {
                let share = product(values, earlier, k);
                values.chunks_exact_mut(terms).for_each(|phi| phi[k] -= share * phi[earlier]);
            }
        }
        let scale = 1.0 / product(values, k, k).sqrt();
        values.chunks_exact_mut(terms).for_each(|phi| phi[k] *= scale);
    }
}
