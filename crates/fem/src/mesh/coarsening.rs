//! Blocks whose cells become larger with the distance from one side, in steps of three to one.
//!
//! A layer of cells joins three columns into one along one axis. In the plane of that axis and of the distance, three cells
//! become four quadrilaterals that conform with the layers before and behind (Schneiders 1996, "Refining quadrilateral and
//! hexahedral element meshes"):
//!
//! ```text
//! far   0-----------3
//!       |\         /|
//!       | \       / |
//! mid   |  1-----2  |
//!       |  |     |  |
//! near  0--1-----2--3
//! ```
//!
//! In three dimensions one layer follows another, one for each axis of the side.

use super::generate::{Grid, name_sides};
use super::spacing::MOST_CELLS;
use super::{Cells, Mesh};
use crate::element::ElementKind;
use crate::error::FemError;
use std::ops::Range;

/// Number of columns that become one.
const JOINED: usize = 3;

/// Distances from a side of a block beyond which its cells become larger.
#[derive(Clone, Debug, PartialEq)]
pub struct Coarsening {
    /// Axis, and end of the axis, of the side at which the cells are those of the grid.
    pub side: [usize; 2],
    /// Distances from the side, ascending: beyond each of them three cells become one along every axis of the side \[m\].
    pub beyond: Vec<f64>,
}

/// Reasons why cells cannot be joined.
#[derive(Debug, thiserror::Error)]
pub enum CoarseningError {
    /// Another element.
    #[error("cells of `{0}` cannot be joined: `quad4` and `hex8` can")]
    Element(&'static str),
    /// No distance at all.
    #[error("no distance is given")]
    Empty,
    /// More cells than can be intended.
    #[error(
        "the block would have more than {MOST_CELLS} cells: a coarser size or a smaller first distance is needed"
    )]
    TooMany,
    /// A distance that is not above the one before it.
    #[error("the distance {0} m is not above that before it: distances are positive and ascend")]
    Distance(f64),
    /// Too few layers of cells.
    #[error(
        "beyond {beyond} m from the side there are {layers} layers of cells, and {needed} are needed to join cells: the block ends \
         at {depth} m"
    )]
    Layers {
        /// Given distance \[m\].
        beyond: f64,
        /// Layers that are left.
        layers: usize,
        /// Layers that are needed.
        needed: usize,
        /// Depth of the block \[m\].
        depth: f64,
    },
    /// No cells are small enough.
    #[error(
        "no three cells can be joined beyond {beyond} m from the side: along {axis} they would be longer than their distance from it"
    )]
    Long {
        /// Given distance \[m\].
        beyond: f64,
        /// Name of the axis.
        axis: &'static str,
    },
    /// The grid itself.
    #[error(transparent)]
    Grid(#[from] FemError),
}

impl Coarsening {
    /// The mesh of a grid whose cells are joined. Cells stay as they are where the joined ones would be longer than their
    /// distance from the side.
    ///
    /// # Errors
    /// [`CoarseningError`].
    pub fn mesh<const D: usize>(&self, grid: &Grid<D>) -> Result<Mesh<D>, CoarseningError> {
        if !matches!(grid.kind, ElementKind::Quad4 | ElementKind::Hex8) {
            return Err(CoarseningError::Element(grid.kind.name()));
        }
        if self.beyond.is_empty() {
            return Err(CoarseningError::Empty);
        }
        grid.check()?;
        if layer_of(&grid.lines, self.side[0]) > MOST_CELLS as f64 {
            return Err(CoarseningError::TooMany);
        }
        let mut stack = LayerStack::new(grid, self.side);
        for join in self.joins(&stack)? {
            let cells = stack.connectivity.len() / grid.kind.nodes();
            if cells as f64 + layer_of(&stack.lines, self.side[0]) > MOST_CELLS as f64 {
                return Err(CoarseningError::TooMany);
            }
            stack.layer(join)?;
        }
        let mut mesh = Mesh { nodes: stack.nodes, ..Mesh::default() };
        mesh.blocks.push(Cells { kind: grid.kind, connectivity: stack.connectivity });
        name_sides(&grid.lines, &mut mesh);
        Ok(mesh)
    }

