//! Elimination of fronts of any size: recursive halving of the columns, on faer's dense kernels.
//!
//! Large fronts are cut into tiles whose size depends only on the front, each computed by one thread: the bits do not depend on
//! the number of threads.

use super::kernel::{Breakdown, Elimination, Update};
use faer::linalg::matmul::matmul;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{Accum, MatMut, MatRef, Par};
use pulp::Arch;
use rayon::prelude::*;

/// Columns eliminated by the small kernel at once.
const SMALL: usize = 32;

/// Number of rows from which the rows below the pivots of these few columns are cut into tiles.
const SMALL_TILES: usize = 1024;

/// Rows of a tile.
const TILE: usize = 512;

/// Number of operations from which work is cut into tiles: about 0.1 ms.
const WORTH_TILES: f64 = 4e6;

/// Number of rows up to which the small kernel forms the contribution of a front: it has no cache blocking.
const SMALL_ROWS: usize = 96;

/// Eliminates the columns of a front, column by column in `values` with `rows` entries each. `smallest` are the smallest
/// admissible pivots.
///
/// # Errors
/// The first column without a pivot.
pub(super) fn eliminate(
    arch: Arch,
    values: &mut [f64],
    stride: usize,
    rows: usize,
    smallest: &[f64],
) -> Result<(), Breakdown> {
    let columns = smallest.len();
    if columns <= SMALL {
        return few_columns(arch, values, stride, rows, smallest);
    }
    // Halves: nearly all work is in products of the widest blocks available.
    let half = (columns / 2).next_multiple_of(SMALL);
    eliminate(arch, values, stride, rows, &smallest[..half])?;
    let (left, right) = values.split_at_mut(half * stride);
    let (below, others) = (rows - half, columns - half);
    let rest = &mut right[half..];
    subtract_product(view_mut(rest, below, others, stride), view(&left[half..], below, half, stride));
    eliminate(arch, rest, stride, below, &smallest[half..]).map_err(|(k, pivot)| (half + k, pivot))
}

/// Runs the small kernel, only on the pivots' rows if there are many others.
fn few_columns(
    arch: Arch,
    values: &mut [f64],
    stride: usize,
    rows: usize,
    smallest: &[f64],
) -> Result<(), Breakdown> {
    let columns = smallest.len();
    if rows < SMALL_TILES {
        return arch.dispatch(Elimination { values, stride, rows, columns, smallest });
    }
    arch.dispatch(Elimination { values: &mut *values, stride, rows: columns, columns, smallest })?;
    let (pivots, rest) = view_mut(values, rows, columns, stride).split_at_row_mut(columns);
    let pivots = pivots.as_ref();
    row_tiles(rest).into_par_iter().with_max_len(1).for_each(|(_, tile)| {
        solve_lower_triangular_in_place(pivots, tile.transpose_mut(), Par::Seq);
    });
    Ok(())
}

/// Writes the lower triangle of `-L L'` into `result` (rows by rows, column by column), where L are the rows of a front's
/// columns below its pivots.
pub(super) fn update(arch: Arch, result: &mut [f64], l: &[f64], stride: usize, rows: usize, columns: usize) {
    if rows <= SMALL_ROWS {
        arch.dispatch(Update { result, a: l, stride, rows, columns });
        return;
    }
    let a = view(l, rows, columns, stride);
    let target = view_mut(result, rows, rows, rows);
    if (rows * rows * columns) as f64 <= WORTH_TILES {
        square(target, Accum::Replace, a);
        return;
    }
    let mut tiles = Vec::new();
    let mut rest = target;
    let mut start = 0;
    while start < rows {
        let width = TILE.min(rows - start);
        let (columns, next) = rest.split_at_col_mut(width);
        let mut below = columns.split_at_row_mut(start).1;
        let mut row = start;
        while row < rows {
            let (tile, next) = below.split_at_row_mut(TILE.min(rows - row));
            tiles.push((row, start, tile));
            below = next;
            row += TILE;
        }
        rest = next;
        start += width;
    }
    tiles.into_par_iter().with_max_len(1).for_each(|(row, col, mut tile)| {
        let (height, width) = (tile.nrows(), tile.ncols());
        if row == col {
            square(tile, Accum::Replace, a.subrows(row, height));
        } else {
            let (left, right) = (a.subrows(row, height), a.subrows(col, width));
            matmul(tile.as_mut(), Accum::Replace, left, right.transpose(), -1.0, Par::Seq);
        }
    });
}

/// The lower triangle of `-a a'`.
fn square(target: MatMut<'_, f64>, accumulate: Accum, a: MatRef<'_, f64>) {
    triangular::matmul(
        target,
        BlockStructure::TriangularLower,
        accumulate,
        a,
        BlockStructure::Rectangular,
        a.transpose(),
        BlockStructure::Rectangular,
        -1.0,
        Par::Seq,
    );
}

/// `target -= a b'` below the diagonal, where b are the rows of a that belong to the columns of the target.
fn subtract_product(target: MatMut<'_, f64>, a: MatRef<'_, f64>) {
    let width = target.ncols();
    let operations = ((2 * target.nrows() - width) * width * a.ncols()) as f64;
    let (top, bottom) = target.split_at_row_mut(width);
    let b = a.subrows(0, width);
    let below = |target: MatMut<'_, f64>, row: usize| {
        let rows = target.nrows();
        matmul(target, Accum::Add, a.subrows(row, rows), b.transpose(), -1.0, Par::Seq);
    };
    if operations <= WORTH_TILES {
        square(top, Accum::Add, b);
        below(bottom, width);
        return;
    }
    let in_top = |tile: MatMut<'_, f64>, row: usize| {
        let rows = tile.nrows();
        let own = a.subrows(row, rows);
        let (left, right) = tile.split_at_col_mut(row);
        matmul(left, Accum::Add, own, b.subrows(0, row).transpose(), -1.0, Par::Seq);
        square(right.subcols_mut(0, rows), Accum::Add, own);
    };
    let bottom = row_tiles(bottom).into_par_iter().map(|(row, tile)| (width + row, tile));
    row_tiles(top)
        .into_par_iter()
        .chain(bottom)
        .with_max_len(1)
        .for_each(|(row, tile)| if row < width { in_top(tile, row) } else { below(tile, row) });
}

fn row_tiles(target: MatMut<'_, f64>) -> Vec<(usize, MatMut<'_, f64>)> {
    let rows = target.nrows();
    let mut rest = target;
    let mut tiles = Vec::with_capacity(rows.div_ceil(TILE));
    for row in (0..rows).step_by(TILE) {
        let (tile, next) = rest.split_at_row_mut(TILE.min(rows - row));
        tiles.push((row, tile));
        rest = next;
    }
    tiles
}

/// Columns `stride` apart as a matrix.
pub(super) fn view(values: &[f64], rows: usize, columns: usize, stride: usize) -> MatRef<'_, f64> {
    MatRef::from_column_major_slice_with_stride(values, rows, columns, stride)
}

/// Columns `stride` apart as a matrix.
pub(super) fn view_mut(values: &mut [f64], rows: usize, columns: usize, stride: usize) -> MatMut<'_, f64> {
    MatMut::from_column_major_slice_with_stride_mut(values, rows, columns, stride)
}
