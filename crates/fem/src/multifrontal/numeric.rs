//! Numeric factorisation over the tree of fronts.
//!
//! A front adds the matrix's values of its columns and the contributions of its children (extend-add) and eliminates its
//! pivots. It passes on `-L L'` of its other rows plus the contributions of its children there (Duff, Reid 1983; Liu 1992).

use super::extend::{ContributionBlock, extend};
use super::symbolic::{Front, SymbolicCholesky};
use super::tasks::{self, Slot, open, slots};
use super::triangle::Triangle;
use super::{DirectError, Pivot, dense};
use faer::MatMut;
use pulp::Arch;
use std::fmt;
use std::sync::{Arc, Mutex};

/// A pivot below this times sqrt(n) of its original diagonal entry has no correct digit. Eliminating n equations perturbs it by
/// v'Ev. Here E has entries of the size of eps times the diagonal, and v is the free mode scaled to one at the pivot; n such
/// rounding errors add up like sqrt(n). The factor 16 covers modes that are larger elsewhere.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// A pivot that is not positive but smaller than this relative to its diagonal entry is rounding of a singular matrix, not a
/// sign of a negative mode. The free mode may be much larger elsewhere than at its pivot.
const NOT_NEGATIVE: f64 = 1e-8;

/// A positive pivot below this relative to its diagonal entry requires an examination of its mode: one half solve.
const SUSPECT: f64 = 1e-8;

/// Numeric Cholesky factorisation `P K P' = L L'`, or, with retained equations, its part up to their Schur complement.
#[derive(Clone)]
pub struct Cholesky {
    pub(super) symbolic: Arc<SymbolicCholesky>,
    /// Values of each task's fronts.
    pub(super) values: Vec<Vec<f64>>,
    pub(super) arch: Arch,
}

impl fmt::Debug for Cholesky {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Cholesky")
            .field("equations", &self.symbolic.equations())
            .field("stored", &self.symbolic.stored())
            .finish_non_exhaustive()
    }
}

/// Buffers for contributions, reused from front to front.
#[derive(Default)]
struct Pool(Mutex<Vec<Vec<f64>>>);

impl Pool {
    /// A buffer of at least `len` values, with arbitrary content.
    fn take(&self, len: usize) -> Result<Vec<f64>, DirectError> {
        if len == 0 {
            return Ok(Vec::new());
        }
        let mut buffers = open(&self.0);
        let best = (0..buffers.len()).filter(|&k| buffers[k].len() >= len).min_by_key(|&k| buffers[k].len());
        if let Some(k) = best {
            return Ok(buffers.swap_remove(k));
        }
        drop(buffers);
        zeros(len)
    }

    fn give(&self, buffer: Vec<f64>) {
        if !buffer.is_empty() {
            open(&self.0).push(buffer);
        }
    }
}

/// Zeros. Memory is reserved first because `vec!` cannot report failure. `vec!` is used because pages from the operating system
/// are zero and stay untouched until used.
fn zeros(len: usize) -> Result<Vec<f64>, DirectError> {
    Vec::<f64>::new().try_reserve_exact(len).map_err(|_| DirectError::OutOfMemory)?;
    Ok(vec![0.0; len])
}

/// Data shared by all fronts of one factorisation.
struct Run<'a> {
    symbolic: &'a SymbolicCholesky,
    matrix: &'a [f64],
    arch: Arch,
    /// Smallest pivot relative to its diagonal entry.
    smallest: f64,
    pool: Pool,
    /// Values of each task's fronts; if the factor is not kept, of the last task only.
    values: Vec<Mutex<Vec<f64>>>,
    /// True if the factor is kept.
    keep: bool,
    /// Smallest pivot relative to its diagonal entry, and its position.
    least: Mutex<(f64, usize)>,
    /// Contribution of each task.
    contributions: Vec<Slot<Result<Vec<f64>, DirectError>>>,
}

impl Cholesky {
    /// Factors the matrix with stored values `matrix`, in the order of the analysed pattern.
    ///
    /// # Errors
    /// [`DirectError::NotPositive`] and [`DirectError::Singular`] with the equation; [`DirectError::OutOfMemory`].
    pub fn new(symbolic: Arc<SymbolicCholesky>, matrix: &[f64]) -> Result<Self, DirectError> {
        let values = vec![Vec::new(); symbolic.tasks.len()];
        Self { symbolic, values, arch: Arch::new() }.refactor(matrix)
    }

