//! Gradients of the shape functions at the quadrature points of a block, stored flat.

use crate::element::Shape;
use crate::error::FemError;
use crate::kinematics::Idealisation;
use crate::mesh::{Cells, Mesh};
use nalgebra::SMatrix;
use rayon::prelude::*;

/// Cells treated by one task: fixed, so that results do not depend on the number of threads.
pub(super) const CHUNK: usize = 256;

/// Geometry of all cells of a block.
#[derive(Clone, Debug)]
pub(super) struct Geometry<const D: usize> {
    /// Nodes of a cell.
    nodes: usize,
    /// Quadrature points of a cell.
    points: usize,
    /// ∂N_a/∂x \[1/m\]: cell, point, node.
    gradients: Vec<[f64; D]>,
    /// Weight times Jacobian, times 2πr about an axis \[m^D or m³\]: cell, point.
    volumes: Vec<f64>,
    /// Positions of the points \[m\]: cell, point.
    positions: Vec<[f64; D]>,
    /// N_a of the rule: point, node.
    shapes: Vec<f64>,
    idealisation: Idealisation,
}

/// Geometry of one cell.
#[derive(Clone, Copy)]
pub(super) struct CellGeometry<'a, const D: usize> {
    nodes: usize,
    gradients: &'a [[f64; D]],
    /// Volume of each point.
    pub volumes: &'a [f64],
    /// Position of each point.
    pub positions: &'a [[f64; D]],
    shapes: &'a [f64],
    axisymmetric: bool,
}

impl<const D: usize> Geometry<D> {
    /// Computes the gradients of `cells`, accepted by [`check`], at the points of the idealisation's rule.
    pub fn new(places: &Places<D>, cells: &Cells, idealisation: Idealisation) -> Self {
        let rule = rule(cells, idealisation);
        let (nodes, points) = (cells.kind.nodes(), rule.len());
        let mut result = Self {
            nodes,
            points,
            gradients: vec![[0.0; D]; cells.len() * points * nodes],
            volumes: vec![0.0; cells.len() * points],
            positions: vec![[0.0; D]; cells.len() * points],
            shapes: rule.iter().flat_map(|(s, _)| s.n[..nodes].to_vec()).collect(),
            idealisation,
        };
        result
            .gradients
            .par_chunks_mut(CHUNK * points * nodes)
            .zip(result.volumes.par_chunks_mut(CHUNK * points))
            .zip(result.positions.par_chunks_mut(CHUNK * points))
            .enumerate()
            .for_each(|(chunk, ((gradients, volumes), positions))| {
                for (k, volume) in volumes.iter_mut().enumerate() {
                    let (cell, (shape, weight)) = (chunk * CHUNK + k / points, &rule[k % points]);
                    let (x, j) = place(places, cells.cell(cell), shape);
                    // An inverted cell was refused; a NaN would show in the stiffness.
                    let inverse = j.try_inverse().unwrap_or_else(|| j.map(|_| f64::NAN));
                    for (a, g) in gradients[k * nodes..(k + 1) * nodes].iter_mut().enumerate() {
                        *g = std::array::from_fn(|i| {
                            (0..D).map(|m| shape.dn[a][m] * inverse[(m, i)]).sum::<f64>()
                        });
                    }
                    positions[k] = x;
                    *volume = weight * determinant(&j) * idealisation.weight(&x);
                }
            });
        result
    }

    /// One cell.
    pub fn cell(&self, cell: usize) -> CellGeometry<'_, D> {
        let points = cell * self.points..(cell + 1) * self.points;
        CellGeometry {
            nodes: self.nodes,
            gradients: &self.gradients[points.start * self.nodes..points.end * self.nodes],
            volumes: &self.volumes[points.clone()],
            positions: &self.positions[points],
            shapes: &self.shapes,
            axisymmetric: self.idealisation == Idealisation::Axisymmetric,
        }
    }
}

impl<const D: usize> CellGeometry<'_, D> {
    /// Gradients of all nodes at a point.
    pub fn gradients(&self, point: usize) -> &[[f64; D]] {
        &self.gradients[point * self.nodes..(point + 1) * self.nodes]
    }

    /// Shape functions of all nodes at a point.
    pub fn shapes(&self, point: usize) -> &[f64] {
        &self.shapes[point * self.nodes..(point + 1) * self.nodes]
    }

    /// 1/r at a point, the factor from u_r to hoop strain \[1/m\]; 0 without an axis. Points lie inside cells, so that r > 0.
    pub fn hoop(&self, point: usize) -> f64 {
        if self.axisymmetric { 1.0 / self.positions[point][0] } else { 0.0 }
    }
}

