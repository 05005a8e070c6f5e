//! Structured, graded meshes of rectangular blocks.
//!
//! [`super::curve`] bends their sides.

use super::{Cells, Mesh, Side};
use crate::element::ElementKind;
use crate::error::FemError;

/// Variation of element sizes along an axis.
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
    /// Number of elements along each axis.
    pub divisions: [usize; D],
    /// Grading along each axis.
    pub grading: [Grading; D],
    /// Element.
    pub kind: ElementKind,
}

/// Names of the side sets: lower and upper end of each axis.
pub const SIDES: [[&str; 2]; 3] = [["left", "right"], ["bottom", "top"], ["back", "front"]];

/// Largest relative deviation from a whole number of elements that counts as rounding of decimal input.
const WHOLE: f64 = 1e-9;

/// Number of elements of `size` along `length`.
///
/// # Errors
/// [`FemError::Size`] if it does not divide the length evenly, with the nearest size that does.
pub fn divisions_for(length: f64, size: f64) -> Result<usize, FemError> {
    let ratio = length / size;
    let n = ratio.round();
    if n >= 1.0 && (ratio - n).abs() <= WHOLE * n {
        return Ok(n as usize);
    }
    Err(FemError::Size { size, length, suggestion: length / n.max(1.0) })
}

impl<const D: usize> Block<D> {
    /// Generates the mesh; x varies fastest.
    ///
    /// # Errors
    /// If the block is empty, a ratio is not positive, or the element has a different dimension.
    pub fn mesh(&self) -> Result<Mesh<D>, FemError> {
        self.grid()?.mesh()
    }

    /// The grid of the block.
    ///
    /// # Errors
    /// If the block is empty or a ratio is not positive.
    pub fn grid(&self) -> Result<Grid<D>, FemError> {
        self.check()?;
        Ok(Grid { lines: std::array::from_fn(|axis| self.line(axis)), kind: self.kind })
    }

    fn check(&self) -> Result<(), FemError> {
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

    /// Positions of the grid lines along an axis.
    fn line(&self, axis: usize) -> Vec<f64> {
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
        (0..=n).map(|k| (1.0 - part(k)) * min + part(k) * max).collect()
    }
}

/// A block with given grid lines between its cells. Its side sets are those of [`Block`].
#[derive(Clone, Debug, PartialEq)]
pub struct Grid<const D: usize> {
    /// Positions along each axis, ascending, both ends included \[m\].
    pub lines: [Vec<f64>; D],
    /// Element; nodes of second order lie midway.
    pub kind: ElementKind,
}

impl<const D: usize> Grid<D> {
    /// Generates the mesh; x varies fastest.
    ///
    /// # Errors
    /// If lines do not ascend or the element has a different dimension.
    pub fn mesh(&self) -> Result<Mesh<D>, FemError> {
        self.check()?;
        let order = self.kind.order();
        let lines: Vec<Vec<f64>> = self.lines.iter().map(|line| with_middles(line, order)).collect();
        let counts: Vec<usize> = lines.iter().map(Vec::len).collect();
        let parts = self.parts();
        let mut connectivity = Vec::new();
        let cells: [usize; D] = std::array::from_fn(|axis| self.lines[axis].len() - 1);
        for k in 0..if D > 2 { cells[D - 1] } else { 1 } {
            for j in 0..cells[1] {
                for i in 0..cells[0] {
                    let first = [order * i, order * j, order * k];
                    for offset in parts.iter().flatten() {
                        let [x, y, z] = std::array::from_fn(|c| first[c] + offset[c]);
                        let layers = if D > 2 { z * counts[1] } else { 0 };
                        connectivity.push((layers + y) * counts[0] + x);
                    }
                }
            }
        }
        let nodes = used(grid_nodes(&lines, &counts), &mut connectivity);
        let mut mesh = Mesh { nodes, ..Mesh::default() };
        mesh.blocks.push(Cells { kind: self.kind, connectivity });
        name_sides(&self.lines, &mut mesh);
        Ok(mesh)
    }

    pub(super) fn check(&self) -> Result<(), FemError> {
        if self.kind.dimension() != D {
            return Err(FemError::Dimension { element: self.kind.name(), dimension: D });
        }
        for (axis, line) in self.lines.iter().enumerate() {
            let ascends = |k: usize| line[k].is_finite() && line[k] > line[k - 1];
            let bad = (1..line.len()).find(|&k| !ascends(k)).or_else(|| (line.len() < 2).then_some(0));
            if let Some(index) = bad {
                return Err(FemError::GridLine { axis, index });
            }
        }
        Ok(())
    }

