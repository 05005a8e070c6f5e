//! Search for the cell that contains a position, and its natural coordinates there.

use super::Mesh;
use crate::element::{ElementKind, Shape};
use nalgebra::{SMatrix, SVector};
use std::ops::Range;

/// Largest distance beyond the boundary of a cell, in natural coordinates, that counts as rounding: positions are given in
/// decimal numbers, and nodes are placed to rounding.
const ON_BOUNDARY: f64 = 1e-8;
/// Newton steps of the inverse map. One is exact for straight simplices; three to six suffice for cells that are not
/// degenerate.
const MOST_STEPS: usize = 30;
/// Natural distance moved in the last step at which the inverse map has converged: convergence is quadratic.
const CONVERGED: f64 = 1e-10;
/// Fraction of its size by which a curved cell may extend beyond the box of its nodes. A parabola through three nodes of a side
/// extends at most an eighth of its sagitta's span beyond them.
const BULGE: f64 = 0.125;

/// A position in a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Location {
    /// Block of cells.
    pub block: usize,
    /// Cell in the block.
    pub cell: usize,
    /// Natural coordinates.
    pub xi: [f64; 3],
}

/// The first cell of some blocks that contains `x` \[m\], including its boundary; `None` if no cell does.
#[must_use]
pub fn locate<const D: usize>(mesh: &Mesh<D>, blocks: Range<usize>, x: &[f64; D]) -> Option<Location> {
    blocks.into_iter().find_map(|block| {
        let cells = &mesh.blocks[block];
        (0..cells.len()).find_map(|cell| {
            let nodes: Vec<[f64; D]> = cells.cell(cell).iter().map(|&n| mesh.nodes[n]).collect();
            let xi = near(&nodes, x).then(|| natural(cells.kind, &nodes, x)).flatten()?;
            holds(cells.kind, &xi).then_some(Location { block, cell, xi })
        })
    })
}

/// True if a cell, given by its block and number, contains a position \[m\], or has it on its boundary.
pub(super) fn holds_position<const D: usize>(
    mesh: &Mesh<D>,
    (block, cell): (usize, usize),
    x: &[f64; D],
) -> bool {
    let cells = &mesh.blocks[block];
    let nodes: Vec<[f64; D]> = cells.cell(cell).iter().map(|&n| mesh.nodes[n]).collect();
    natural(cells.kind, &nodes, x).is_some_and(|xi| holds(cells.kind, &xi))
}

/// True if a position lies in the box of some nodes, with room for curved sides.
fn near<const D: usize>(nodes: &[[f64; D]], x: &[f64; D]) -> bool {
    let bounds = |c: usize| {
        let values = nodes.iter().map(|n| n[c]);
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), v| (lo.min(v), hi.max(v)))
    };
    let size = (0..D).map(|c| bounds(c).1 - bounds(c).0).fold(0.0, f64::max);
    (0..D).all(|c| {
        let (lo, hi) = bounds(c);
        x[c] >= lo - BULGE * size && x[c] <= hi + BULGE * size
    })
}

/// Natural coordinates of a position by Newton's method from the centre; `None` if it does not converge.
fn natural<const D: usize>(kind: ElementKind, nodes: &[[f64; D]], x: &[f64; D]) -> Option<[f64; 3]> {
    let corners = &kind.node_coordinates()[..kind.corners()];
    let mut xi: [f64; 3] =
        std::array::from_fn(|c| corners.iter().map(|n| n[c]).sum::<f64>() / corners.len() as f64);
    for _ in 0..MOST_STEPS {
        let (at, jacobian) = place(&kind.shape(xi), nodes);
        let step = jacobian.try_inverse()? * (SVector::from(*x) - at);
        xi.iter_mut().zip(step.iter()).for_each(|(xi, d)| *xi += d);
        let moved = step.amax();
        if moved <= CONVERGED {
            return Some(xi);
        }
        if !moved.is_finite() {
            return None;
        }
    }
    None
}

/// Position and its derivative with respect to natural coordinates.
fn place<const D: usize>(shape: &Shape, nodes: &[[f64; D]]) -> (SVector<f64, D>, SMatrix<f64, D, D>) {
    let (mut x, mut j) = (SVector::zeros(), SMatrix::zeros());
    for (a, node) in nodes.iter().enumerate() {
        for i in 0..D {
            x[i] += shape.n[a] * node[i];
            for m in 0..D {
                j[(i, m)] += shape.dn[a][m] * node[i];
            }
        }
    }
    (x, j)
}

/// True if natural coordinates lie in an element.
fn holds(kind: ElementKind, &[x, y, z]: &[f64; 3]) -> bool {
    use ElementKind::{Tet4, Tet10, Tri3, Tri6, Wedge6, Wedge15};
    let square = |v: f64| v.abs() <= 1.0 + ON_BOUNDARY;
    let simplex =
        |v: &[f64]| v.iter().all(|v| *v >= -ON_BOUNDARY) && v.iter().sum::<f64>() <= 1.0 + ON_BOUNDARY;
    match kind {
        Tri3 | Tri6 => simplex(&[x, y]),
        Tet4 | Tet10 => simplex(&[x, y, z]),
        Wedge6 | Wedge15 => simplex(&[x, y]) && square(z),
        _ => square(x) && square(y) && square(z),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::mesh::generate::{Block, Grading};

    /// A block of this element with a curved side.
    fn bent<const D: usize>(kind: ElementKind) -> Mesh<D> {
        let block =
            Block { min: [0.0; D], max: [1.0; D], divisions: [3; D], grading: [Grading::Uniform; D], kind };
        let mut mesh = block.mesh().unwrap();
        for x in &mut mesh.nodes {
            x[0] += 0.1 * x[1] * x[1];
            x[D - 1] += 0.2 * x[0] * x[D - 1];
        }
        mesh
    }

    fn found_again<const D: usize>(kind: ElementKind) {
        let mesh = bent::<D>(kind);
        let cells = &mesh.blocks[0];
        for cell in 0..cells.len() {
            let nodes: Vec<[f64; D]> = cells.cell(cell).iter().map(|&n| mesh.nodes[n]).collect();
            for (xi, _) in kind.quadrature() {
                let x: [f64; D] = place(&kind.shape(xi), &nodes).0.into();
                let at = locate(&mesh, 0..1, &x).unwrap();
                assert_eq!((at.block, at.cell), (0, cell), "{kind:?}");
                assert!(
                    at.xi.iter().zip(xi).take(D).all(|(a, b)| (a - b).abs() < 1e-9),
                    "{kind:?} {at:?} {xi:?}"
                );
            }
        }
    }

    #[test]
    fn places_inside_cells_are_found_again_in_every_element() {
        for kind in ElementKind::ALL {
            if kind.dimension() == 2 { found_again::<2>(kind) } else { found_again::<3>(kind) }
        }
    }

    #[test]
    fn nodes_lie_in_a_cell_that_has_them_and_places_outside_in_none() {
        for kind in ElementKind::ALL.into_iter().filter(|k| k.dimension() == 2) {
            let mesh = bent::<2>(kind);
            for (n, x) in mesh.nodes.iter().enumerate() {
                let at = locate(&mesh, 0..1, x).unwrap();
                assert!(mesh.blocks[0].cell(at.cell).contains(&n), "{kind:?} node {n}");
            }
            // The left side is x = 0.1 y^2.
            for x in [[-1e-6, 0.0], [0.02, 0.5], [0.5, 2.0], [1e6, 0.0]] {
                assert_eq!(locate(&mesh, 0..1, &x), None, "{kind:?}");
            }
        }
    }
}
