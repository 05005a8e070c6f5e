//! Structured, graded meshes of rectangular blocks.

use super::{Cells, Mesh, Side};
use crate::element::ElementKind;
use crate::error::FemError;

/// How element sizes vary along an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Grading {
    /// Equal sizes.
    Uniform,
    /// Geometric sequence of sizes.
    Geometric {
        /// Last size over first size \[-\].
        ratio: f64,
    },
}

/// A rectangular block. Its side sets are left, right (x), bottom, top (y), back, front (z).
#[derive(Clone, Debug, PartialEq)]
pub struct Block<const D: usize> {
    /// Lower corner \[m\].
    pub min: [f64; D],
    /// Upper corner \[m\].
    pub max: [f64; D],
    /// Elements along each axis.
    pub divisions: [usize; D],
    /// Grading along each axis.
    pub grading: [Grading; D],
    /// Element.
    pub kind: ElementKind,
}

/// Names of the side sets: lower and upper end of each axis.
pub const SIDES: [[&str; 2]; 3] = [["left", "right"], ["bottom", "top"], ["back", "front"]];

/// Relative deviation from a whole number of elements that is rounding of decimal input.
const WHOLE: f64 = 1e-9;

/// Elements of `size` along `length`.
///
/// # Errors
/// [`FemError::Size`] when it does not divide the length, with the nearest size that does.
pub fn divisions_for(length: f64, size: f64) -> Result<usize, FemError> {
    let ratio = length / size;
    let n = ratio.round();
    if n >= 1.0 && (ratio - n).abs() <= WHOLE * n {
        return Ok(n as usize);
    }
    Err(FemError::Size { size, length, suggestion: length / n.max(1.0) })
}

impl<const D: usize> Block<D> {
    /// Generates the mesh; x runs fastest.
    ///
    /// # Errors
    /// When the block is empty, a ratio is not positive, or the element has another dimension.
    pub fn mesh(&self) -> Result<Mesh<D>, FemError> {
        self.check()?;
        let order = if matches!(self.kind, ElementKind::Tri6 | ElementKind::Quad9) { 2 } else { 1 };
        let lines: Vec<Vec<f64>> = (0..D).map(|axis| self.line(axis, order)).collect();
        let counts: Vec<usize> = lines.iter().map(Vec::len).collect();
        let mut mesh = Mesh { nodes: grid_nodes(&lines, &counts), ..Mesh::default() };
        let mut connectivity = Vec::new();
        let cells = self.divisions;
        for k in 0..if D > 2 { cells[D - 1] } else { 1 } {
            for j in 0..cells[1] {
                for i in 0..cells[0] {
                    self.cell([i, j, k], order, &counts, &mut connectivity);
                }
            }
        }
        mesh.blocks.push(Cells { kind: self.kind, connectivity });
        self.name_sides(&mut mesh);
        Ok(mesh)
    }

    fn check(&self) -> Result<(), FemError> {
        if self.kind.dimension() != D {
            return Err(FemError::Dimension { element: self.kind.name(), dimension: D });
        }
        for axis in 0..D {
            let (min, max, divisions) = (self.min[axis], self.max[axis], self.divisions[axis]);
            if divisions == 0 || !(max - min).is_finite() || max <= min {
                return Err(FemError::Block { axis, min, max, divisions });
            }
            if let Grading::Geometric { ratio } = self.grading[axis]
                && !(ratio > 0.0 && ratio.is_finite())
            {
                return Err(FemError::Grading(ratio));
            }
        }
        Ok(())
    }

