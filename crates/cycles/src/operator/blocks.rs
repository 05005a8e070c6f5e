//! Compressed matrices: blocks between clusters of points, dense or of low rank, and their products.
//!
//! Blocks are stored in the order in which a product reads them, once. Of a symmetric matrix only the blocks on and above the
//! diagonal are stored.

use super::low_rank::{GROUP, LowRank};
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// A block of a compressed matrix.
#[derive(Clone, Debug)]
struct Block {
    rows: Range<usize>,
    columns: Range<usize>,
    /// Number of columns of its two factors; none if it is dense.
    rank: Option<usize>,
    /// True if its transpose stands for a block below the diagonal.
    mirrored: bool,
    values: Range<usize>,
}

/// Blocks of one task, with memory for its sums.
#[derive(Debug)]
struct Task {
    blocks: Range<usize>,
    sums: Mutex<Vec<f64>>,
}

/// A compressed matrix in the order of a tree.
#[derive(Debug)]
pub(super) struct Compressed {
    size: usize,
    blocks: Vec<Block>,
    values: Vec<f64>,
    tasks: Vec<Task>,
}

/// Number of values of a task. It is fixed, so that sums do not depend on the number of threads. With more values than
/// this, starting tasks pays off.
const TASK: usize = 100_000;

/// A block before blocks are put in the order of products.
pub(super) struct Part {
    pub rows: Range<usize>,
    pub columns: Range<usize>,
    pub content: Content,
}

pub(super) enum Content {
    /// Row by row.
    Dense(Vec<f64>),
    Low(LowRank),
}

impl Part {
    /// Number of values.
    pub fn values(&self) -> usize {
        match &self.content {
            Content::Dense(values) => values.len(),
            Content::Low(low) => low.left.ncols() * (self.rows.len() + self.columns.len()),
        }
    }
}

impl Compressed {
    /// Matrix of `size` rows with these blocks. If it is symmetric, blocks off the diagonal also stand for their transposes.
    pub fn new(size: usize, parts: Vec<Part>, symmetric: bool) -> Self {
        let mut all = Self {
            size,
            blocks: Vec::with_capacity(parts.len()),
            values: Vec::with_capacity(parts.iter().map(Part::values).sum()),
            tasks: Vec::new(),
        };
        for Part { rows, columns, content } in parts {
            let first = all.values.len();
            let rank = match content {
                Content::Dense(values) => {
                    all.values.extend(values);
                    None
                }
                Content::Low(low) => {
                    // Group by group: the columns of the left factor, then those of the right one.
                    for k in (0..low.left.ncols()).step_by(GROUP) {
                        for side in [&low.left, &low.right] {
                            let columns = (k..k + GROUP).flat_map(|c| (0..side.nrows()).map(move |i| (i, c)));
                            all.values.extend(columns.map(|at| side[at]));
                        }
                    }
                    Some(low.left.ncols())
                }
            };
            let mirrored = symmetric && rows != columns;
            all.blocks.push(Block { rows, columns, rank, mirrored, values: first..all.values.len() });
        }
        all.part();
        all
    }

    /// Divides the blocks into tasks.
    fn part(&mut self) {
        let mut first = 0;
        for k in 0..self.blocks.len() {
            let values = self.blocks[k].values.end - self.blocks[first].values.start;
            if values >= TASK || k + 1 == self.blocks.len() {
                self.tasks.push(Task { blocks: first..k + 1, sums: Mutex::new(vec![0.0; self.size]) });
                first = k + 1;
            }
        }
    }

    /// Sizes.
    pub fn sizes(&self) -> Sizes {
        let low = self.blocks.iter().filter_map(|b| b.rank);
        let dense = self.blocks.len() - low.clone().count();
        Sizes {
            values: self.values.len(),
            blocks: [self.blocks.len() - dense, dense],
            rank: low.max().unwrap_or(0),
        }
    }

    /// Number of tasks of a product.
    #[cfg(test)]
    pub fn tasks(&self) -> usize {
        self.tasks.len()
    }

    /// Sums of the absolute values in the columns of a matrix that is not symmetric.
    pub fn columns(&self) -> Vec<f64> {
        let of = |block: &Block| block.magnitudes(&self.values[block.values.clone()]);
        let sums: Vec<Vec<f64>> = self.blocks.par_iter().map(of).collect();
        let mut all = vec![0.0; self.size];
        for (block, sums) in self.blocks.iter().zip(sums) {
            all[block.columns.clone()].iter_mut().zip(sums).for_each(|(all, sum)| *all += sum);
        }
        all
    }

    /// y = A x.
    pub fn product(&self, arch: Arch, x: &[f64], y: &mut [f64]) {
        let work = |task: &Task| {
            let mut sums = task.sums.lock().unwrap_or_else(PoisonError::into_inner);
            sums.fill(0.0);
            arch.dispatch(Product {
                blocks: &self.blocks[task.blocks.clone()],
                values: &self.values,
                x,
                sums: &mut sums,
            });
        };
        match self.tasks.as_slice() {
            [one] => work(one),
            many => many.par_iter().for_each(work),
        }
        y.fill(0.0);
        for task in &self.tasks {
            let sums = task.sums.lock().unwrap_or_else(PoisonError::into_inner);
            y.iter_mut().zip(sums.iter()).for_each(|(y, s)| *y += s);
        }
    }
}

