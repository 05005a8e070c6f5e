//! Outlines of the cells of faults in rock, for distances between them.

use super::super::super::plan::{CellGrid, Outline};
use super::super::spacing::cell::Cell;
use super::tiling::{Cut, Tiling};
use nalgebra::Vector3;
use std::collections::BTreeMap;

/// Cells of all faults.
pub(super) fn cells<const D: usize>(tiling: &Tiling<D>) -> Vec<Cell> {
    let of = |(fault, cut): (usize, &Cut<D>)| match (&cut.outline, &cut.grid, &cut.ends) {
        (Some(outline), _, _) => triangles((fault, &cut.widths), outline),
        (None, Some(grid), _) => rectangles((fault, &cut.widths), grid),
        (None, None, ends) => segments((fault, &cut.widths), ends),
    };
    tiling.faults.iter().enumerate().flat_map(of).collect()
}

/// Cells of a line, from its upper end.
fn segments((fault, widths): (usize, &[f64]), ends: &[[[f64; 2]; 2]]) -> Vec<Cell> {
    let mut along = 0.0;
    let cell = |(k, [lower, upper]): (usize, &[[f64; 2]; 2])| {
        let from = along;
        along += widths[k];
        Cell {
            fault,
            corners: [upper, lower].map(|x| Vector3::new(x[0], x[1], 0.0)).to_vec(),
            vertices: vec![k, k + 1],
            rim: vec![k == 0, k + 1 == ends.len()],
            width: widths[k],
            along: Some([from, along]),
        }
    };
    ends.iter().enumerate().map(cell).collect()
}

/// Cells of a rectangle, row by row.
fn rectangles((fault, widths): (usize, &[f64]), grid: &CellGrid) -> Vec<Cell> {
    let CellGrid { columns, rows, cell: [length, width], from, along, down } = *grid;
    let [from, along, down] = [from, along, down].map(Vector3::from);
    let node =
        |column: usize, row: usize| from + along * (column as f64 * length) + down * (row as f64 * width);
    let cell = |k: usize| {
        let [column, row] = [k % columns, k / columns];
        let around = [[column, row], [column + 1, row], [column + 1, row + 1], [column, row + 1]];
        Cell {
            fault,
            corners: around.map(|[c, r]| node(c, r)).to_vec(),
            vertices: around.map(|[c, r]| r * (columns + 1) + c).to_vec(),
            rim: vec![row == 0, column + 1 == columns, row + 1 == rows, column == 0],
            width: widths[k],
            along: None,
        }
    };
    (0..columns * rows).map(cell).collect()
}

/// Triangles of a surface.
fn triangles((fault, widths): (usize, &[f64]), outline: &Outline) -> Vec<Cell> {
    let edges = |corners: &[usize; 3]| {
        let [a, b, c] = *corners;
        [[a, b], [b, c], [c, a]].map(|[a, b]| [a.min(b), a.max(b)])
    };
    let mut uses: BTreeMap<[usize; 2], usize> = BTreeMap::new();
    outline.corners.iter().flat_map(edges).for_each(|edge| *uses.entry(edge).or_default() += 1);
    let cell = |(corners, &width): (&[usize; 3], &f64)| Cell {
        fault,
        corners: corners.map(|n| Vector3::from(outline.nodes[n])).to_vec(),
        vertices: corners.to_vec(),
        rim: edges(corners).map(|edge| uses[&edge] == 1).to_vec(),
        width,
        along: None,
    };
    outline.corners.iter().zip(widths).map(cell).collect()
}
