//! Blocks of low rank from some of their entries.
//!
//! Crosses through the largest entry of a row of the remainder are taken one by one (M. Bebendorf, S. Rjasanow, Computing 70
//! (2003) 1), so that a block of m rows and n columns of rank r costs r (m + n) entries. The size of the last cross represents
//! that of the remainder. That fails where a block falls into parts which crosses do not connect, such as those of two
//! directions of slip or of rows that vanish. The remainder in further rows is therefore compared with the block before the
//! search ends, and the worst of them is the next cross.

use super::low_rank::{LowRank, recompressed};
use nalgebra::DMatrix;

/// Share of the error left to the crosses; the rest is for the truncation that follows.
const CROSSES: f64 = 0.3;
/// Number of rows in which the remainder is computed before the search ends.
const PROBES: usize = 6;

/// Size and accuracy of a block.
#[derive(Clone, Copy, Debug)]
pub(super) struct BlockAccuracy {
    /// Numbers of rows and columns.
    pub size: [usize; 2],
    /// Error in Frobenius' norm over the norm of the block.
    pub tolerance: f64,
    /// Size of entries that are rounding.
    pub rounding: f64,
    /// Largest number of columns of the factors.
    pub most: usize,
}

/// The crosses found so far, and the norm of their sum.
struct Crosses<'a> {
    entry: &'a dyn Fn(usize, usize) -> f64,
    size: [usize; 2],
    left: Vec<Vec<f64>>,
    right: Vec<Vec<f64>>,
    square: f64,
}

