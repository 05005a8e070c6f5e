//! Symbolic analysis: everything about a factorisation that is determined by the pattern.

use super::DirectError;
use super::supernodes::Supernodes;
use super::tree::Forest;
use crate::ordering::{CompressedPattern, NONE, Ordering, compress, order};
use faer::sparse::SymbolicSparseColMatRef;
use std::ops::Range;

/// Subtrees cheaper than this fraction of the whole factorisation are eliminated by one thread. It is a constant, so that
/// results do not depend on the number of threads; 64 subtrees of equal cost keep a dozen threads busy.
const TASK_SHARE: f64 = 1.0 / 64.0;

/// Number of operations below which a subtree is not worth a separate task: about a millisecond.
const SMALLEST_TASK: f64 = 2e7;

/// A front: a dense lower trapezoid of `height` rows whose first `width` are eliminated.
#[derive(Clone, Copy, Debug)]
pub(super) struct Front {
    /// Position of its first pivot in the order of elimination.
    pub first: usize,
    /// Pivots.
    pub width: usize,
    /// Rows, including pivots.
    pub height: usize,
    /// Start of its column values in the storage of its task (column by column, `height` rows each).
    pub offset: usize,
    /// Start of its entries in [`SymbolicCholesky::relative`].
    pub relative: usize,
    /// Stack, of the two of a sequential task, that holds its contribution, and the position there.
    pub stack: (usize, usize),
}

impl Front {
    /// Rows passed on to the parent.
    pub fn rest(&self) -> usize {
        self.height - self.width
    }

    /// Operations of its elimination.
    fn operations(&self) -> f64 {
        let (w, h) = (self.width as f64, self.height as f64);
        // Sum of (h - i)^2 for i < w.
        w * h * h - h * w * (w - 1.0) + (w - 1.0) * w * (2.0 * w - 1.0) / 6.0
    }
}

/// A value of the matrix in a front's column.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    /// Index among the stored values of the matrix.
    pub source: u32,
    /// Row of the front.
    pub row: u32,
}

/// Fronts eliminated by one thread in order: a subtree, or one front near the root.
#[derive(Clone, Debug)]
pub(super) struct Task {
    /// Its fronts.
    pub fronts: Range<usize>,
    /// True for a subtree, false for a single front near the root.
    pub subtree: bool,
    /// First task below it: the tasks of its subtree are `lowest..=` itself.
    pub lowest: usize,
    /// Tasks whose contributions it takes, ascending.
    pub children: Vec<usize>,
    /// Number of values of its factor.
    pub values: usize,
    /// Number of values of its largest front.
    pub largest: usize,
    /// Sizes of its two stacks.
    pub stacks: [usize; 2],
}

/// Symbolic Cholesky factorisation of a pattern under a fill-reducing order. It serves any number of matrices with the same
/// pattern.
#[derive(Clone, Debug)]
pub struct SymbolicCholesky {
    /// Equation at each position of the order of elimination.
    pub(super) order: Vec<u32>,
    pub(super) fronts: Vec<Front>,
    pub(super) children: Vec<Vec<u32>>,
    /// Row in the parent's front, for each row that a front passes on.
    pub(super) relative: Vec<u32>,
    /// Start of each column's entries.
    pub(super) entry_start: Vec<usize>,
    pub(super) entries: Vec<Entry>,
    pub(super) tasks: Vec<Task>,
    /// Tasks without parent.
    pub(super) roots: Vec<usize>,
    pub(super) retained: usize,
    stored: usize,
    operations: f64,
    bytes: usize,
}

impl SymbolicCholesky {
    /// Analyses a lower triangle with sorted rows.
    ///
    /// # Errors
    /// [`DirectError::Ordering`], if the pattern has more than 2^32 entries or the ordering fails.
    pub fn new(pattern: SymbolicSparseColMatRef<'_, usize>, ordering: Ordering) -> Result<Self, DirectError> {
        Self::retaining(pattern, ordering, &[])
    }