    /// Factors another matrix of the same pattern in the same storage.
    ///
    /// # Errors
    /// As [`Cholesky::new`]; the old factor is then lost.
    pub fn refactor(self, matrix: &[f64]) -> Result<Self, DirectError> {
        let Self { symbolic, values, arch } = self;
        let run = Run::new(&symbolic, matrix, arch, values);
        run.all()?;
        let suspect = run.suspect();
        let diagonal: Vec<f64> = match suspect {
            Some(_) => (0..symbolic.equations()).map(|k| run.diagonal(k)).collect(),
            None => Vec::new(),
        };
        let values = run.values.into_iter().map(|v| v.into_inner().unwrap_or_default()).collect();
        let factor = Self { symbolic, values, arch };
        if let Some((ratio, position)) = suspect {
            factor.examine(ratio, position, &diagonal)?;
        }
        Ok(factor)
    }

    /// Lower triangle of the Schur complement of the retained equations, without the factor: the values of a front are dropped
    /// once it has been eliminated.
    ///
    /// # Errors
    /// As [`Cholesky::new`].
    pub fn schur(symbolic: &Arc<SymbolicCholesky>, matrix: &[f64]) -> Result<Triangle, DirectError> {
        let values = vec![Vec::new(); symbolic.tasks.len()];
        let run = Run { keep: false, ..Run::new(symbolic, matrix, Arch::new(), values) };
        run.all()?;
        if run.suspect().is_some() {
            // Only the factor shows if a mode is soft or free.
            return Ok(Self::new(Arc::clone(symbolic), matrix)?.take_triangle());
        }
        let schur = run.values.into_iter().next_back().and_then(|v| v.into_inner().ok());
        Ok(Triangle::new(schur.unwrap_or_default(), symbolic.retained()))
    }

    /// Distinguishes a soft mode from a free one. `v = L⁻ᵀ e_j` has `v'Kv = 1`, so its stiffness relative to the diagonal D is
    /// 1/v'Dv. Rounding errors of the size eps D, independent in each row, make that of a free mode about eps/sqrt(n). Unlike
    /// the pivot, this does not depend on the position at which the mode is large.
    fn examine(&self, ratio: f64, position: usize, diagonal: &[f64]) -> Result<(), DirectError> {
        let n = self.symbolic.equations();
        let equation = self.symbolic.order[position] as usize;
        let mut mode = vec![0.0; n];
        mode[equation] = 1.0;
        self.recover(MatMut::from_column_major_slice_mut(&mut mode, n, 1));
        let scale: f64 = diagonal.iter().zip(self.symbolic.order()).map(|(d, e)| d * mode[e] * mode[e]).sum();
        // In this form NaN does not pass.
        if scale * ROUNDING < (n as f64).sqrt() {
            return Ok(());
        }
        let diagonal = diagonal[position];
        Err(DirectError::Singular(Pivot { equation, pivot: ratio * diagonal, diagonal }))
    }

    /// The underlying analysis.
    #[must_use]
    pub fn symbolic(&self) -> &Arc<SymbolicCholesky> {
        &self.symbolic
    }

    /// The Schur complement of the retained equations, column by column and symmetric. It is moved out of the factor.
    #[must_use]
    pub fn take_schur(&mut self) -> Vec<f64> {
        self.take_triangle().whole()
    }

    /// Its lower triangle, moved out of the factor.
    fn take_triangle(&mut self) -> Triangle {
        let order = self.symbolic.retained();
        if order == 0 {
            return Triangle::new(Vec::new(), 0);
        }
        let schur = self.values.pop().unwrap_or_default();
        self.values.push(Vec::new());
        Triangle::new(schur, order)
    }
}

/// Storage of the columns of a task's fronts during elimination.
enum Panels {
    /// Each front at its own position: they are the factor.
    Kept(Vec<f64>),
    /// All fronts at the same position.
    Passing(Vec<f64>),
}

