//! Solution with a factor: forwards from the leaves to the root, backwards from the root to the leaves.
//!
//! Each front works on its rows of the right-hand side; its subtractions from rows that it does not own go to its parent, at
//! the same places as its contribution to the matrix.

use super::dense::{view, view_mut};
use super::kernel::{BackwardSubstitution, ForwardSubstitution};
use super::numeric::Cholesky;
use super::symbolic::{Front, SymbolicCholesky};
use super::tasks::{self, Slot, open, slots};
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{solve_lower_triangular_in_place, solve_upper_triangular_in_place};
use faer::{Accum, MatMut, MatRef, Par};
use rayon::prelude::*;
use std::sync::Mutex;

/// Number of right-hand sides solved together. It is fixed, so that results do not depend on the number of threads. Wider
/// blocks reuse the factor more often, until their rows leave the cache; 64 to 128 were measured to be best.
const BLOCK: usize = 64;

/// Number of right-hand sides up to which each is treated separately: for fewer, a product of matrices costs more.
const SINGLE: usize = 3;

/// Right-hand sides of a block on their way through the tree.
struct Run<'a> {
    factor: &'a Cholesky,
    symbolic: &'a SymbolicCholesky,
    columns: usize,
    /// Rows of each task, column by column.
    rows: Vec<Mutex<Vec<f64>>>,
    /// Contributions that tasks pass up or down: one entry per task.
    passed: Vec<Slot<Vec<f64>>>,
}

impl Cholesky {
    /// Solves `K x = b` in place for each column. With retained equations this is not defined: see [`Cholesky::reduce`].
    pub fn solve(&self, rhs: MatMut<'_, f64>) {
        self.blocks(rhs, |run| {
            run.forwards();
            run.backwards();
        });
    }

    /// First half of a solve, in place for each column: eliminated rows b become `L⁻¹ f_b`, retained rows i become
    /// `f_i - K_ib K_bb⁻¹ f_b`.
    pub fn reduce(&self, rhs: MatMut<'_, f64>) {
        self.blocks(rhs, |run| run.forwards());
    }

    /// Second half, in place for each column: with `L⁻¹ f_b` in the eliminated rows and the solution `u_i` in the retained
    /// rows, the eliminated rows become `K_bb⁻¹ (f_b - K_bi u_i)`.
    pub fn recover(&self, rhs: MatMut<'_, f64>) {
        self.blocks(rhs, |run| run.backwards());
    }

    fn blocks(&self, rhs: MatMut<'_, f64>, work: impl Fn(&Run<'_>) + Sync) {
        debug_assert_eq!(rhs.nrows(), self.symbolic.equations());
        let mut rest = rhs;
        let mut blocks = Vec::new();
        while rest.ncols() > 0 {
            let width = BLOCK.min(rest.ncols());
            let (block, next) = rest.split_at_col_mut(width);
            blocks.push(block);
            rest = next;
        }
        let one = |block: MatMut<'_, f64>| {
            let run = Run::new(self, block.as_ref());
            work(&run);
            run.finish(block);
        };
        if blocks.len() == 1 {
            blocks.into_iter().for_each(one);
        } else {
            blocks.into_par_iter().with_max_len(1).for_each(one);
        }
    }
}

impl<'a> Run<'a> {
    /// Distributes right-hand sides to the tasks.
    fn new(factor: &'a Cholesky, rhs: MatRef<'_, f64>) -> Self {
        let symbolic = &*factor.symbolic;
        let columns = rhs.ncols();
        let gather = |t: usize| {
            let range = symbolic.task_rows(t);
            let mut rows = Vec::with_capacity(range.len() * columns);
            for c in 0..columns {
                let column = rhs.col(c);
                rows.extend(symbolic.order[range.clone()].iter().map(|&e| column[e as usize]));
            }
            Mutex::new(rows)
        };
        let rows = (0..symbolic.tasks.len()).map(gather).collect();
        Self { factor, symbolic, columns, rows, passed: slots(symbolic.tasks.len()) }
    }

    /// Collects the rows of all tasks.
    fn finish(self, mut rhs: MatMut<'_, f64>) {
        for (t, rows) in self.rows.into_iter().enumerate() {
            let range = self.symbolic.task_rows(t);
            let rows = rows.into_inner().unwrap_or_default();
            for (c, column) in rows.chunks_exact(range.len()).enumerate() {
                for (&equation, &value) in self.symbolic.order[range.clone()].iter().zip(column) {
                    rhs[(equation as usize, c)] = value;
                }
            }
        }
    }

    fn forwards(&self) {
        tasks::upwards(self.symbolic, &|t| {
            let result = self.forward_task(t);
            *open(&self.passed[t]) = Some(result);
        });
    }

    fn backwards(&self) {
        for &root in &self.symbolic.roots {
            *open(&self.passed[root]) = Some(Vec::new());
        }
        tasks::downwards(self.symbolic, &|t| self.backward_task(t));
    }