/// Shape functions and weights of the points of a cell.
fn rule(cells: &Cells, idealisation: Idealisation) -> Vec<(Shape, f64)> {
    let points = idealisation.quadrature(cells.kind).into_iter();
    points.map(|(xi, w)| (cells.kind.shape(xi), w)).collect()
}

/// Checks that all cells of block number `block` are oriented correctly and lie right of the axis; nothing is kept.
///
/// # Errors
/// [`FemError::Jacobian`] naming the first inverted cell, [`FemError::Radius`] naming the first node left of the axis.
pub(super) fn check<const D: usize>(
    mesh: &Mesh<D>,
    cells: &Cells,
    block: usize,
    idealisation: Idealisation,
) -> Result<(), FemError> {
    check_radii(mesh, cells, idealisation)?;
    let rule = rule(cells, idealisation);
    // In order: the first bad cell is named, whichever thread found it.
    let first_bad = (0..cells.len()).into_par_iter().with_min_len(CHUNK).find_map_first(|cell| {
        let at = |(shape, _): &(Shape, f64)| determinant(&place(&mesh.nodes, cells.cell(cell), shape).1);
        let mut bad = rule.iter().map(at).filter(|d| d.is_nan() || *d <= 0.0);
        bad.next().map(|determinant| FemError::Jacobian { block, cell, determinant })
    });
    first_bad.map_or(Ok(()), Err)
}

/// Positions of the nodes of a block \[m\].
#[derive(Clone, Debug)]
pub(super) struct Places<const D: usize> {
    /// Number of the first node.
    first: usize,
    nodes: Vec<[f64; D]>,
}

impl<const D: usize> Places<D> {
    /// Positions of the nodes from the lowest to the highest number in `cells`.
    pub fn new(mesh: &Mesh<D>, cells: &Cells) -> Self {
        let first = cells.connectivity.iter().copied().min().unwrap_or(0);
        let end = cells.connectivity.iter().map(|n| n + 1).max().unwrap_or(first);
        Self { first, nodes: mesh.nodes[first..end].to_vec() }
    }
}

/// Nodes that have positions.
pub(super) trait Positions<const D: usize> {
    /// Position \[m\].
    fn position(&self, node: usize) -> &[f64; D];
}

impl<const D: usize> Positions<D> for Places<D> {
    fn position(&self, node: usize) -> &[f64; D] {
        &self.nodes[node - self.first]
    }
}

impl<const D: usize> Positions<D> for Vec<[f64; D]> {
    fn position(&self, node: usize) -> &[f64; D] {
        &self[node]
    }
}

/// Refuses nodes left of the axis of revolution; nodes on it are allowed.
fn check_radii<const D: usize>(
    mesh: &Mesh<D>,
    cells: &Cells,
    idealisation: Idealisation,
) -> Result<(), FemError> {
    if idealisation != Idealisation::Axisymmetric {
        return Ok(());
    }
    match cells.connectivity.iter().copied().filter(|&n| mesh.nodes[n][0] < 0.0).min() {
        Some(node) => Err(FemError::Radius { node, radius: mesh.nodes[node][0] }),
        None => Ok(()),
    }
}

/// Position and Jacobian ∂x_i/∂ξ_m of a point of a cell.
pub(super) fn place<const D: usize>(
    places: &impl Positions<D>,
    nodes: &[usize],
    shape: &Shape,
) -> ([f64; D], SMatrix<f64, D, D>) {
    let mut x = [0.0; D];
    let mut j = SMatrix::<f64, D, D>::zeros();
    for (a, &node) in nodes.iter().enumerate() {
        let at = places.position(node);
        for i in 0..D {
            x[i] += at[i] * shape.n[a];
            for m in 0..D {
                j[(i, m)] += at[i] * shape.dn[a][m];
            }
        }
    }
    (x, j)
}

/// Determinant of a 2x2 or 3x3 matrix.
pub(crate) fn determinant<const D: usize>(j: &SMatrix<f64, D, D>) -> f64 {
    if D == 2 {
        return j[(0, 0)] * j[(1, 1)] - j[(0, 1)] * j[(1, 0)];
    }
    let minor = |a: usize, b: usize| j[(1, a)] * j[(2, b)] - j[(1, b)] * j[(2, a)];
    j[(0, 0)] * minor(1, 2) - j[(0, 1)] * minor(0, 2) + j[(0, 2)] * minor(0, 1)
}
