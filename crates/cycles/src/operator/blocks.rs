//! Compressed matrices: blocks between clusters of points, dense or of low rank, and their products.
//!
//! Blocks are stored in the order in which a product reads them, once. Of a symmetric matrix only the blocks on and above the
//! diagonal are stored. Products read values faster than they calculate with them, so that values of half the size take half the
//! time; sums are always in double precision.

use super::low_rank::{GROUP, LowRank};
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::ops::Range;
use std::sync::{PoisonError, RwLock};

/// A block of a compressed matrix.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Block {
    rows: Range<usize>,
    columns: Range<usize>,
    /// Number of columns of its two factors; none if it is dense.
    rank: Option<usize>,
    /// True if its transpose represents a block below the diagonal.
    mirrored: bool,
    values: Range<usize>,
}

/// Blocks of one task, with memory for its sums.
#[derive(Debug)]
struct Task {
    blocks: Range<usize>,
    /// Rows to which the blocks contribute.
    span: Range<usize>,
    sums: RwLock<Vec<f64>>,
}

/// A compressed matrix in the order of a tree.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct CompressedMatrix {
    /// Number of rows.
    size: usize,
    blocks: Vec<Block>,
    values: Values,
    #[serde(skip)]
    tasks: Vec<Task>,
}

/// Precision of stored values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Precision {
    /// 53 bits.
    Double,
    /// 24 bits: an error of at most 6e-8 of each value.
    Single,
}

impl Precision {
    /// Size of a value \[bytes\].
    pub(super) fn bytes(self) -> usize {
        match self {
            Self::Double => size_of::<f64>(),
            Self::Single => size_of::<f32>(),
        }
    }
}

/// Values of all blocks.
#[derive(Debug, Serialize, Deserialize)]
enum Values {
    Double(Vec<f64>),
    Single(Vec<f32>),
}

impl Values {
    fn new(precision: Precision, count: usize) -> Self {
        match precision {
            Precision::Double => Self::Double(Vec::with_capacity(count)),
            Precision::Single => Self::Single(Vec::with_capacity(count)),
        }
    }

    fn len(&self) -> usize {
        match self {
            Self::Double(values) => values.len(),
            Self::Single(values) => values.len(),
        }
    }

    fn bytes(&self) -> usize {
        match self {
            Self::Double(values) => size_of_val(values.as_slice()),
            Self::Single(values) => size_of_val(values.as_slice()),
        }
    }

    fn extend(&mut self, further: impl Iterator<Item = f64>) {
        match self {
            Self::Double(values) => values.extend(further),
            Self::Single(values) => values.extend(further.map(|v| v as f32)),
        }
    }
}

/// A stored value.
trait Value: Copy + Sync {
    fn double(self) -> f64;
}

impl Value for f64 {
    #[inline(always)]
    fn double(self) -> f64 {
        self
    }
}

impl Value for f32 {
    #[inline(always)]
    fn double(self) -> f64 {
        f64::from(self)
    }
}

/// Number of values of a task. It is fixed, so that sums do not depend on the number of threads. With more values than
/// this, starting tasks pays off.
const TASK: usize = 100_000;

/// Number of rows whose sums over all tasks are added at once.
const ROWS: usize = 1024;
/// Number of tasks from which their sums are added on all threads: fewer take some microseconds.
const WORTH_COLLECTING: usize = 16;

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
    /// The same block with other first row and column.
    pub fn shifted(self, [rows, columns]: [usize; 2]) -> Self {
        let by = |range: Range<usize>, shift: usize| range.start + shift..range.end + shift;
        Self { rows: by(self.rows, rows), columns: by(self.columns, columns), ..self }
    }

    /// Number of values.
    pub fn values(&self) -> usize {
        match &self.content {
            Content::Dense(values) => values.len(),
            Content::Low(low) => low.left.ncols() * (self.rows.len() + self.columns.len()),
        }
    }
}