    /// Analyses a lower triangle, with the equations `retained` (sorted) at the end, in their order. They are not eliminated:
    /// the factorisation stops at their Schur complement.
    ///
    /// # Errors
    /// As [`SymbolicCholesky::new`].
    pub fn retaining(
        pattern: SymbolicSparseColMatRef<'_, usize>,
        ordering: Ordering,
        retained: &[usize],
    ) -> Result<Self, DirectError> {
        if u32::try_from(pattern.compute_nnz()).is_err() {
            return Err(DirectError::Ordering("the matrix has more than 2^32 entries".into()));
        }
        let mut class = vec![false; pattern.ncols()];
        for &equation in retained {
            class[equation] = true;
        }
        let matrix = compress(pattern, &class);
        let last: Vec<bool> = (0..matrix.graph.len()).map(|v| class[matrix.first[v]]).collect();
        let kept = last.iter().filter(|&&l| l).count();
        let cost = |order: &[usize]| Forest::new(&matrix, order, kept).operations(&matrix);
        let order = order(&matrix.graph, &last, ordering, &cost)?;
        let forest = Forest::new(&matrix, &order, kept);
        let supernodes = Supernodes::new(&matrix, &forest, kept);
        let mut symbolic = Self::from_fronts(&matrix, &supernodes);
        symbolic.retained = retained.len();
        symbolic.place_entries(pattern);
        symbolic.cut_tasks(&supernodes.parent);
        Ok(symbolic)
    }

    /// Fronts with their rows.
    fn from_fronts(matrix: &CompressedPattern, supernodes: &Supernodes) -> Self {
        let count = supernodes.parent.len();
        let mut children = vec![Vec::new(); count];
        for (s, &p) in supernodes.parent.iter().enumerate().filter(|&(_, &p)| p != NONE) {
            children[p].push(s as u32);
        }
        let equations = |v: usize| matrix.first[v]..matrix.first[v + 1];
        let order = supernodes.order.iter().flat_map(|&v| equations(v)).map(|e| e as u32).collect();
        let rows = vertex_rows(matrix, supernodes, &children);
        let mut fronts = Vec::with_capacity(count);
        let mut relative = Vec::new();
        let mut place = vec![0_usize; matrix.graph.len()];
        let mut first = 0;
        for (s, rows) in rows.iter().enumerate() {
            let pivots = supernodes.first[s]..supernodes.first[s + 1];
            let sum = |list: &mut dyn Iterator<Item = usize>| {
                list.map(|k| matrix.weight(supernodes.order[k])).sum::<usize>()
            };
            let width = sum(&mut pivots.clone());
            let height = width + sum(&mut rows.iter().map(|&k| k as usize));
            fronts.push(Front { first, width, height, offset: 0, relative: 0, stack: (0, 0) });
            first += width;
        }
        // Places in the parent: the rows of a front are its pivots, then its other rows, ascending.
        for s in 0..count {
            let mut row = 0;
            let pivots = supernodes.first[s]..supernodes.first[s + 1];
            for k in pivots.chain(rows[s].iter().map(|&k| k as usize)) {
                place[k] = row;
                row += matrix.weight(supernodes.order[k]);
            }
            for &child in &children[s] {
                fronts[child as usize].relative = relative.len();
                for &k in &rows[child as usize] {
                    let at = place[k as usize];
                    relative.extend((at..at + matrix.weight(supernodes.order[k as usize])).map(|r| r as u32));
                }
            }
        }
        let operations = fronts.iter().map(Front::operations).sum();
        let stored =
            fronts.iter().map(|f| f.width * f.height - f.width * f.width.saturating_sub(1) / 2).sum();
        Self {
            order,
            fronts,
            children,
            relative,
            entry_start: Vec::new(),
            entries: Vec::new(),
            tasks: Vec::new(),
            roots: Vec::new(),
            retained: 0,
            stored,
            operations,
            bytes: 0,
        }
    }

    /// Finds the destination of each value of the matrix.
    fn place_entries(&mut self, pattern: SymbolicSparseColMatRef<'_, usize>) {
        let n = self.order.len();
        let mut position = vec![0_u32; n];
        for (k, &equation) in self.order.iter().enumerate() {
            position[equation as usize] = k as u32;
        }
        let starts = pattern.col_ptr();
        let rows = pattern.row_idx();
        let visit = |f: &mut dyn FnMut(usize, u32, usize)| {
            for col in 0..n {
                let at = position[col];
                for source in starts[col]..starts[col + 1] {
                    if rows[source] >= col {
                        let other = position[rows[source]];
                        f(at.min(other) as usize, at.max(other), source);
                    }
                }
            }
        };
        let mut start = vec![0_usize; n + 1];
        visit(&mut |col, _, _| start[col + 1] += 1);
        for k in 0..n {
            start[k + 1] += start[k];
        }
        let mut next = start.clone();
        let mut entries = vec![Entry { source: 0, row: 0 }; start[n]];
        visit(&mut |col, row, source| {
            entries[next[col]] = Entry { source: source as u32, row };
            next[col] += 1;
        });
        self.entry_start = start;
        self.entries = entries;
        self.localise_entries();
    }