    /// For each layer of cells, the axis along which it joins them and the distance that asks for it, if any.
    fn joins<const D: usize>(&self, stack: &LayerStack<D>) -> Result<Vec<Option<Join>>, CoarseningError> {
        let layers = stack.heights.len() - 1;
        let depth = stack.depth(layers);
        let mut joins = vec![None; layers];
        let (mut next, mut last) = (0, 0.0);
        for &beyond in &self.beyond {
            if !(beyond.is_finite() && beyond > last) {
                return Err(CoarseningError::Distance(beyond));
            }
            last = beyond;
            // Decimal input: a line that is meant to lie at the distance may be rounded to below it.
            let first =
                (next..layers).find(|&k| stack.depth(k) >= beyond * (1.0 - ROUNDING)).unwrap_or(layers);
            if layers - first < D - 1 {
                return Err(CoarseningError::Layers { beyond, layers: layers - first, needed: D - 1, depth });
            }
            for (k, axis) in (0..D).filter(|&axis| axis != self.side[0]).enumerate() {
                joins[first + k] = Some(Join { axis, beyond });
            }
            next = first + D - 1;
        }
        Ok(joins)
    }
}

/// Names of the axes.
const AXES: [&str; 3] = ["x", "y", "z"];

/// Relative difference of distances that counts as rounding of decimal input.
const ROUNDING: f64 = 1e-9;

/// A layer that joins cells.
#[derive(Clone, Copy)]
struct Join {
    axis: usize,
    beyond: f64,
}

/// Layers built so far, from the side inwards.
struct LayerStack<const D: usize> {
    side: [usize; 2],
    /// Positions of the layers along the axis of the side, from the side \[m\].
    heights: Vec<f64>,
    /// Grid lines of the last level; that along the axis of the side has its position alone.
    lines: [Vec<f64>; D],
    /// Nodes of the last level, x varying fastest.
    level: Vec<usize>,
    /// Number of layers.
    layers: usize,
    nodes: Vec<[f64; D]>,
    connectivity: Vec<usize>,
}

impl<const D: usize> LayerStack<D> {
    fn new(grid: &Grid<D>, side: [usize; 2]) -> Self {
        let [axis, end] = side;
        let mut heights = grid.lines[axis].clone();
        if end == 1 {
            heights.reverse();
        }
        let mut lines = grid.lines.clone();
        lines[axis] = vec![heights[0]];
        let mut stack = Self {
            side,
            heights,
            lines,
            level: Vec::new(),
            layers: 0,
            nodes: Vec::new(),
            connectivity: Vec::new(),
        };
        stack.level = stack.add(&stack.lines.clone());
        stack
    }

    /// Distance of a level from the side \[m\].
    fn depth(&self, level: usize) -> f64 {
        (self.heights[level] - self.heights[0]).abs()
    }

    /// Adds the nodes of a level.
    fn add(&mut self, lines: &[Vec<f64>; D]) -> Vec<usize> {
        let first = self.nodes.len();
        let count: usize = lines.iter().map(Vec::len).product();
        for k in 0..count {
            let at = places(lines, k);
            self.nodes.push(std::array::from_fn(|axis| lines[axis][at[axis]]));
        }
        (first..first + count).collect()
    }

    /// Adds a layer of cells.
    fn layer(&mut self, join: Option<Join>) -> Result<(), CoarseningError> {
        let (near, far) = (self.heights[self.layers], self.heights[self.layers + 1]);
        // Without a join the cells of any axis of the side may be taken as columns.
        let along = join.map_or(usize::from(self.side[0] == 0), |join| join.axis);
        let columns = match join {
            None => (1..self.lines[along].len()).map(|k| k - 1..k).collect(),
            Some(join) => {
                let longest = self.depth(self.layers);
                columns(&self.lines[along], longest)
                    .ok_or(CoarseningError::Long { beyond: join.beyond, axis: AXES[along] })?
            }
        };
        let mut lines = self.lines.clone();
        lines[self.side[0]] = vec![far];
        lines[along] = columns
            .iter()
            .map(|c| c.start)
            .chain(columns.last().map(|c| c.end))
            .map(|k| self.lines[along][k])
            .collect();
        let level = self.add(&lines);
        let mut mid = self.lines.clone();
        mid[self.side[0]] = vec![0.5 * (near + far)];
        mid[along] = columns
            .iter()
            .filter(|c| c.len() > 1)
            .flat_map(|c| c.start + 1..c.end)
            .map(|k| self.lines[along][k])
            .collect();
        let middle = self.add(&mid);
        let levels = [(&self.lines, &self.level), (&mid, &middle), (&lines, &level)];
        self.connectivity.extend(self.across(along, &quadrilaterals(&columns), levels));
        (self.lines, self.level) = (lines, level);
        self.layers += 1;
        Ok(())
    }