impl Crosses<'_> {
    /// Row of the remainder.
    fn row(&self, i: usize) -> Vec<f64> {
        let mut row: Vec<f64> = (0..self.size[1]).map(|j| (self.entry)(i, j)).collect();
        for (left, right) in self.left.iter().zip(&self.right) {
            row.iter_mut().zip(right).for_each(|(value, r)| *value -= left[i] * r);
        }
        row
    }

    /// Column of the remainder.
    fn column(&self, j: usize) -> Vec<f64> {
        let mut column: Vec<f64> = (0..self.size[0]).map(|i| (self.entry)(i, j)).collect();
        for (left, right) in self.left.iter().zip(&self.right) {
            column.iter_mut().zip(left).for_each(|(value, l)| *value -= right[j] * l);
        }
        column
    }

    /// Adds the cross of a row of the remainder and the column of its largest entry. Returns its norm, zero for a row of rounding;
    /// none if there is no room for it.
    fn cross(&mut self, i: usize, used_columns: &mut [bool], rounding: f64, room: usize) -> Option<f64> {
        let row = self.row(i);
        let pivot = largest(&row, used_columns).filter(|&j| row[j].abs() > rounding);
        let Some(j) = pivot else { return Some(0.0) };
        if self.left.len() == room {
            return None;
        }
        used_columns[j] = true;
        let column: Vec<f64> = self.column(j).iter().map(|v| v / row[j]).collect();
        Some(self.add(column, row))
    }

    /// Adds the cross of a column, divided by the pivot, and a row. Returns its norm.
    fn add(&mut self, column: Vec<f64>, row: Vec<f64>) -> f64 {
        let norm = (dot(&column, &column) * dot(&row, &row)).sqrt();
        let products = self.left.iter().zip(&self.right).map(|(l, r)| dot(l, &column) * dot(r, &row));
        self.square += norm * norm + 2.0 * products.sum::<f64>();
        self.left.push(column);
        self.right.push(row);
        norm
    }

    /// Norm of the sum of crosses.
    fn norm(&self) -> f64 {
        self.square.max(0.0).sqrt()
    }

    /// Estimate of the norm of the remainder from some rows, and the row in which it is largest.
    fn probe(&self, rows: &[usize]) -> (f64, usize) {
        let squares = rows.iter().map(|&i| (dot(&self.row(i), &self.row(i)), i));
        let (mut sum, mut worst) = (0.0, (0.0, 0));
        for (square, i) in squares {
            sum += square;
            if square > worst.0 {
                worst = (square, i);
            }
        }
        ((sum / rows.len() as f64 * self.size[0] as f64).sqrt(), worst.1)
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Position of the largest magnitude among the positions that are not `used`.
fn largest(values: &[f64], used: &[bool]) -> Option<usize> {
    let free = (0..values.len()).filter(|&k| !used[k]);
    free.reduce(|best, k| if values[k].abs() > values[best].abs() { k } else { best })
}

/// Rows that are spread over a block, the same on every machine. Their order leaves no direction of a surface out.
fn spread(rows: usize) -> Vec<usize> {
    // The golden section spreads any number of rows evenly.
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    let mut found: Vec<usize> = Vec::with_capacity(PROBES);
    for k in 1..=2 * PROBES {
        let row = ((k as f64 * golden).fract() * rows as f64) as usize;
        if row < rows && !found.contains(&row) && found.len() < PROBES {
            found.push(row);
        }
    }
    found
}

/// Factors a block of these entries; none if more columns than wanted are needed. A block of rounding has no columns.
pub(super) fn crosses(entry: &dyn Fn(usize, usize) -> f64, wanted: BlockAccuracy) -> Option<LowRank> {
    let [m, n] = wanted.size;
    let floor = wanted.rounding * ((m * n) as f64).sqrt();
    let (mut used_rows, mut used_columns) = (vec![false; m], vec![false; n]);
    let mut all = Crosses { entry, size: [m, n], left: Vec::new(), right: Vec::new(), square: 0.0 };
    let probes = spread(m);
    let mut next = probes[0];
    // Crosses need more columns than singular vectors.
    let room = (2 * wanted.most).min(m).min(n);
    loop {
        used_rows[next] = true;
        let size = all.cross(next, &mut used_columns, wanted.rounding, room)?;
        let allowed = (CROSSES * wanted.tolerance * all.norm()).max(floor);
        let follow = all.left.last().and_then(|column| largest(column, &used_rows));
        next = match follow {
            Some(row) if size > allowed => row,
            _ => {
                let (remainder, worst) = all.probe(&probes);
                if remainder <= allowed {
                    break;
                }
                if used_rows[worst] {
                    return None;
                }
                worst
            }
        };
    }
    let error = ((1.0 - CROSSES) * wanted.tolerance * all.norm()).max(floor);
    let matrix = |columns: &[Vec<f64>], rows: usize| DMatrix::from_vec(rows, columns.len(), columns.concat());
    let found = recompressed(matrix(&all.left, m), matrix(&all.right, n), error)?;
    (found.left.ncols() <= wanted.most).then_some(found)
}

#[cfg(test)]
mod tests {
    use super::{BlockAccuracy, crosses};
    use nalgebra::DMatrix;

    fn wanted(size: [usize; 2], tolerance: f64) -> BlockAccuracy {
        BlockAccuracy { size, tolerance, rounding: 1e-15, most: 48 }
    }

    /// Error over the norm of a block, and the number of columns.
    fn error(size: [usize; 2], tolerance: f64, entry: impl Fn(usize, usize) -> f64) -> (f64, usize) {
        let block = DMatrix::from_fn(size[0], size[1], &entry);
        let found = crosses(&entry, wanted(size, tolerance)).unwrap();
        ((&found.left * found.right.transpose() - &block).norm() / block.norm(), found.left.ncols())
    }

    #[test]
    fn the_error_is_relative_to_the_block() {
        for scale in [1.0, 1e-9] {
            let entry = |i: usize, j: usize| scale / (20.0 + i as f64 + j as f64).powi(3);
            for tolerance in [1e-3, 1e-6, 1e-9] {
                let found = crosses(&entry, BlockAccuracy { rounding: 1e-30, ..wanted([80, 60], tolerance) })
                    .unwrap();
                let block = DMatrix::from_fn(80, 60, entry);
                let off = (&found.left * found.right.transpose() - &block).norm() / block.norm();
                assert!(off <= tolerance, "{off:e} above {tolerance:e}");
                assert!(off > 1e-4 * tolerance || tolerance < 1e-8, "{off:e}");
            }
        }
    }

    #[test]
    fn parts_that_crosses_do_not_connect_are_found() {
        // Two blocks on the diagonal: crosses from one never lead to the other.
        let entry = |i: usize, j: usize| {
            let smooth = 1.0 / (10.0 + (i % 40) as f64 + (j % 30) as f64);
            if (i < 40) == (j < 30) { if i < 40 { smooth } else { 1e-3 * smooth.sqrt() } } else { 0.0 }
        };
        let (off, _) = error([80, 60], 1e-6, entry);
        assert!(off <= 1e-6, "{off:e}");
    }

    #[test]
    fn rows_and_columns_of_zeros_do_no_harm() {
        let entry = |i: usize, j: usize| {
            if i.is_multiple_of(3) || j.is_multiple_of(2) { 0.0 } else { 1.0 / (5.0 + i as f64 + j as f64) }
        };
        let (off, _) = error([70, 50], 1e-7, entry);
        assert!(off <= 1e-7, "{off:e}");
        let nothing = crosses(&|_, _| 1e-20, wanted([70, 50], 1e-7)).unwrap();
        assert_eq!(nothing.left.ncols(), 0);
    }

    #[test]
    fn a_block_of_full_rank_is_left_to_its_parts() {
        let entry = |i: usize, j: usize| if i == j { 1.0 } else { 0.0 };
        assert!(crosses(&entry, wanted([200, 200], 1e-6)).is_none());
    }
}