impl CompressedMatrix {
    /// Matrix of `size` rows with these blocks. If it is symmetric, blocks off the diagonal also represent their transposes. If
    /// not, it may have any number of columns.
    pub fn new(size: usize, parts: Vec<Part>, symmetric: bool, precision: Precision) -> Self {
        let mut all = Self {
            size,
            blocks: Vec::with_capacity(parts.len()),
            values: Values::new(precision, parts.iter().map(Part::values).sum()),
            tasks: Vec::new(),
        };
        for Part { rows, columns, content } in parts {
            let first = all.values.len();
            let rank = match content {
                Content::Dense(values) => {
                    all.values.extend(values.into_iter());
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

    /// The same matrix with its tasks, which are not written.
    pub fn restored(mut self) -> Self {
        self.part();
        self
    }

    /// Divides the blocks into tasks.
    fn part(&mut self) {
        let mut first = 0;
        for k in 0..self.blocks.len() {
            let values = self.blocks[k].values.end - self.blocks[first].values.start;
            if values >= TASK || k + 1 == self.blocks.len() {
                let blocks = first..k + 1;
                let span = span(&self.blocks[blocks.clone()]);
                let sums = RwLock::new(vec![0.0; span.len()]);
                self.tasks.push(Task { blocks, span, sums });
                first = k + 1;
            }
        }
    }

    /// Sizes.
    pub fn sizes(&self) -> Sizes {
        let low = self.blocks.iter().filter_map(|b| b.rank);
        let dense = self.blocks.len() - low.clone().count();
        Sizes {
            bytes: self.values.bytes(),
            single: matches!(self.values, Values::Single(_)),
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
        let of = |block: &Block| match &self.values {
            Values::Double(values) => block.magnitudes(&values[block.values.clone()]),
            Values::Single(values) => block.magnitudes(&values[block.values.clone()]),
        };
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
            let mut sums = task.sums.write().unwrap_or_else(PoisonError::into_inner);
            sums.fill(0.0);
            let (blocks, first) = (&self.blocks[task.blocks.clone()], task.span.start);
            match &self.values {
                Values::Double(values) => {
                    arch.dispatch(Product { blocks, values, x, sums: &mut sums, first })
                }
                Values::Single(values) => {
                    arch.dispatch(Product { blocks, values, x, sums: &mut sums, first })
                }
            }
        };
        match self.tasks.as_slice() {
            [one] => work(one),
            many => many.par_iter().with_max_len(1).for_each(work),
        }
        self.collect(y);
    }

    /// Adds the sums of all tasks, in their order.
    fn collect(&self, y: &mut [f64]) {
        let piece = |(k, y): (usize, &mut [f64])| {
            y.fill(0.0);
            let rows = k * ROWS..k * ROWS + y.len();
            self.tasks.iter().for_each(|task| task.add(&rows, y));
        };
        if self.tasks.len() < WORTH_COLLECTING {
            y.chunks_mut(ROWS).enumerate().for_each(piece);
        } else {
            y.par_chunks_mut(ROWS).enumerate().for_each(piece);
        }
    }
}

impl Task {
    /// Adds its sums to these rows.
    fn add(&self, rows: &Range<usize>, y: &mut [f64]) {
        let (from, to) = (rows.start.max(self.span.start), rows.end.min(self.span.end));
        if from < to {
            let sums = self.sums.read().unwrap_or_else(PoisonError::into_inner);
            let sums = &sums[from - self.span.start..to - self.span.start];
            y[from - rows.start..to - rows.start].iter_mut().zip(sums).for_each(|(y, s)| *y += s);
        }
    }
}

/// Rows to which blocks contribute.
fn span(blocks: &[Block]) -> Range<usize> {
    let rows = blocks.iter().map(|b| &b.rows);
    let mirrored = blocks.iter().filter(|b| b.mirrored).map(|b| &b.columns);
    let all = rows.chain(mirrored);
    let join = |a: Range<usize>, b: &Range<usize>| a.start.min(b.start)..a.end.max(b.end);
    let (first, rest) = (blocks.first().map_or(0..0, |b| b.rows.clone()), all);
    rest.fold(first, join)
}

/// Sizes of a compressed matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sizes {
    /// Size of the values \[bytes\].
    pub bytes: usize,
    /// True if they are stored in single precision.
    pub single: bool,
    /// Numbers of blocks of low rank and of dense ones.
    pub blocks: [usize; 2],
    /// Largest rank.
    pub rank: usize,
}

/// Products of blocks with a vector. It is not a closure, since pulp calls closures through a function that is compiled
/// without the requested vector units.
struct Product<'a, T> {
    blocks: &'a [Block],
    values: &'a [T],
    x: &'a [f64],
    /// Sums of the rows from `first` on.
    sums: &'a mut [f64],
    first: usize,
}

impl<T: Value> WithSimd for Product<'_, T> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        for block in self.blocks {
            block.add(&self.values[block.values.clone()], self.x, self.sums, self.first);
        }
    }
}

