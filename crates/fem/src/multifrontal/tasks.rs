//! Runs the tasks of a factorisation or a solve on the tree: upwards, each task after its children; downwards, before them.
//!
//! A task depends only on its inputs, and uses them in the order of its children, whichever thread computed them: results do
//! not depend on the number of threads.

use super::symbolic::SymbolicCholesky;
use crate::ordering::NONE;
use rayon::ScopeFifo;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// A slot of one task.
pub(super) type Slot<T> = Mutex<Option<T>>;

/// Opens a slot. After a panic elsewhere, these values are no longer used anyway.
pub(super) fn open<T>(slot: &Mutex<T>) -> MutexGuard<'_, T> {
    slot.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Empty slots.
pub(super) fn slots<T>(count: usize) -> Vec<Slot<T>> {
    (0..count).map(|_| Mutex::new(None)).collect()
}

/// Parent of each task, or `NONE`.
pub(super) fn parents(symbolic: &SymbolicCholesky) -> Vec<usize> {
    let mut parent = vec![NONE; symbolic.tasks.len()];
    for (t, task) in symbolic.tasks.iter().enumerate() {
        for &child in &task.children {
            parent[child] = t;
        }
    }
    parent
}

/// Calls `work` for every task after its children.
pub(super) fn upwards(symbolic: &SymbolicCholesky, work: &(dyn Fn(usize) + Sync)) {
    let parent = parents(symbolic);
    let waiting: Vec<AtomicUsize> =
        symbolic.tasks.iter().map(|t| AtomicUsize::new(t.children.len())).collect();
    let climb = |start: usize| {
        let mut t = start;
        loop {
            work(t);
            // The last child to finish continues with the parent.
            let up = parent[t];
            if up == NONE || waiting[up].fetch_sub(1, Ordering::AcqRel) > 1 {
                return;
            }
            t = up;
        }
    };
    let leaves: Vec<usize> =
        (0..symbolic.tasks.len()).filter(|&t| symbolic.tasks[t].children.is_empty()).collect();
    if let [only] = leaves[..] {
        return climb(only);
    }
    let climb = &climb;
    rayon::scope_fifo(|scope| {
        for &leaf in &leaves {
            scope.spawn_fifo(move |_| climb(leaf));
        }
    });
}

/// Calls `work` for every task before its children.
pub(super) fn downwards(symbolic: &SymbolicCholesky, work: &(dyn Fn(usize) + Sync)) {
    if symbolic.tasks.len() == 1 {
        return work(0);
    }
    rayon::scope_fifo(|scope| {
        for &root in &symbolic.roots {
            scope.spawn_fifo(move |scope| descend(symbolic, work, root, scope));
        }
    });
}

fn descend<'s>(
    symbolic: &'s SymbolicCholesky,
    work: &'s (dyn Fn(usize) + Sync),
    start: usize,
    scope: &ScopeFifo<'s>,
) {
    let mut t = start;
    loop {
        work(t);
        let Some((&last, others)) = symbolic.tasks[t].children.split_last() else { return };
        for &child in others {
            scope.spawn_fifo(move |scope| descend(symbolic, work, child, scope));
        }
        t = last;
    }
}