    /// Returns the contribution of the task's last front to its parent's rows.
    fn forward_task(&self, t: usize) -> Vec<f64> {
        let task = &self.symbolic.tasks[t];
        let first = self.symbolic.fronts[task.fronts.start].first;
        let mut rows = open(&self.rows[t]);
        let count = rows.len() / self.columns;
        // Contributions of finished fronts; the children of the next front are on top.
        let mut stack = Vec::new();
        for &child in &task.children {
            stack.extend(open(&self.passed[child]).take().expect("a task runs after its children"));
        }
        let mut work = Vec::new();
        for s in task.fronts.clone() {
            let front = &self.symbolic.fronts[s];
            work.clear();
            work.resize(front.height * self.columns, 0.0);
            for (column, rows) in work.chunks_exact_mut(front.height).zip(rows.chunks_exact(count)) {
                let own = front.first - first;
                column[..front.width].copy_from_slice(&rows[own..own + front.width]);
            }
            let taken = self.add_children(s, &mut work, &stack);
            stack.truncate(stack.len() - taken);
            if !self.stops(s) {
                self.forward_front(t, front, &mut work);
            }
            for (column, rows) in work.chunks_exact(front.height).zip(rows.chunks_exact_mut(count)) {
                let own = front.first - first;
                rows[own..own + front.width].copy_from_slice(&column[..front.width]);
                stack.extend_from_slice(&column[front.width..]);
            }
        }
        stack
    }

    /// True if a front holds the retained equations.
    fn stops(&self, s: usize) -> bool {
        self.symbolic.retained > 0 && s + 1 == self.symbolic.fronts.len()
    }

    /// Adds the contributions of the children of a front, which are on top of the stack; returns the remaining length.
    fn add_children(&self, s: usize, work: &mut [f64], stack: &[f64]) -> usize {
        let height = self.symbolic.fronts[s].height;
        let children = &self.symbolic.children[s];
        let length = |c: u32| self.symbolic.fronts[c as usize].rest() * self.columns;
        let total: usize = children.iter().map(|&c| length(c)).sum();
        let mut at = stack.len() - total;
        for &child in children {
            let places = self.symbolic.places(child as usize);
            if !places.is_empty() {
                let from = stack[at..at + length(child)].chunks_exact(places.len());
                for (column, from) in work.chunks_exact_mut(height).zip(from) {
                    for (&place, value) in places.iter().zip(from) {
                        column[place as usize] += value;
                    }
                }
            }
            at += length(child);
        }
        total
    }

    fn forward_front(&self, t: usize, front: &Front, work: &mut [f64]) {
        let panel = &self.factor.values[t][front.offset..front.offset + front.width * front.height];
        let (width, rows) = (front.width, front.height);
        if self.columns <= SINGLE {
            for x in work.chunks_exact_mut(rows) {
                self.factor.arch.dispatch(ForwardSubstitution { panel, rows, width, x });
            }
            return;
        }
        let (pivots, below) = view(panel, rows, width, rows).split_at_row(width);
        let (mut own, rest) = view_mut(work, rows, self.columns, rows).split_at_row_mut(width);
        solve_lower_triangular_in_place(pivots, own.as_mut(), Par::Seq);
        if rest.nrows() > 0 {
            matmul(rest, Accum::Add, below, own.as_ref(), -1.0, Par::Seq);
        }
    }

    /// Takes the solution in the rows beyond the pivots of its root, and passes their parts to its children.
    fn backward_task(&self, t: usize) {
        let task = &self.symbolic.tasks[t];
        let first = self.symbolic.fronts[task.fronts.start].first;
        let mut rows = open(&self.rows[t]);
        let count = rows.len() / self.columns;
        // Solutions in the rows beyond the pivots of the remaining fronts, the next one's on top.
        let mut stack = open(&self.passed[t]).take().unwrap_or_default();
        let mut work = Vec::new();
        for s in task.fronts.clone().rev() {
            let front = &self.symbolic.fronts[s];
            let own = front.first - first;
            let bottom = stack.len() - front.rest() * self.columns;
            work.clear();
            for (c, rows) in rows.chunks_exact(count).enumerate() {
                work.extend_from_slice(&rows[own..own + front.width]);
                let at = bottom + c * front.rest();
                work.extend_from_slice(&stack[at..at + front.rest()]);
            }
            stack.truncate(bottom);
            if !self.stops(s) {
                self.backward_front(t, front, &mut work);
            }
            for (column, rows) in work.chunks_exact(front.height).zip(rows.chunks_exact_mut(count)) {
                rows[own..own + front.width].copy_from_slice(&column[..front.width]);
            }
            if task.subtree {
                for &child in &self.symbolic.children[s] {
                    self.hand_down(child as usize, front.height, &work, &mut stack);
                }
            } else {
                for (&child, &task) in self.symbolic.children[s].iter().zip(&task.children) {
                    let mut passed = Vec::new();
                    self.hand_down(child as usize, front.height, &work, &mut passed);
                    *open(&self.passed[task]) = Some(passed);
                }
            }
        }
    }

    /// Appends the parent's solution in the rows of a child.
    fn hand_down(&self, child: usize, height: usize, work: &[f64], to: &mut Vec<f64>) {
        let places = self.symbolic.places(child);
        for column in work.chunks_exact(height) {
            to.extend(places.iter().map(|&p| column[p as usize]));
        }
    }

    fn backward_front(&self, t: usize, front: &Front, work: &mut [f64]) {
        let panel = &self.factor.values[t][front.offset..front.offset + front.width * front.height];
        let (width, rows) = (front.width, front.height);
        if self.columns <= SINGLE {
            for x in work.chunks_exact_mut(rows) {
                self.factor.arch.dispatch(BackwardSubstitution { panel, rows, width, x });
            }
            return;
        }
        let (pivots, below) = view(panel, rows, width, rows).split_at_row(width);
        let (mut own, rest) = view_mut(work, rows, self.columns, rows).split_at_row_mut(width);
        if rest.nrows() > 0 {
            matmul(own.as_mut(), Accum::Add, below.transpose(), rest.as_ref(), -1.0, Par::Seq);
        }
        solve_upper_triangular_in_place(pivots.transpose(), own, Par::Seq);
    }
}