impl Panels {
    /// Storage for the columns of a front, filled with zeros.
    fn front(&mut self, front: &Front) -> &mut [f64] {
        let size = front.width * front.height;
        match self {
            Self::Kept(values) => &mut values[front.offset..][..size],
            Self::Passing(values) => {
                values[..size].fill(0.0);
                &mut values[..size]
            }
        }
    }
}

impl<'a> Run<'a> {
    fn new(symbolic: &'a SymbolicCholesky, matrix: &'a [f64], arch: Arch, values: Vec<Vec<f64>>) -> Self {
        let eliminated = (symbolic.equations() - symbolic.retained()) as f64;
        Self {
            matrix,
            arch,
            smallest: ROUNDING * eliminated.sqrt(),
            pool: Pool::default(),
            values: values.into_iter().map(Mutex::new).collect(),
            keep: true,
            least: Mutex::new((f64::INFINITY, 0)),
            contributions: slots(symbolic.tasks.len()),
            symbolic,
        }
    }

    /// Eliminates all fronts.
    fn all(&self) -> Result<(), DirectError> {
        tasks::upwards(self.symbolic, &|t| {
            let result = self.task(t);
            *open(&self.contributions[t]) = Some(result);
        });
        for &root in &self.symbolic.roots {
            if let Some(Err(error)) = open(&self.contributions[root]).take() {
                return Err(error);
            }
        }
        Ok(())
    }

    /// The smallest relative pivot and its position, if small enough to be examined.
    fn suspect(&self) -> Option<(f64, usize)> {
        let least = *open(&self.least);
        Some(least).filter(|(ratio, _)| *ratio < SUSPECT)
    }

    /// Eliminates the fronts of a task and returns the contribution of the last of them.
    fn task(&self, t: usize) -> Result<Vec<f64>, DirectError> {
        let task = &self.symbolic.tasks[t];
        let mut panels = if self.keep || self.stops_at(task.fronts.end - 1) {
            let mut values = std::mem::take(&mut *open(&self.values[t]));
            if values.len() == task.values {
                values.fill(0.0);
            } else {
                values = zeros(task.values)?;
            }
            Panels::Kept(values)
        } else {
            Panels::Passing(self.pool.take(task.largest)?)
        };
        let result = if task.subtree { self.subtree(t, &mut panels) } else { self.single(t, &mut panels) };
        match panels {
            Panels::Kept(values) => *open(&self.values[t]) = values,
            Panels::Passing(values) => self.give(values),
        }
        result
    }

    /// True if elimination stops at a front: it is the Schur complement.
    fn stops_at(&self, s: usize) -> bool {
        self.symbolic.retained > 0 && s + 1 == self.symbolic.fronts.len()
    }

    /// Takes back a buffer that is no longer needed. If memory matters more than the time to allocate it, the buffer is
    /// returned to the operating system.
    fn give(&self, buffer: Vec<f64>) {
        if self.keep {
            self.pool.give(buffer);
        }
    }

    /// Eliminates one front near the root, whose children are tasks.
    fn single(&self, t: usize, panels: &mut Panels) -> Result<Vec<f64>, DirectError> {
        let task = &self.symbolic.tasks[t];
        let s = task.fronts.start;
        let mut children = Vec::with_capacity(task.children.len());
        for &child in &task.children {
            let contributions = open(&self.contributions[child]).take();
            children.push(contributions.expect("a task runs after its children")?);
        }
        let front = self.symbolic.fronts[s];
        let mut own = self.pool.take(front.rest().pow(2))?;
        let borrowed: Vec<&[f64]> = children.iter().map(Vec::as_slice).collect();
        self.front(s, panels.front(&front), &borrowed, &mut own)?;
        children.into_iter().for_each(|c| self.give(c));
        Ok(own)
    }