/// Sizes of a compressed matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sizes {
    /// Values kept.
    pub values: usize,
    /// Numbers of blocks of low rank and of dense ones.
    pub blocks: [usize; 2],
    /// Largest rank.
    pub rank: usize,
}

/// Products of blocks with a vector. It is not a closure, since pulp calls closures through a function that is compiled
/// without the requested vector units.
struct Product<'a> {
    blocks: &'a [Block],
    values: &'a [f64],
    x: &'a [f64],
    sums: &'a mut [f64],
}

impl WithSimd for Product<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        for block in self.blocks {
            block.add(&self.values[block.values.clone()], self.x, self.sums);
        }
    }
}

impl Block {
    /// Sums of the absolute values in its columns.
    fn magnitudes(&self, values: &[f64]) -> Vec<f64> {
        let (m, n) = (self.rows.len(), self.columns.len());
        let mut sums = vec![0.0; n];
        if self.rank.is_none() {
            values.chunks_exact(n).for_each(|row| sums.iter_mut().zip(row).for_each(|(s, v)| *s += v.abs()));
            return sums;
        }
        let mut column = vec![0.0; m];
        for (j, sum) in sums.iter_mut().enumerate() {
            column.fill(0.0);
            for group in values.chunks_exact(GROUP * (m + n)) {
                let (left, right) = group.split_at(GROUP * m);
                for (left, right) in left.chunks_exact(m).zip(right.chunks_exact(n)) {
                    add(&mut column, right[j], left);
                }
            }
            *sum = column.iter().map(|v| v.abs()).sum();
        }
        sums
    }

    /// Adds its product with `x` to `y`.
    #[inline(always)]
    fn add(&self, values: &[f64], x: &[f64], y: &mut [f64]) {
        let (m, n) = (self.rows.len(), self.columns.len());
        let Some(_) = self.rank else {
            for (i, row) in values.chunks_exact(n).enumerate() {
                let at = self.rows.start + i;
                y[at] += dot(row, &x[self.columns.clone()]);
                if self.mirrored {
                    add(&mut y[self.columns.clone()], x[at], row);
                }
            }
            return;
        };
        for group in values.chunks_exact(GROUP * (m + n)) {
            let (left, right) = group.split_at(GROUP * m);
            let t = dots(right, &x[self.columns.clone()]);
            let s = if self.mirrored { dots(left, &x[self.rows.clone()]) } else { [0.0; GROUP] };
            adds(&mut y[self.rows.clone()], &t, left);
            if self.mirrored {
                adds(&mut y[self.columns.clone()], &s, right);
            }
        }
    }
}

/// Number of partial sums. It is fixed, so that results are the same on every machine.
const LANES: usize = 8;

#[inline(always)]
fn dot(a: &[f64], x: &[f64]) -> f64 {
    let (a_lanes, a_rest) = a.as_chunks::<LANES>();
    let (x_lanes, x_rest) = x.as_chunks::<LANES>();
    let mut sums = [0.0; LANES];
    for (a, x) in a_lanes.iter().zip(x_lanes) {
        for k in 0..LANES {
            sums[k] += a[k] * x[k];
        }
    }
    for ((sum, a), x) in sums.iter_mut().zip(a_rest).zip(x_rest) {
        *sum += a * x;
    }
    let [a, b, c, d, e, f, g, h] = sums;
    ((a + e) + (c + g)) + ((b + f) + (d + h))
}

/// Scalar products of the columns of a group with `x`. They are written one after the other: compilers interleave the
/// columns otherwise, which is slower, and compile `array::from_fn` without vector units.
#[inline(always)]
fn dots(group: &[f64], x: &[f64]) -> [f64; GROUP] {
    let n = x.len();
    let (a, b) = group.split_at(2 * n);
    let ((a, b), (c, d)) = (a.split_at(n), b.split_at(n));
    [dot(a, x), dot(b, x), dot(c, x), dot(d, x)]
}

#[inline(always)]
fn add(y: &mut [f64], factor: f64, a: &[f64]) {
    for (y, a) in y.iter_mut().zip(a) {
        *y += factor * a;
    }
}

/// Adds multiples of the columns of a group to `y`.
#[inline(always)]
fn adds(y: &mut [f64], factors: &[f64; GROUP], group: &[f64]) {
    let n = y.len();
    let (a, b) = group.split_at(2 * n);
    let ((a, b), (c, d)) = (a.split_at(n), b.split_at(n));
    let [f, g, h, k] = *factors;
    for ((((y, a), b), c), d) in y.iter_mut().zip(a).zip(b).zip(c).zip(d) {
        *y += (f * a + g * b) + (h * c + k * d);
    }
}
