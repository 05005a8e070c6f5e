//! A fixed pattern of a sum of dense blocks, with the place of every block entry.

use crate::dof::Equations;
use crate::scatter::Gather;
use crate::term::Pattern;
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat, SymbolicSparseColMatRef};

/// Which entries of a matrix are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// All of them.
    Whole,
    /// The lower triangle, for symmetric matrices.
    Lower,
}

/// Compressed-column pattern of a sum of dense blocks, with the place of every block entry.
#[derive(Clone, Debug)]
pub struct ScatterMap {
    symbolic: SymbolicSparseColMat<usize>,
    /// For each pattern the number of its first value among all, and what each stored entry sums.
    gathers: Vec<(usize, Gather)>,
    values: Vec<f64>,
}

/// Block entries without a place: fixed degrees of freedom, or the triangle that is not stored.
const SKIPPED: usize = usize::MAX;

impl ScatterMap {
    /// Builds the pattern of the free equations from the blocks of `patterns`.
    #[must_use]
    pub fn new(patterns: &[&Pattern], equations: &Equations, part: Part) -> Self {
        let n = equations.free.len();
        let wanted = |row: usize, col: usize| {
            row != Equations::FIXED && col != Equations::FIXED && (part == Part::Whole || row >= col)
        };
        let visit = |f: &mut dyn FnMut(usize, usize)| visit_blocks(patterns, equations, f);
        let (starts, rows) = compress_columns(n, &wanted, &visit);
        let mut place = Vec::new();
        visit(&mut |row, col| {
            place.push(if wanted(row, col) {
                let column = &rows[starts[col]..starts[col + 1]];
                // The row is in its column by construction of `rows`.
                column.binary_search(&row).map_or(SKIPPED, |k| starts[col] + k)
            } else {
                SKIPPED
            });
        });
        let values = vec![0.0; rows.len()];
        let mut first = 0;
        let gathers = patterns.iter().map(|pattern| {
            let offset = first;
            first += pattern.values();
            (offset, Gather::new(&place[offset..first], rows.len()))
        });
        let gathers = gathers.collect();
        Self { symbolic: SymbolicSparseColMat::new_checked(n, n, starts, None, rows), gathers, values }
    }

    /// Sets the stored entries to zero.
    pub fn clear(&mut self) {
        self.values.fill(0.0);
    }

    /// Adds the values of one pattern, whose first is the `offset`-th of all. Returns the offset after them. Parallel; the same
    /// bits for any number of threads.
    pub fn add(&mut self, offset: usize, block_values: &[f64]) -> usize {
        if block_values.is_empty() {
            return offset;
        }
        // Patterns without values share their offset with the one after, and add nothing.
        for (_, gather) in self.gathers.iter().filter(|(first, _)| *first == offset) {
            gather.add(block_values, &mut self.values);
        }
        offset + block_values.len()
    }

    /// The matrix as it stands.
    #[must_use]
    pub fn matrix(&self) -> SparseColMatRef<'_, usize, f64> {
        SparseColMatRef::new(self.symbolic.as_ref(), &self.values)
    }

    /// The stored entries' places.
    #[must_use]
    pub fn symbolic(&self) -> SymbolicSparseColMatRef<'_, usize> {
        self.symbolic.as_ref()
    }

    /// Values of the stored entries, column by column.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Number of equations.
    #[must_use]
    pub fn order(&self) -> usize {
        self.symbolic.nrows()
    }

    /// Stored entries.
    #[must_use]
    pub fn stored(&self) -> usize {
        self.values.len()
    }

    /// Bytes of the lists of contributions.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.gathers.iter().map(|(_, gather)| gather.bytes()).sum()
    }
}

/// The lower triangle of the free equations of some patterns, without the places of their blocks.
#[must_use]
pub fn lower_pattern(patterns: &[&Pattern], equations: &Equations) -> SymbolicSparseColMat<usize> {
    let n = equations.free.len();
    let wanted = |row: usize, col: usize| row != Equations::FIXED && col != Equations::FIXED && row >= col;
    let visit = |f: &mut dyn FnMut(usize, usize)| visit_blocks(patterns, equations, f);
    let (starts, rows) = compress_columns(n, &wanted, &visit);
    SymbolicSparseColMat::new_checked(n, n, starts, None, rows)
}

/// Calls `f` with (row, column) of every entry of every block, in order.
fn visit_blocks(patterns: &[&Pattern], equations: &Equations, f: &mut dyn FnMut(usize, usize)) {
    for block in patterns.iter().flat_map(|p| p.blocks()) {
        for &r in block {
            for &c in block {
                f(equations.number[r], equations.number[c]);
            }
        }
    }
}

/// Calls its argument with (row, column) of every entry of every block, in order.
type Visit<'a> = dyn Fn(&mut dyn FnMut(usize, usize)) + 'a;

/// Row indices of each column, sorted and without repetition: (column starts, rows).
fn compress_columns(
    n: usize,
    wanted: &dyn Fn(usize, usize) -> bool,
    visit: &Visit<'_>,
) -> (Vec<usize>, Vec<usize>) {
    let mut count = vec![0_usize; n + 1];
    visit(&mut |row, col| {
        if wanted(row, col) {
            count[col + 1] += 1;
        }
    });
    for col in 0..n {
        count[col + 1] += count[col];
    }
    let mut raw = vec![0_usize; count[n]];
    let mut next = count.clone();
    visit(&mut |row, col| {
        if wanted(row, col) {
            raw[next[col]] = row;
            next[col] += 1;
        }
    });
    let mut starts = vec![0_usize; n + 1];
    let mut rows = Vec::with_capacity(raw.len() / 2);
    for col in 0..n {
        let column = &mut raw[count[col]..count[col + 1]];
        column.sort_unstable();
        for (k, &row) in column.iter().enumerate() {
            if k == 0 || column[k - 1] != row {
                rows.push(row);
            }
        }
        starts[col + 1] = rows.len();
    }
    (starts, rows)
}