    /// Eliminates a subtree, with its contributions on two stacks.
    fn subtree(&self, t: usize, panels: &mut Panels) -> Result<Vec<f64>, DirectError> {
        let task = &self.symbolic.tasks[t];
        let mut stacks = [self.pool.take(task.stacks[0])?, self.pool.take(task.stacks[1])?];
        let root = task.fronts.end - 1;
        let mut last = self.pool.take(self.symbolic.fronts[root].rest().pow(2))?;
        let mut borrowed: Vec<&[f64]> = Vec::new();
        for s in task.fronts.clone() {
            let front = self.symbolic.fronts[s];
            let (side, at) = front.stack;
            let [even, odd] = &mut stacks;
            let (mine, theirs) = if side == 0 { (even, odd) } else { (odd, even) };
            let own = if s == root { &mut last[..] } else { &mut mine[at..at + front.rest().pow(2)] };
            let mut list = recycle(borrowed);
            list.extend(self.symbolic.children[s].iter().map(|&c| {
                let child = self.symbolic.fronts[c as usize];
                &theirs[child.stack.1..child.stack.1 + child.rest().pow(2)]
            }));
            self.front(s, panels.front(&front), &list, own)?;
            borrowed = recycle(list);
        }
        let [even, odd] = stacks;
        self.give(even);
        self.give(odd);
        Ok(last)
    }

    /// Computes the values of a front in `panel`, initially zero, and writes its contribution to `own`.
    fn front(
        &self,
        s: usize,
        panel: &mut [f64],
        children: &[&[f64]],
        own: &mut [f64],
    ) -> Result<(), DirectError> {
        let symbolic = self.symbolic;
        let front = symbolic.fronts[s];
        for (k, column) in panel.chunks_exact_mut(front.height).enumerate() {
            let col = front.first + k;
            for entry in &symbolic.entries[symbolic.entry_start[col]..symbolic.entry_start[col + 1]] {
                column[entry.row as usize] = self.matrix[entry.source as usize];
            }
        }
        let smallest: Vec<f64> =
            (0..front.width).map(|k| self.smallest * panel[k * front.height + k].max(0.0)).collect();
        let contributions = symbolic.children[s].iter().zip(children);
        let contributions: Vec<ContributionBlock<'_>> = contributions
            .map(|(&child, from)| ContributionBlock::new(symbolic.places(child as usize), from))
            .collect();
        extend(&contributions, panel, front.height, 0);
        if self.stops_at(s) {
            return Ok(());
        }
        dense::eliminate(self.arch, panel, front.height, front.height, &smallest)
            .map_err(|(k, pivot)| self.failure(front.first + k, pivot))?;
        self.note_least(&front, panel, &smallest);
        let rest = front.rest();
        if rest > 0 {
            let own = &mut own[..rest * rest];
            dense::update(self.arch, own, &panel[front.width..], front.height, rest, front.width);
            extend(&contributions, own, rest, front.width);
        }
        Ok(())
    }

    /// Records the smallest relative pivot; the first of equal ones, whichever thread comes first.
    fn note_least(&self, front: &Front, panel: &[f64], smallest: &[f64]) {
        let ratio = |k: usize| panel[k * front.height + k].powi(2) * self.smallest / smallest[k];
        let own = (0..front.width)
            .map(|k| (ratio(k), front.first + k))
            .fold((f64::INFINITY, 0), |m, x| if x.0 < m.0 { x } else { m });
        if own.0 < SUSPECT {
            let mut least = open(&self.least);
            if own < *least {
                *least = own;
            }
        }
    }

    /// The diagonal entry at a position in the order of elimination.
    fn diagonal(&self, position: usize) -> f64 {
        let symbolic = self.symbolic;
        let entries = &symbolic.entries[symbolic.entry_start[position]..symbolic.entry_start[position + 1]];
        let front = symbolic.fronts.partition_point(|f| f.first <= position) - 1;
        let row = (position - symbolic.fronts[front].first) as u32;
        entries.iter().find(|e| e.row == row).map_or(0.0, |e| self.matrix[e.source as usize])
    }

    /// The error for an unusable pivot.
    fn failure(&self, position: usize, pivot: f64) -> DirectError {
        let equation = self.symbolic.order[position] as usize;
        let diagonal = self.diagonal(position);
        let pivot = Pivot { equation, pivot, diagonal };
        if pivot.pivot.abs() <= NOT_NEGATIVE * diagonal.abs() {
            DirectError::Singular(pivot)
        } else {
            DirectError::NotPositive(pivot)
        }
    }
}

/// Clears a list of borrowed slices for the next borrow, keeping its memory.
fn recycle<'b>(mut list: Vec<&[f64]>) -> Vec<&'b [f64]> {
    list.clear();
    list.into_iter().map(|_: &[f64]| -> &'b [f64] { &[] }).collect()
}
