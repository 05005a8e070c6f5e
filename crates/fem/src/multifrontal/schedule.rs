//! Memory of a factorisation that keeps no factor, determined by simulating its tasks on a number of threads.
//!
//! The largest fronts lie on one path to the root and never run together, so that a sum over the largest tasks would predict several
//! times the actual memory. The duration of a task is taken as its number of operations. Runs differ only in the speed of their
//! threads.

use super::symbolic::SymbolicCholesky;
use super::tasks;
use crate::ordering::NONE;
use std::collections::BTreeSet;

/// A running task: its end time, and its index, which decides between tasks that end together.
type RunningTasks = BTreeSet<(u64, usize)>;

impl SymbolicCholesky {
    /// Memory used by [`Cholesky::schur`](super::Cholesky::schur) with `threads` threads \[bytes\].
    #[must_use]
    pub fn bytes_of_schur(&self, threads: usize) -> usize {
        self.schur(threads, Passes::Written)
    }

    /// Memory allocated by it, some of which is never written \[bytes\].
    #[must_use]
    pub fn asked_by_schur(&self, threads: usize) -> usize {
        self.schur(threads, Passes::All)
    }

    fn schur(&self, threads: usize, passes: Passes) -> usize {
        let values = values_of_schur(self, &tasks::parents(self), threads, passes);
        values * size_of::<f64>() + self.own()
    }
}

/// Part of a front's contribution that is counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Passes {
    /// All of it, as allocated.
    All,
    /// Its lower triangle, which is written and thus occupies memory: operating systems provide pages when they are first
    /// written. The same holds for the Schur complement.
    Written,
}

/// Largest number of values in use during the elimination with `threads` threads.
fn values_of_schur(symbolic: &SymbolicCholesky, parent: &[usize], threads: usize, passes: Passes) -> usize {
    let passed = |t: usize| match passes {
        Passes::All => symbolic.passed(t),
        Passes::Written => triangle(symbolic.passed(t)),
    };
    let beside = |t: usize| match passes {
        Passes::Written if symbolic.stops_in(t) => triangle(symbolic.beside(t)),
        _ => symbolic.beside(t),
    };
    let tasks = &symbolic.tasks;
    let mut left: Vec<usize> = tasks.iter().map(|t| t.children.len()).collect();
    let mut leaves = (0..tasks.len()).filter(|&t| tasks[t].children.is_empty());
    let mut running = RunningTasks::new();
    let (mut alive, mut most) = (0, 0);
    // A thread continues with the parent of the last child that ended, otherwise with the next leaf.
    let mut begin = |t: usize, now: u64, running: &mut RunningTasks, alive: &mut usize| {
        *alive += passed(t) + beside(t);
        most = most.max(*alive);
        running.insert((now.saturating_add(symbolic.operations_of(t) as u64 + 1), t));
    };
    for t in leaves.by_ref().take(threads.max(1)) {
        begin(t, 0, &mut running, &mut alive);
    }
    while let Some((end, t)) = running.pop_first() {
        let taken: usize = tasks[t].children.iter().map(|&c| passed(c)).sum();
        alive -= beside(t) + taken;
        let up = parent[t];
        let ready = up != NONE && {
            left[up] -= 1;
            left[up] == 0
        };
        let next = if ready { Some(up) } else { leaves.next() };
        if let Some(next) = next {
            begin(next, end, &mut running, &mut alive);
        }
    }
    most
}

/// Number of values in the lower triangle of a square of this order.
fn triangle(square: usize) -> usize {
    let rows = square.isqrt();
    rows * (rows + 1) / 2
}