    /// Node positions along an axis, mid-nodes included for elements of second order.
    fn line(&self, axis: usize, order: usize) -> Vec<f64> {
        let (n, min, max) = (self.divisions[axis], self.min[axis], self.max[axis]);
        let ratio = match self.grading[axis] {
            Grading::Uniform => 1.0,
            Grading::Geometric { ratio } => ratio,
        };
        let q = if n > 1 { ratio.powf(1.0 / (n as f64 - 1.0)) } else { 1.0 };
        let part = |k: usize| {
            if q == 1.0 { k as f64 / n as f64 } else { (q.powi(k as i32) - 1.0) / (q.powi(n as i32) - 1.0) }
        };
        // (1-s) min + s max is exact at both ends.
        let at = |s: f64| (1.0 - s) * min + s * max;
        (0..=n * order)
            .map(|k| {
                let (cell, within) = (k / order, k % order);
                if within == 0 { at(part(cell)) } else { at(0.5 * (part(cell) + part(cell + 1))) }
            })
            .collect()
    }

    /// Adds the cells of one grid position: one, two triangles, or six tetrahedra.
    fn cell(&self, [i, j, k]: [usize; 3], order: usize, counts: &[usize], connectivity: &mut Vec<usize>) {
        let at = |di: usize, dj: usize, dk: usize| {
            let z = if D > 2 { k + dk } else { 0 };
            (z * counts[1] + j * order + dj) * counts[0] + i * order + di
        };
        let mut add = |nodes: &[[usize; 3]]| {
            connectivity.extend(nodes.iter().map(|&[a, b, c]| at(a, b, c)));
        };
        match self.kind {
            ElementKind::Quad4 => add(&[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]),
            ElementKind::Tri3 => {
                add(&[[0, 0, 0], [1, 0, 0], [1, 1, 0]]);
                add(&[[0, 0, 0], [1, 1, 0], [0, 1, 0]]);
            }
            ElementKind::Quad9 => add(&[
                [0, 0, 0],
                [2, 0, 0],
                [2, 2, 0],
                [0, 2, 0],
                [1, 0, 0],
                [2, 1, 0],
                [1, 2, 0],
                [0, 1, 0],
                [1, 1, 0],
            ]),
            ElementKind::Tri6 => {
                add(&[[0, 0, 0], [2, 0, 0], [2, 2, 0], [1, 0, 0], [2, 1, 0], [1, 1, 0]]);
                add(&[[0, 0, 0], [2, 2, 0], [0, 2, 0], [1, 1, 0], [1, 2, 0], [0, 1, 0]]);
            }
            ElementKind::Hex8 => add(&HEX),
            ElementKind::Tet4 => {
                // The Kuhn split: six tetrahedra around the diagonal from corner 0 to corner 6, conforming between cells.
                for [a, b] in [[1, 2], [2, 3], [3, 7], [7, 4], [4, 5], [5, 1]] {
                    add(&[HEX[0], HEX[a], HEX[b], HEX[6]]);
                }
            }
        }
    }

    fn name_sides(&self, mesh: &mut Mesh<D>) {
        let block = &mesh.blocks[0];
        let mut sets: Vec<(String, Vec<Side>)> = Vec::new();
        for (axis, names) in SIDES.iter().enumerate().take(D) {
            for (end, name) in names.iter().enumerate() {
                let value = if end == 0 { self.min[axis] } else { self.max[axis] };
                let mut sides = Vec::new();
                for cell in 0..block.len() {
                    let nodes = block.cell(cell);
                    for (face, local) in block.kind.faces().iter().enumerate() {
                        // Ends of a line are placed exactly, so that equality is meant.
                        if local.iter().all(|&a| mesh.nodes[nodes[a]][axis] == value) {
                            sides.push(Side { block: 0, cell, face });
                        }
                    }
                }
                sets.push(((*name).to_string(), sides));
            }
        }
        mesh.side_sets.extend(sets);
    }
}

/// Corners of a hexahedron in the order of the element.
const HEX: [[usize; 3]; 8] =
    [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]];

fn grid_nodes<const D: usize>(lines: &[Vec<f64>], counts: &[usize]) -> Vec<[f64; D]> {
    let total: usize = counts.iter().product();
    (0..total)
        .map(|mut k| {
            std::array::from_fn(|axis| {
                let index = k % counts[axis];
                k /= counts[axis];
                lines[axis][index]
            })
        })
        .collect()
}