    /// Nodes of the cells of quadrilaterals in the plane of the axis `along` and of the distance, all along the third axis.
    /// Corners are levels and places along the axis.
    fn across(
        &self,
        along: usize,
        cells: &[[(usize, usize); 4]],
        levels: [(&[Vec<f64>; D], &Vec<usize>); 3],
    ) -> Vec<usize> {
        let third = (0..D).find(|&axis| axis != along && axis != self.side[0]);
        let node = |(level, place): (usize, usize), beside: usize| {
            let (lines, nodes) = levels[level];
            let mut at = [0; D];
            at[along] = place;
            if let Some(third) = third {
                at[third] = beside;
            }
            nodes[number(lines, at)]
        };
        // The axes (along, distance, third) are right-handed, or corners run the other way round.
        let even = match third {
            None => along == 0,
            Some(third) => (third + D - along) % D == 2,
        };
        let turned = even == (self.side[1] == 1);
        let ordered = |cell: &[(usize, usize); 4]| {
            let [a, b, c, d] = *cell;
            if turned { [a, d, c, b] } else { [a, b, c, d] }
        };
        let mut connectivity = Vec::new();
        let layers = third.map_or(1, |third| self.lines[third].len() - 1);
        for beside in 0..layers {
            for cell in cells {
                let ordered = ordered(cell);
                connectivity.extend(ordered.map(|corner| node(corner, beside)));
                if third.is_some() {
                    connectivity.extend(ordered.map(|corner| node(corner, beside + 1)));
                }
            }
        }
        connectivity
    }
}

/// Number of cells of a layer across an axis. It may exceed what an integer holds.
fn layer_of<const D: usize>(lines: &[Vec<f64>; D], across: usize) -> f64 {
    (0..D).filter(|&axis| axis != across).map(|axis| (lines[axis].len() - 1) as f64).product()
}

/// Cells of a layer in the plane of its columns and of the distance: one for each column of one cell, and the four of the
/// template for each of three. A corner is its level (near, mid, far) and its place along the level.
fn quadrilaterals(columns: &[Range<usize>]) -> Vec<[(usize, usize); 4]> {
    let mut cells = Vec::new();
    let mut inner = 0;
    for (place, column) in columns.iter().enumerate() {
        let [a, b] = [(0, column.start), (0, column.end)];
        let [c, d] = [(2, place), (2, place + 1)];
        if column.len() == 1 {
            cells.push([a, b, d, c]);
            continue;
        }
        let [p, q] = [(0, column.start + 1), (0, column.start + 2)];
        let [r, s] = [(1, inner), (1, inner + 1)];
        cells.extend([[a, p, r, c], [p, q, s, r], [q, b, d, s], [r, s, d, c]]);
        inner += 2;
    }
    cells
}

/// Columns of three cells where they are at most `longest` long, and of one cell elsewhere; `None` if all are of one. They are
/// symmetric about the middle of each run of short cells.
fn columns(line: &[f64], longest: f64) -> Option<Vec<Range<usize>>> {
    let cells = line.len() - 1;
    let short = |k: usize| JOINED as f64 * (line[k + 1] - line[k]) <= longest * (1.0 + ROUNDING);
    let mut columns = Vec::new();
    let mut k = 0;
    while k < cells {
        let run = (k..cells).take_while(|&c| short(c)).count();
        if run == 0 {
            columns.push(k..k + 1);
            k += 1;
            continue;
        }
        columns.extend(divided(run).into_iter().scan(k, |at, length| {
            *at += length;
            Some(*at - length..*at)
        }));
        k += run;
    }
    columns.iter().any(|c| c.len() > 1).then_some(columns)
}

/// Lengths of the columns of a run of cells, symmetric about its middle. One remaining cell lies in the middle if both halves are
/// equal; otherwise the remaining cells lie at the ends.
fn divided(run: usize) -> Vec<usize> {
    let (threes, left) = (run / JOINED, run % JOINED);
    let (ends, middle, threes) = match left {
        1 if threes % 2 == 1 => (2, 0, threes - 1),
        1 => (0, 1, threes),
        left => (left / 2, 0, threes),
    };
    let ends = vec![1; ends];
    let half = vec![JOINED; threes / 2];
    let centre = if middle == 1 { vec![1] } else { vec![JOINED; threes % 2] };
    [&ends, &half, &centre, &half, &ends].into_iter().flatten().copied().collect()
}

/// Places along the axes of an entry of a level, x varying fastest.
fn places<const D: usize>(lines: &[Vec<f64>; D], mut entry: usize) -> [usize; D] {
    std::array::from_fn(|axis| {
        let place = entry % lines[axis].len();
        entry /= lines[axis].len();
        place
    })
}

/// The entry of a level at these places.
fn number<const D: usize>(lines: &[Vec<f64>; D], at: [usize; D]) -> usize {
    (0..D).rev().fold(0, |entry, axis| entry * lines[axis].len() + at[axis])
}
