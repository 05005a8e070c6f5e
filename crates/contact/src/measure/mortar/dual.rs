//! Dual functions on facets and faces that face the master everywhere.
//!
//! `Φ_a = Σ_b A_ab N_b` with `A = diag(m) M⁻¹`, `M_ab = ∫N_a N_b`, `m_a = ∫N_a` over a face, so that `∫Φ_a N_b = δ_ab m_a`
//! (Wohlmuth 2000) in the same quadrature as the overlap. The duals are a partition of unity, since `1ᵀA = mᵀM⁻¹ = 1ᵀ`, and
//! have the areas of the shape functions. They couple a slave point to its own node alone. The traction of a point is the force
//! on its node over its area. It ends at the last node in contact; with the functions of corners it extends one facet further.
//! Duals are negative in places. A face partly beyond the master's rim keeps the functions of its corners, since the duals of part
//! of a face grow without bound as the part shrinks.
//!
//! Duals need positive areas, which lines of three nodes and quadrilaterals of nine have. As their nodes are those of Gauss-Lobatto
//! quadrature, duals then reproduce linear functions, and keep the order of the elements (Lamichhane and Wohlmuth 2005). Triangles
//! of six nodes and quadrilaterals of eight have no positive areas. There the facets have the duals of the functions of their
//! corners. A point is coupled to its own node, and more weakly to others by the curvature of the face's functions: the averages of
//! a function that alternates from node to node keep three quarters of it or more, where the functions of corners keep a quarter.
//!
//! Wohlmuth, B. I. (2000), A mortar finite element method using dual spaces for the Lagrange multiplier, SIAM Journal on Numerical
//! Analysis 38, 989-1012.
//!
//! Lamichhane, B. P. and Wohlmuth, B. I. (2005), Biorthogonal bases with local support and approximation properties, Mathematics of
//! Computation 76, 233-249 (2007).

use super::cell::{ReferenceFacet, Sums, integrate};
use super::facet::{Facet, NODES, facets};
use super::rule::Rule;
use crate::SegmentKind;
use crate::shape::MOST_NODES;
use crate::spec::Segment;
use nalgebra::DMatrix;

/// Share of a face that may lie beyond the master, for the rounding of coinciding rims.
const UNFACED: f64 = 1e-9;

/// Least area of a node of a face over the mean: a node on an axis of revolution has none, all others have more than this.
const LEAST_AREA: f64 = 0.02;

/// Integrals of a slave facet with a master facet: their numbers, and the sums with R functions of the slave.
pub(super) type Part<const R: usize> = ([usize; 2], Sums<f64, MOST_NODES, R>);

/// True if the functions of a face are to have duals of their own. Faces of first order are facets, whose duals are the same.
pub(super) fn has_duals(kind: SegmentKind) -> bool {
    matches!(kind, SegmentKind::Seg3 | SegmentKind::Quad9)
}

/// Replaces the functions of the corners of a facet by their duals in its integrals with all master facets, if it faces them over
/// the `whole` of its area.
pub(super) fn dualise_facet(facet: &Facet, whole: f64, parts: &mut [Part<NODES>]) {
    let n = facet.nodes.len();
    let mut mass = DMatrix::<f64>::zeros(n, n);
    for (_, sums) in &*parts {
        for (a, own) in sums.own.iter().enumerate().take(n) {
            let with_corners = facet.with_corners(own);
            (0..n).for_each(|b| mass[(a, b)] += with_corners[b]);
        }
    }
    dualise(&mass, whole, parts);
}

/// Replaces the functions of a face of n nodes by their duals, if it faces the master over the `whole` of its area and none of its
/// nodes is without area. Returns the areas of the nodes if so.
pub(super) fn dualise_face(n: usize, whole: f64, parts: &mut [Part<MOST_NODES>]) -> Option<Vec<f64>> {
    let mass = DMatrix::from_fn(n, n, |a, b| parts.iter().map(|(_, sums)| sums.own[a][b]).sum::<f64>());
    let areas: Vec<f64> = (0..n).map(|a| mass.row(a).sum()).collect();
    #[expect(clippy::cast_precision_loss, reason = "at most nine")]
    let least = LEAST_AREA * mass.sum() / n as f64;
    (areas.iter().all(|area| *area > least) && dualise(&mass, whole, parts)).then_some(areas)
}

/// Replaces functions with this mass matrix by their duals. Returns false if they face the master over less than the `whole` area.
fn dualise<const R: usize>(mass: &DMatrix<f64>, whole: f64, parts: &mut [Part<R>]) -> bool {
    if mass.sum() < (1.0 - UNFACED) * whole {
        return false;
    }
    let Some(inverse) = mass.clone().try_inverse() else { return false };
    let n = mass.nrows();
    let dual = DMatrix::from_fn(n, n, |a, b| mass.row(a).sum() * inverse[(a, b)]);
    for (_, sums) in parts {
        sums.own = transformed(&dual, &sums.own);
        sums.other = transformed(&dual, &sums.other);
    }
    true
}

/// Area of a facet, computed as its overlap with its own reverse side. `x` are the positions of the nodes of its face, and of its
/// middle if that is a corner.
pub(super) fn area<const D: usize>(frozen: ReferenceFacet<'_, D>, x: &[[f64; D]], rule: &Rule) -> f64 {
    let corners = frozen.facet.corners;
    let kind = frozen.facet.kind;
    let reverse = Segment { kind, nodes: (0..corners.len()).collect() };
    let back: Vec<[f64; D]> = corners.iter().rev().map(|&k| x[k]).collect();
    let mut sums = Sums::<f64, MOST_NODES>::zero();
    for facet in facets(&reverse, None, &back) {
        integrate(frozen, x, &facet, &back, rule, &mut sums);
    }
    sums.own.as_flattened().iter().sum()
}

fn transformed<const R: usize>(dual: &DMatrix<f64>, rows: &[[f64; MOST_NODES]; R]) -> [[f64; MOST_NODES]; R] {
    let mut out = [[0.0; MOST_NODES]; R];
    for a in 0..dual.nrows() {
        for b in 0..dual.ncols() {
            for (o, r) in out[a].iter_mut().zip(&rows[b]) {
                *o += dual[(a, b)] * r;
            }
        }
    }
    out
}