    /// Converts positions in the order of elimination into rows of the front. A row beyond a front's pivots is found through
    /// the parent that eliminates it, so the rows of a front are listed from its ancestors' places.
    fn localise_entries(&mut self) {
        let n = self.order.len();
        let mut local = vec![0_u32; n];
        let rows = self.equation_rows();
        for (front, rows) in self.fronts.iter().zip(&rows) {
            for k in 0..front.width {
                local[front.first + k] = k as u32;
            }
            for (k, &row) in rows.iter().enumerate() {
                local[row as usize] = (front.width + k) as u32;
            }
            for col in front.first..front.first + front.width {
                for entry in &mut self.entries[self.entry_start[col]..self.entry_start[col + 1]] {
                    entry.row = local[entry.row as usize];
                }
            }
        }
    }

    /// Positions of the rows that each front passes on.
    fn equation_rows(&self) -> Vec<Vec<u32>> {
        let mut rows: Vec<Vec<u32>> = vec![Vec::new(); self.fronts.len()];
        for s in (0..self.fronts.len()).rev() {
            let front = self.fronts[s];
            for &child in &self.children[s] {
                let places = self.places(child as usize);
                let of_child = places.iter().map(|&r| {
                    let r = r as usize;
                    if r < front.width { (front.first + r) as u32 } else { rows[s][r - front.width] }
                });
                rows[child as usize] = of_child.collect();
            }
        }
        rows
    }

    /// Rows in the parent's front of a front's contribution.
    pub(super) fn places(&self, front: usize) -> &[u32] {
        let f = &self.fronts[front];
        &self.relative[f.relative..f.relative + f.rest()]
    }

    /// Positions of a task's pivots in the order of elimination.
    pub(super) fn task_rows(&self, t: usize) -> Range<usize> {
        let fronts = &self.tasks[t].fronts;
        let last = &self.fronts[fronts.end - 1];
        self.fronts[fronts.start].first..last.first + last.width
    }

    /// Divides the tree into tasks, places values and contributions, and sums up the memory.
    fn cut_tasks(&mut self, parent: &[usize]) {
        let count = self.fronts.len();
        let mut below: Vec<f64> = self.fronts.iter().map(Front::operations).collect();
        let mut lowest: Vec<usize> = (0..count).collect();
        for s in 0..count {
            if parent[s] != NONE {
                below[parent[s]] += below[s];
                lowest[parent[s]] = lowest[parent[s]].min(lowest[s]);
            }
        }
        let most = (self.operations * TASK_SHARE).max(SMALLEST_TASK);
        // The Schur complement is not merged into a task with others, since elimination stops there.
        let stops = |s: usize| self.retained > 0 && s + 1 == count;
        let small: Vec<bool> = (0..count).map(|s| below[s] <= most && !stops(s)).collect();
        let mut task_of = vec![NONE; count];
        for s in 0..count {
            let inside = small[s] && parent[s] != NONE && small[parent[s]];
            if inside {
                continue;
            }
            let fronts = if small[s] { lowest[s]..s + 1 } else { s..s + 1 };
            let subtree = small[s];
            let children: Vec<usize> = if subtree {
                Vec::new()
            } else {
                self.children[s].iter().map(|&c| task_of[c as usize]).collect()
            };
            let lowest =
                children.iter().map(|&c: &usize| self.tasks[c].lowest).min().unwrap_or(self.tasks.len());
            task_of[s] = self.tasks.len();
            if parent[s] == NONE {
                self.roots.push(self.tasks.len());
            }
            let (values, stacks) = self.place_values(fronts.clone());
            let largest = self.fronts[fronts.clone()].iter().map(|f| f.width * f.height).max().unwrap_or(0);
            self.tasks.push(Task { fronts, subtree, lowest, children, values, largest, stacks });
        }
        self.bytes = self.peak();
    }

    /// Offsets of the values of a task's fronts and of their contributions on two stacks. A front's contribution lies on the
    /// other stack than its children's, so that the children's can be dropped when it is complete.
    fn place_values(&mut self, fronts: Range<usize>) -> (usize, [usize; 2]) {
        let root = fronts.end - 1;
        let mut side = vec![0_usize; fronts.len()];
        for s in fronts.clone().rev() {
            for &child in &self.children[s] {
                if fronts.contains(&(child as usize)) {
                    side[child as usize - fronts.start] = 1 - side[s - fronts.start];
                }
            }
        }
        let (mut values, mut top, mut most) = (0, [0; 2], [0; 2]);
        for s in fronts.clone() {
            let on = side[s - fronts.start];
            let front = &mut self.fronts[s];
            front.offset = values;
            front.stack = (on, top[on]);
            values += front.width * front.height;
            if s != root {
                top[on] += front.rest().pow(2);
                most[on] = most[on].max(top[on]);
            }
            if let Some(&child) = self.children[s].iter().find(|&&c| fronts.contains(&(c as usize))) {
                top[1 - on] = self.fronts[child as usize].stack.1;
            }
        }
        (values, most)
    }

