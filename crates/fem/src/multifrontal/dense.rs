//! Elimination of fronts of any size: blocks of columns, left-looking, on faer's dense kernels.
//!
//! Large fronts are cut into tiles whose size depends on nothing but the front, each computed by one thread: the bits do
//! not depend on the number of threads.

use super::kernel::{Break, Eliminate, Update};
use faer::linalg::matmul::matmul;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{Accum, MatMut, MatRef, Par};
use pulp::Arch;
use rayon::prelude::*;

/// Columns eliminated by the small kernel at once, and columns of a block of large fronts: a choice, not yet tuned; multiples of the
/// kernel's width.
const SMALL: usize = 32;
const BLOCK: usize = 128;

/// Rows of a tile.
const TILE: usize = 512;

/// Operations from which work is cut into tiles: some 0.1 ms.
const WORTH_TILES: f64 = 4e6;

/// Rows up to which the small kernel forms the contribution of a front: it does not block for caches.
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
) -> Result<(), Break> {
    let columns = smallest.len();
    if columns <= SMALL {
        return arch.dispatch(Eliminate { values, stride, rows, columns, smallest });
    }
    let block = if columns <= 2 * BLOCK { SMALL } else { BLOCK };
    let mut start = 0;
    while start < columns {
        let width = block.min(columns - start);
        let below = rows - start;
        let (left, right) = values.split_at_mut(start * stride);
        if start > 0 {
            let a = view(&left[start..], below, start, stride);
            let target = view_mut(&mut right[start..], below, width, stride);
            subtract_product(target, a, a.subrows(0, width));
        }
        eliminate(arch, &mut right[start..], stride, width, &smallest[start..start + width])
            .map_err(|(k, pivot)| (start + k, pivot))?;
        let current = view_mut(&mut right[start..], below, width, stride);
        let (pivots, rest) = current.split_at_row_mut(width);
        solve_rows(pivots.as_ref(), rest);
        start += width;
    }
    Ok(())
}

/// Writes the lower triangle of `-L L'` into `result` (rows by rows, column by column), L being the rows of a front's
/// columns below its pivots.
pub(super) fn update(arch: Arch, result: &mut [f64], l: &[f64], stride: usize, rows: usize, columns: usize) {
    if rows <= SMALL_ROWS {
        arch.dispatch(Update { result, a: l, stride, rows, columns });
        return;
    }
    let a = view(l, rows, columns, stride);
    let target = view_mut(result, rows, rows, rows);
    if (rows * rows * columns) as f64 <= WORTH_TILES {
        minus_square(target, a);
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
            minus_square(tile, a.subrows(row, height));
        } else {
            let (left, right) = (a.subrows(row, height), a.subrows(col, width));
            matmul(tile.as_mut(), Accum::Replace, left, right.transpose(), -1.0, Par::Seq);
        }
    });
}

fn minus_square(target: MatMut<'_, f64>, a: MatRef<'_, f64>) {
    triangular::matmul(
        target,
        BlockStructure::TriangularLower,
        Accum::Replace,
        a,
        BlockStructure::Rectangular,
        a.transpose(),
        BlockStructure::Rectangular,
        -1.0,
        Par::Seq,
    );
}

/// `target -= a b'`.
fn subtract_product(target: MatMut<'_, f64>, a: MatRef<'_, f64>, b: MatRef<'_, f64>) {
    let operations = 2.0 * (target.nrows() * target.ncols() * b.ncols()) as f64;
    let one = |mut target: MatMut<'_, f64>, a: MatRef<'_, f64>| {
        matmul(target.as_mut(), Accum::Add, a, b.transpose(), -1.0, Par::Seq);
    };
    if operations <= WORTH_TILES {
        one(target, a);
        return;
    }
    row_tiles(target).into_par_iter().with_max_len(1).for_each(|(row, tile)| {
        let rows = tile.nrows();
        one(tile, a.subrows(row, rows));
    });
}

/// `rest := rest L⁻ᵀ` with the lower triangle of `pivots`.
fn solve_rows(pivots: MatRef<'_, f64>, rest: MatMut<'_, f64>) {
    let operations = (rest.nrows() * rest.ncols() * rest.ncols()) as f64;
    if operations <= WORTH_TILES {
        solve_lower_triangular_in_place(pivots, rest.transpose_mut(), Par::Seq);
        return;
    }
    row_tiles(rest).into_par_iter().with_max_len(1).for_each(|(_, tile)| {
        solve_lower_triangular_in_place(pivots, tile.transpose_mut(), Par::Seq);
    });
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