    /// The cells of one grid position, each as the grid steps of its nodes from the lower corner: one quadrilateral or two
    /// triangles; one hexahedron, two wedges, or six tetrahedra. The split is the same everywhere, and its diagonals on opposite
    /// faces are parallel, so that cells conform.
    fn parts(&self) -> Vec<Vec<[usize; 3]>> {
        let corners: Vec<Vec<usize>> = match self.kind.linear() {
            ElementKind::Tri3 => vec![vec![0, 1, 2], vec![0, 2, 3]],
            ElementKind::Wedge6 => vec![vec![0, 1, 2, 4, 5, 6], vec![0, 2, 3, 4, 6, 7]],
            // Kuhn's split: around the diagonal from corner 0 to corner 6.
            ElementKind::Tet4 => [[1, 2], [2, 3], [3, 7], [7, 4], [4, 5], [5, 1]]
                .into_iter()
                .map(|[a, b]| vec![0, a, b, 6])
                .collect(),
            linear => vec![(0..linear.nodes()).collect()],
        };
        corners.iter().map(|c| self.nodes_between(c)).collect()
    }

    /// Grid steps of the nodes of a cell with these corners of the hexahedron: second-order nodes lie midway.
    fn nodes_between(&self, corners: &[usize]) -> Vec<[usize; 3]> {
        let step = self.kind.order() as f64;
        let place = |xi: &[f64; 3]| {
            let shape = self.kind.linear().shape(*xi);
            // Shape functions of first order at nodes of second order are multiples of 1/8, so that sums are exact.
            std::array::from_fn(|c| {
                corners.iter().zip(&shape.n).map(|(&k, n)| n * step * HEX[k][c] as f64).sum::<f64>() as usize
            })
        };
        self.kind.node_coordinates().iter().map(place).collect()
    }
}

/// Names the faces on the sides of a mesh of one block of cells with these outermost grid lines.
pub(super) fn name_sides<const D: usize>(lines: &[Vec<f64>; D], mesh: &mut Mesh<D>) {
    let block = &mesh.blocks[0];
    let mut sets: Vec<(String, Vec<Side>)> = Vec::new();
    for (axis, names) in SIDES.iter().enumerate().take(D) {
        for (end, name) in names.iter().enumerate() {
            let line = &lines[axis];
            let value = line[if end == 0 { 0 } else { line.len() - 1 }];
            let mut sides = Vec::new();
            for cell in 0..block.len() {
                let nodes = block.cell(cell);
                for (face, local) in block.kind.faces().iter().enumerate() {
                    // Ends of a line are placed exactly, so that the comparison with `==` is intended.
                    if local.nodes.iter().all(|&a| mesh.nodes[nodes[a]][axis] == value) {
                        sides.push(Side { block: 0, cell, face });
                    }
                }
            }
            sets.push(((*name).to_string(), sides));
        }
    }
    mesh.side_sets.extend(sets);
}

/// Corners of a hexahedron in the order of the element.
const HEX: [[usize; 3]; 8] =
    [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]];

/// Grid lines; for elements of second order, with those midway.
fn with_middles(line: &[f64], order: usize) -> Vec<f64> {
    if order == 1 {
        return line.to_vec();
    }
    let pairs = line.windows(2).flat_map(|w| [w[0], 0.5 * (w[0] + w[1])]);
    pairs.chain(line.last().copied()).collect()
}

/// Keeps the nodes used by cells, in their order, and renumbers the cells: serendipity elements omit centres.
fn used<const D: usize>(nodes: Vec<[f64; D]>, connectivity: &mut [usize]) -> Vec<[f64; D]> {
    let mut number = vec![usize::MAX; nodes.len()];
    connectivity.iter().for_each(|&n| number[n] = 0);
    let mut kept = Vec::with_capacity(nodes.len());
    for (number, x) in number.iter_mut().zip(nodes) {
        if *number == 0 {
            *number = kept.len();
            kept.push(x);
        }
    }
    connectivity.iter_mut().for_each(|n| *n = number[*n]);
    kept
}

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