    /// Number of values that a task passes on.
    pub(super) fn passed(&self, t: usize) -> usize {
        self.fronts[self.tasks[t].fronts.end - 1].rest().pow(2)
    }

    /// Largest number of values in use besides the factor, if all tasks that can run together do.
    fn temporary(&self) -> usize {
        let mut peak = vec![0_usize; self.tasks.len()];
        for (t, task) in self.tasks.iter().enumerate() {
            let below: usize = task.children.iter().map(|&c| peak[c]).sum();
            let waiting: usize = task.children.iter().map(|&c| self.passed(c)).sum();
            peak[t] = below.max(waiting + self.passed(t) + task.stacks[0] + task.stacks[1]);
        }
        self.roots.iter().map(|&t| peak[t]).sum()
    }

    /// Memory of the analysis data that a factorisation reads \[bytes\].
    pub(super) fn own(&self) -> usize {
        size_of_val(self.relative.as_slice()) + size_of_val(self.entries.as_slice())
    }

    /// Peak memory if all tasks that can run together do \[bytes\].
    fn peak(&self) -> usize {
        let values: usize = self.tasks.iter().map(|t| t.values).sum();
        (values + self.temporary()) * size_of::<f64>() + self.own()
    }

    /// Number of values that a task holds while it runs, besides its contribution.
    pub(super) fn beside(&self, t: usize) -> usize {
        let task = &self.tasks[t];
        task.stacks[0] + task.stacks[1] + task.largest
    }

    /// True if a task is the front at which elimination stops.
    pub(super) fn stops_in(&self, t: usize) -> bool {
        self.retained > 0 && t + 1 == self.tasks.len()
    }

    /// Operations of a task.
    pub(super) fn operations_of(&self, t: usize) -> f64 {
        self.fronts[self.tasks[t].fronts.clone()].iter().map(Front::operations).sum()
    }

    /// Equations.
    #[must_use]
    pub fn equations(&self) -> usize {
        self.order.len()
    }

    /// Equations that are not eliminated.
    #[must_use]
    pub fn retained(&self) -> usize {
        self.retained
    }

    /// Number of entries of the factor, including explicit zeros of merged fronts.
    #[must_use]
    pub fn stored(&self) -> usize {
        self.stored
    }

    /// Multiplications and additions of the numeric factorisation.
    #[must_use]
    pub fn operations(&self) -> f64 {
        self.operations
    }

    /// Number of fronts of the factorisation.
    #[must_use]
    pub fn fronts(&self) -> usize {
        self.fronts.len()
    }

    /// Memory of a numeric factorisation \[bytes\]: an upper bound for any number of threads.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.bytes
    }

    /// Refuses a factorisation that needs more than `allowed` bytes.
    ///
    /// # Errors
    /// [`DirectError::Memory`] with both numbers.
    pub fn admit(&self, allowed: usize) -> Result<(), DirectError> {
        if self.bytes <= allowed {
            return Ok(());
        }
        Err(DirectError::Memory { needed: self.bytes, allowed, equations: self.equations() })
    }

    /// Equation at each position of the order of elimination.
    pub fn order(&self) -> impl Iterator<Item = usize> + '_ {
        self.order.iter().map(|&e| e as usize)
    }
}

/// Positions of the vertices that each front passes on, ascending: neighbours of its vertices and the contributions of its
/// children, beyond its own vertices.
fn vertex_rows(matrix: &CompressedPattern, supernodes: &Supernodes, children: &[Vec<u32>]) -> Vec<Vec<u32>> {
    let mut position = vec![0_u32; supernodes.order.len()];
    for (k, &v) in supernodes.order.iter().enumerate() {
        position[v] = k as u32;
    }
    let mut seen = vec![NONE; supernodes.order.len()];
    let mut rows: Vec<Vec<u32>> = Vec::with_capacity(children.len());
    for (s, children) in children.iter().enumerate() {
        let end = supernodes.first[s + 1] as u32;
        let mut own = Vec::new();
        let mut take = |k: u32| {
            if k >= end && seen[k as usize] != s {
                seen[k as usize] = s;
                own.push(k);
            }
        };
        for &v in &supernodes.order[supernodes.first[s]..supernodes.first[s + 1]] {
            for &u in matrix.graph.neighbours(v) {
                take(position[u as usize]);
            }
        }
        for &child in children {
            rows[child as usize].iter().copied().for_each(&mut take);
        }
        own.sort_unstable();
        rows.push(own);
    }
    rows
}
