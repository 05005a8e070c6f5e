//! A fixed pattern of a sum of dense blocks, with the position of every block entry.

use crate::dof::Equations;
use crate::scatter::Gather;
use crate::term::Pattern;
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat, SymbolicSparseColMatRef};

/// Stored entries of a matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// All of them.
    Whole,
    /// The lower triangle, for symmetric matrices.
    Lower,
}

/// Compressed-column pattern of a sum of dense blocks, with the position of every block entry.
#[derive(Clone, Debug)]
pub struct ScatterMap {
    symbolic: SymbolicSparseColMat<usize>,
    /// Index of the first value of each pattern among all values, and the contributions to each stored entry.
    gathers: Vec<(usize, Gather)>,
    values: Vec<f64>,
}

/// Marks block entries without a position: fixed degrees of freedom, or the triangle that is not stored.
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

    /// Adds the values of one pattern, whose first is the `offset`-th of all. Returns the offset after them. It is parallel,
    /// with the same bits for any number of threads.
    pub fn add(&mut self, offset: usize, block_values: &[f64]) -> usize {
        if block_values.is_empty() {
            return offset;
        }
        // Patterns without values share their offset with the next one, and add nothing.
        for (_, gather) in self.gathers.iter().filter(|(first, _)| *first == offset) {
            gather.add(block_values, &mut self.values);
        }
        offset + block_values.len()
    }

    /// The current matrix.
    #[must_use]
    pub fn matrix(&self) -> SparseColMatRef<'_, usize, f64> {
        SparseColMatRef::new(self.symbolic.as_ref(), &self.values)
    }

    /// Positions of the stored entries.
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

    /// Memory of the lists of contributions \[bytes\].
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.gathers.iter().map(|(_, gather)| gather.bytes()).sum()
    }
}

/// The lower triangle of the free equations of some patterns, without the positions of their blocks.
#[must_use]
pub fn lower_pattern(patterns: &[&Pattern], equations: &Equations) -> SymbolicSparseColMat<usize> {
    let n = equations.free.len();
    let wanted = |row: usize, col: usize| row != Equations::FIXED && col != Equations::FIXED && row >= col;
    let visit = |f: &mut dyn FnMut(usize, usize)| visit_blocks(patterns, equations, f);
    let (starts, rows) = compress_columns(n, &wanted, &visit);
    SymbolicSparseColMat::new_checked(n, n, starts, None, rows)
}

/// The lower triangle of a sum of dense blocks, bordered by rows `-border`: those of loads f in `[K -f; -fᵀ 0]`. `number` gives the
/// equation of each degree of freedom. It is assembled only once; a [`ScatterMap`] would need as much memory again for its lists.
#[must_use]
pub fn lower_matrix(
    pattern: &Pattern,
    blocks: &[f64],
    number: &[usize],
    equations: usize,
    border: &[Vec<f64>],
) -> (SymbolicSparseColMat<usize>, Vec<f64>) {
    let n = equations + border.len();
    let wanted = |row: usize, col: usize| row != Equations::FIXED && col != Equations::FIXED && row >= col;
    let loaded = |f: &mut dyn FnMut(usize, usize, f64)| {
        for (k, load) in border.iter().enumerate() {
            let parts = load.iter().enumerate().filter(|(_, v)| **v != 0.0);
            parts.for_each(|(col, value)| f(equations + k, col, -value));
        }
    };
    let visit = |f: &mut dyn FnMut(usize, usize)| {
        visit_numbered(pattern, number, f);
        loaded(&mut |row, col, _| f(row, col));
    };
    let (starts, rows) = compress_columns(n, &wanted, &visit);
    let mut values = vec![0.0; rows.len()];
    let mut add = |row: usize, col: usize, value: f64| {
        // The row is in its column by construction of `rows`.
        if let Ok(k) = rows[starts[col]..starts[col + 1]].binary_search(&row) {
            values[starts[col] + k] += value;
        }
    };
    let mut next = blocks.iter();
    visit_numbered(pattern, number, &mut |row, col| {
        let value = next.next();
        if wanted(row, col)
            && let Some(value) = value
        {
            add(row, col, *value);
        }
    });
    loaded(&mut add);
    (SymbolicSparseColMat::new_checked(n, n, starts, None, rows), values)
}

/// Calls `f` with (row, column) of every entry of every block, in order.
fn visit_numbered(pattern: &Pattern, number: &[usize], f: &mut dyn FnMut(usize, usize)) {
    for block in pattern.blocks() {
        for &r in block {
            for &c in block {
                f(number[r], number[c]);
            }
        }
    }
}

/// Calls `f` with (row, column) of every entry of every block of some patterns, in order.
fn visit_blocks(patterns: &[&Pattern], equations: &Equations, f: &mut dyn FnMut(usize, usize)) {
    patterns.iter().for_each(|pattern| visit_numbered(pattern, &equations.number, f));
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
    // Sorts and removes repetitions in place.
    let mut starts = vec![0_usize; n + 1];
    let mut kept = 0;
    for col in 0..n {
        raw[count[col]..count[col + 1]].sort_unstable();
        let first = kept;
        for k in count[col]..count[col + 1] {
            if kept == first || raw[kept - 1] != raw[k] {
                raw[kept] = raw[k];
                kept += 1;
            }
        }
        starts[col + 1] = kept;
    }
    raw.truncate(kept);
    raw.shrink_to_fit();
    (starts, raw)
}