impl Block {
    /// Sums of the absolute values in its columns.
    fn magnitudes<T: Value>(&self, values: &[T]) -> Vec<f64> {
        let (m, n) = (self.rows.len(), self.columns.len());
        let mut sums = vec![0.0; n];
        if self.rank.is_none() {
            let size = |(sum, v): (&mut f64, &T)| *sum += v.double().abs();
            values.chunks_exact(n).for_each(|row| sums.iter_mut().zip(row).for_each(size));
            return sums;
        }
        let mut column = vec![0.0; m];
        for (j, sum) in sums.iter_mut().enumerate() {
            column.fill(0.0);
            for group in values.chunks_exact(GROUP * (m + n)) {
                let (left, right) = group.split_at(GROUP * m);
                for (left, right) in left.chunks_exact(m).zip(right.chunks_exact(n)) {
                    add(&mut column, right[j].double(), left);
                }
            }
            *sum = column.iter().map(|v| v.abs()).sum();
        }
        sums
    }

    /// Adds its product with `x` to `y`, which holds the rows from `first` on.
    #[inline(always)]
    fn add<T: Value>(&self, values: &[T], x: &[f64], y: &mut [f64], first: usize) {
        let (m, n) = (self.rows.len(), self.columns.len());
        let below = |rows: &Range<usize>| rows.start - first..rows.end - first;
        let Some(_) = self.rank else {
            for (i, row) in values.chunks_exact(n).enumerate() {
                let at = self.rows.start + i;
                y[at - first] += dot(row, &x[self.columns.clone()]);
                if self.mirrored {
                    add(&mut y[below(&self.columns)], x[at], row);
                }
            }
            return;
        };
        for group in values.chunks_exact(GROUP * (m + n)) {
            let (left, right) = group.split_at(GROUP * m);
            let t = dots(right, &x[self.columns.clone()]);
            let s = if self.mirrored { dots(left, &x[self.rows.clone()]) } else { [0.0; GROUP] };
            adds(&mut y[below(&self.rows)], &t, left);
            if self.mirrored {
                adds(&mut y[below(&self.columns)], &s, right);
            }
        }
    }
}

/// Number of partial sums. It is fixed, so that results are the same on every machine.
const LANES: usize = 8;

#[inline(always)]
fn dot<T: Value>(a: &[T], x: &[f64]) -> f64 {
    let (a_lanes, a_rest) = a.as_chunks::<LANES>();
    let (x_lanes, x_rest) = x.as_chunks::<LANES>();
    let mut sums = [0.0; LANES];
    for (a, x) in a_lanes.iter().zip(x_lanes) {
        for k in 0..LANES {
            sums[k] += a[k].double() * x[k];
        }
    }
    for ((sum, a), x) in sums.iter_mut().zip(a_rest).zip(x_rest) {
        *sum += a.double() * x;
    }
    let [a, b, c, d, e, f, g, h] = sums;
    ((a + e) + (c + g)) + ((b + f) + (d + h))
}

/// Scalar products of the columns of a group with `x`. They are written one after the other: compilers interleave the
/// columns otherwise, which is slower, and compile `array::from_fn` without vector units.
#[inline(always)]
fn dots<T: Value>(group: &[T], x: &[f64]) -> [f64; GROUP] {
    let n = x.len();
    let (a, b) = group.split_at(2 * n);
    let ((a, b), (c, d)) = (a.split_at(n), b.split_at(n));
    [dot(a, x), dot(b, x), dot(c, x), dot(d, x)]
}

#[inline(always)]
fn add<T: Value>(y: &mut [f64], factor: f64, a: &[T]) {
    for (y, a) in y.iter_mut().zip(a) {
        *y += factor * a.double();
    }
}

/// Adds multiples of the columns of a group to `y`.
#[inline(always)]
fn adds<T: Value>(y: &mut [f64], factors: &[f64; GROUP], group: &[T]) {
    let n = y.len();
    let (a, b) = group.split_at(2 * n);
    let ((a, b), (c, d)) = (a.split_at(n), b.split_at(n));
    let [f, g, h, k] = *factors;
    for ((((y, a), b), c), d) in y.iter_mut().zip(a).zip(b).zip(c).zip(d) {
        *y += (f * a.double() + g * b.double()) + (h * c.double() + k * d.double());
    }
}
