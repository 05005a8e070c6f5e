//! Compressed rows of dense blocks: `R x C` entries for each stored pair of nodes.
//!
//! Rows are independent of each other, and a row is always summed in the order of its columns, so that products have the
//! same bits for any number of threads.

use super::dense::{Block, add_apply, add_product, transposed};
use super::vector::CHUNK;
use rayon::prelude::*;

/// Rows of a sparse product computed by one task. Each task keeps a marker as long as the matrix has columns; tasks are
/// therefore larger than those of a vector.
const PRODUCT_ROWS: usize = 4096;

/// See the module. Columns ascend within a row.
#[derive(Clone, Debug)]
pub struct BlockCsr<const R: usize, const C: usize> {
    /// Number of block columns.
    pub width: usize,
    /// First entry of each row; one element more than the number of rows.
    pub starts: Vec<usize>,
    /// Column of each entry.
    pub columns: Vec<u32>,
    /// Entries.
    pub values: Vec<Block<R, C>>,
}

/// Rows of a product: their lengths, columns and entries.
type Rows<const R: usize, const C: usize> = (Vec<usize>, Vec<u32>, Vec<Block<R, C>>);

impl<const R: usize, const C: usize> BlockCsr<R, C> {
    /// Number of block rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.starts.len() - 1
    }

    /// Columns and entries of a row.
    #[inline(always)]
    pub fn row(&self, row: usize) -> (&[u32], &[Block<R, C>]) {
        let range = self.starts[row]..self.starts[row + 1];
        (&self.columns[range.clone()], &self.values[range])
    }

    /// A row times a vector.
    #[inline(always)]
    pub fn row_product(&self, row: usize, x: &[[f64; C]]) -> [f64; R] {
        let (columns, values) = self.row(row);
        let mut sum = [0.0; R];
        for (&column, value) in columns.iter().zip(values) {
            add_apply(&mut sum, value, &x[column as usize]);
        }
        sum
    }

    /// `y = A x`.
    pub fn multiply(&self, x: &[[f64; C]], y: &mut [[f64; R]]) {
        y.par_chunks_mut(CHUNK).enumerate().for_each(|(chunk, y)| {
            for (k, y) in y.iter_mut().enumerate() {
                *y = self.row_product(chunk * CHUNK + k, x);
            }
        });
    }

    /// `y += A x`.
    pub fn multiply_add(&self, x: &[[f64; C]], y: &mut [[f64; R]]) {
        y.par_chunks_mut(CHUNK).enumerate().for_each(|(chunk, y)| {
            for (k, y) in y.iter_mut().enumerate() {
                let sum = self.row_product(chunk * CHUNK + k, x);
                for (y, s) in y.iter_mut().zip(sum) {
                    *y += s;
                }
            }
        });
    }

    /// `r = b - A x`.
    pub fn residual(&self, x: &[[f64; C]], b: &[[f64; R]], r: &mut [[f64; R]]) {
        r.par_chunks_mut(CHUNK).enumerate().for_each(|(chunk, r)| {
            for (k, r) in r.iter_mut().enumerate() {
                let row = chunk * CHUNK + k;
                let sum = self.row_product(row, x);
                *r = std::array::from_fn(|i| b[row][i] - sum[i]);
            }
        });
    }

    /// The sum of matrices of one shape.
    #[must_use]
    pub fn sum(parts: &[&Self]) -> Self {
        let rows = parts.first().map_or(0, |p| p.rows());
        let mut sum = Self {
            width: parts.first().map_or(0, |p| p.width),
            starts: Vec::with_capacity(rows + 1),
            columns: Vec::new(),
            values: Vec::new(),
        };
        sum.starts.push(0);
        let mut entries: Vec<(u32, &Block<R, C>)> = Vec::new();
        for row in 0..rows {
            entries.clear();
            for part in parts {
                let (columns, values) = part.row(row);
                entries.extend(columns.iter().copied().zip(values));
            }
            entries.sort_by_key(|(column, _)| *column);
            let first = sum.columns.len();
            for (column, value) in &entries {
                if sum.columns.len() > first && sum.columns.last() == Some(column) {
                    let last = sum.values.last_mut().into_iter().flatten().flatten();
                    last.zip(value.as_flattened()).for_each(|(sum, value)| *sum += value);
                } else {
                    sum.columns.push(*column);
                    sum.values.push(**value);
                }
            }
            sum.starts.push(sum.columns.len());
        }
        sum
    }

    /// The transpose.
    #[must_use]
    pub fn transposed(&self) -> BlockCsr<C, R> {
        let mut starts = vec![0_usize; self.width + 1];
        for &column in &self.columns {
            starts[column as usize + 1] += 1;
        }
        for row in 0..self.width {
            starts[row + 1] += starts[row];
        }
        let mut next = starts.clone();
        let mut columns = vec![0; self.columns.len()];
        let mut values = vec![[[0.0; R]; C]; self.values.len()];
        for row in 0..self.rows() {
            let (from, blocks) = self.row(row);
            for (&column, block) in from.iter().zip(blocks) {
                let place = &mut next[column as usize];
                columns[*place] = row as u32;
                values[*place] = transposed(block);
                *place += 1;
            }
        }
        BlockCsr { width: self.rows(), starts, columns, values }
    }

    /// The product with another matrix.
    #[must_use]
    pub fn product<const K: usize>(&self, other: &BlockCsr<C, K>) -> BlockCsr<R, K> {
        let tasks = self.rows().div_ceil(PRODUCT_ROWS);
        let parts: Vec<Rows<R, K>> =
            (0..tasks).into_par_iter().map(|task| self.product_rows(other, task)).collect();
        let entries = parts.iter().map(|p| p.1.len()).sum();
        let mut starts = Vec::with_capacity(self.rows() + 1);
        let (mut columns, mut values) = (Vec::with_capacity(entries), Vec::with_capacity(entries));
        let mut end = 0;
        starts.push(end);
        for (lengths, part_columns, part_values) in parts {
            for length in lengths {
                end += length;
                starts.push(end);
            }
            columns.extend_from_slice(&part_columns);
            values.extend_from_slice(&part_values);
        }
        BlockCsr { width: other.width, starts, columns, values }
    }

    /// Rows of the product by Gustavson's method: a marker holds the position of each column in the present row.
    fn product_rows<const K: usize>(&self, other: &BlockCsr<C, K>, task: usize) -> Rows<R, K> {
        const NONE: u32 = u32::MAX;
        let rows = task * PRODUCT_ROWS..((task + 1) * PRODUCT_ROWS).min(self.rows());
        let (mut lengths, mut columns, mut values) = (Vec::with_capacity(rows.len()), Vec::new(), Vec::new());
        let mut place = vec![NONE; other.width];
        let mut present: Vec<u32> = Vec::new();
        for row in rows {
            let (inner, left) = self.row(row);
            for &k in inner {
                for &column in other.row(k as usize).0 {
                    if place[column as usize] == NONE {
                        place[column as usize] = 0;
                        present.push(column);
                    }
                }
            }
            present.sort_unstable();
            let first = values.len();
            for (k, &column) in present.iter().enumerate() {
                place[column as usize] = k as u32;
            }
            values.resize(first + present.len(), [[0.0; K]; R]);
            for (&k, left) in inner.iter().zip(left) {
                let (across, right) = other.row(k as usize);
                for (&column, right) in across.iter().zip(right) {
                    add_product(&mut values[first + place[column as usize] as usize], left, right);
                }
            }
            lengths.push(present.len());
            columns.extend_from_slice(&present);
            present.drain(..).for_each(|column| place[column as usize] = NONE);
        }
        (lengths, columns, values)
    }

    /// Bytes of the stored entries and their indices.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of_val(self.values.as_slice())
            + size_of_val(self.columns.as_slice())
            + size_of_val(self.starts.as_slice())
    }
}

