//! Dual functions on first-order facets that face the master everywhere.
//!
//! `Φ_a = Σ_b A_ab N_b` with `A = diag(m) M⁻¹`, `M_ab = ∫N_a N_b`, `m_a = ∫N_a` over the facet, so that `∫Φ_a N_b = δ_ab m_a`
//! (Wohlmuth 2000) in the same quadrature as the overlap. The duals are a partition of unity, since `1ᵀA = mᵀM⁻¹ = 1ᵀ`, and
//! have the areas of the shape functions. They couple a slave point to its own node alone. The traction of a point is the force
//! on its node over its area. It ends at the last node in contact; with shape functions it extends one facet further. Duals are
//! negative in places. A facet partly beyond the master's rim keeps its shape functions, since the duals of part of a facet
//! grow without bound as the part shrinks.
//!
//! Wohlmuth, B. I. (2000), A mortar finite element method using dual spaces for the Lagrange multiplier, SIAM Journal on Numerical
//! Analysis 38, 989-1012.

use super::cell::{ReferenceFacet, Sums, integrate};
use super::rule::Rule;
use crate::shape::MOST_NODES;
use nalgebra::DMatrix;

/// Share of a facet that may lie beyond the master, for the rounding of coinciding rims.
const UNFACED: f64 = 1e-9;

/// Integrals of a facet with one master facet.
pub(super) type Part = (usize, Sums<f64, MOST_NODES>);

/// Replaces the shape functions by their duals in the integrals of a facet at `x` with all its master facets, if it has duals.
pub(super) fn dualise<const D: usize>(
    frozen: ReferenceFacet<'_, D>,
    x: &[[f64; D]],
    rule: &Rule,
    parts: &mut [Part],
) {
    let n = frozen.kind.nodes();
    if !frozen.kind.first_order() || frozen.weighting.points.len() < n {
        return;
    }
    let mass = DMatrix::from_fn(n, n, |a, b| parts.iter().map(|(_, s)| s.own[a][b]).sum::<f64>());
    if mass.sum() < (1.0 - UNFACED) * area(frozen, x, rule) {
        return;
    }
    let Some(inverse) = mass.clone().try_inverse() else { return };
    let dual = DMatrix::from_fn(n, n, |a, b| mass.row(a).sum() * inverse[(a, b)]);
    for (_, sums) in parts {
        sums.own = transformed(&dual, &sums.own);
        sums.other = transformed(&dual, &sums.other);
    }
}

/// Area of the whole facet, computed as its overlap with its own reverse side.
fn area<const D: usize>(frozen: ReferenceFacet<'_, D>, x: &[[f64; D]], rule: &Rule) -> f64 {
    let back: Vec<[f64; D]> = x.iter().rev().copied().collect();
    let mut sums = Sums::<f64, MOST_NODES>::zero();
    integrate(frozen, x, frozen.kind, &back, rule, &mut sums);
    let n = frozen.kind.nodes();
    sums.own[..n].iter().flat_map(|row| &row[..n]).sum()
}

fn transformed(
    dual: &DMatrix<f64>,
    rows: &[[f64; MOST_NODES]; MOST_NODES],
) -> [[f64; MOST_NODES]; MOST_NODES] {
    let mut out = [[0.0; MOST_NODES]; MOST_NODES];
    for a in 0..dual.nrows() {
        for b in 0..dual.ncols() {
            for (o, r) in out[a].iter_mut().zip(&rows[b]) {
                *o += dual[(a, b)] * r;
            }
        }
    }
    out
}