impl<const B: usize> BlockCsr<B, B> {
    /// The diagonal entry of each row; zero if it is not stored.
    #[must_use]
    pub fn diagonal(&self) -> Vec<Block<B, B>> {
        (0..self.rows())
            .map(|row| {
                let (columns, values) = self.row(row);
                columns.binary_search(&(row as u32)).map_or([[0.0; B]; B], |k| values[k])
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn example() -> BlockCsr<2, 3> {
        BlockCsr {
            width: 3,
            starts: vec![0, 2, 3],
            columns: vec![0, 2, 1],
            values: (0..3)
                .map(|k| std::array::from_fn(|i| std::array::from_fn(|j| (k * 6 + i * 3 + j) as f64)))
                .collect(),
        }
    }

    #[test]
    fn product_with_the_transpose_acts_as_both_in_turn() {
        let a = example();
        let at = a.transposed();
        let product = a.product(&at);
        let x = [[1.0, -2.0], [0.5, 3.0]];
        let (mut through, mut y, mut direct) = ([[0.0; 3]; 3], [[0.0; 2]; 2], [[0.0; 2]; 2]);
        at.multiply(&x, &mut through);
        a.multiply(&through, &mut y);
        product.multiply(&x, &mut direct);
        assert_eq!(y, direct);
        assert_eq!(product.starts, [0, 1, 2]);
    }
}
