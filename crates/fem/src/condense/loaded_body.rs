//! Condensation of a body together with its loads, for bodies whose interior is never recovered.
//!
//! Every load f_c is a further row beside the stiffness, `[K -F; -Fᵀ 0]`, and these rows are retained like the displacements u_i.
//! Elimination of the interior then leaves `[S H; Hᵀ ·]`, with the condensed forces `H = K_ib K_bb⁻¹ F_b - F_i` beside S. No solve
//! needs the factor, so that no front is kept once its parent has taken its contribution.

use super::{Stiffness, coupling, load, not_retained, number_in};
use crate::dof::{Channel, Constraints, Equations};
use crate::error::FemError;
use crate::multifrontal::{Cholesky, DirectError, SymbolicCholesky, Triangle};
use crate::ordering::Ordering;
use crate::sparse::lower_matrix;
use crate::table::Table;
use std::sync::Arc;

/// A body with its loads, analysed for condensation: its costs are known, but no numbers have been computed.
#[derive(Debug)]
pub struct LoadedBody {
    symbolic: Arc<SymbolicCholesky>,
    /// Values of the lower triangle.
    values: Vec<f64>,
    /// Degree of freedom of each equation; loads come after them.
    free: Vec<usize>,
    retained: usize,
    amplitudes: Vec<Table>,
}

impl LoadedBody {
    /// Orders and analyses `body` for condensation onto `retained` (sorted), with the loads of `channels`. `fixed` (sorted) are its prescribed
    /// degrees of freedom; those that are also retained are kept. The memory of `body` is freed before the analysis starts.
    ///
    /// # Errors
    /// [`FemError::Direct`] if the pattern cannot be ordered.
    pub fn analyse(
        body: Stiffness,
        retained: &[usize],
        fixed: &[usize],
        channels: Vec<Channel>,
    ) -> Result<Self, FemError> {
        let fixed = &not_retained(fixed, retained);
        let active = Constraints { fixed: fixed.clone(), channels: Vec::new() }.equations(body.dofs);
        let columns = coupling(&body, &active.number, &number_in(fixed, body.dofs));
        let loads: Vec<Vec<f64>> = channels.iter().map(|c| load(c, &active, fixed, &columns)).collect();
        let Equations { number, free, .. } = active;
        let mut last: Vec<usize> = retained.iter().map(|&d| number[d]).collect();
        last.extend(free.len()..free.len() + loads.len());
        let (lower, values) = lower_matrix(&body.pattern, &body.values, &number, free.len(), &loads);
        drop((body, number, columns, loads));
        let symbolic = Arc::new(SymbolicCholesky::retaining(lower.as_ref(), Ordering::Automatic, &last)?);
        let amplitudes = channels.into_iter().map(|c| c.amplitude).collect();
        Ok(Self { symbolic, values, free, retained: retained.len(), amplitudes })
    }

    /// Peak memory of the condensation with `threads` threads \[bytes\].
    #[must_use]
    pub fn bytes(&self, threads: usize) -> usize {
        self.symbolic.bytes_of_schur(threads) + self.own()
    }

    /// Largest memory allocated, some of which is never written \[bytes\].
    #[must_use]
    pub fn asked(&self, threads: usize) -> usize {
        self.symbolic.asked_by_schur(threads) + self.own()
    }

    fn own(&self) -> usize {
        size_of_val(self.values.as_slice()) + size_of_val(self.free.as_slice())
    }

    /// Largest number of the available threads that work within `allowed` bytes: each thread holds fronts.
    ///
    /// # Errors
    /// [`FemError::Direct`] if a single thread needs more.
    pub fn threads(&self, allowed: usize) -> Result<usize, FemError> {
        let fits = |&threads: &usize| self.bytes(threads) <= allowed;
        (1..=rayon::current_num_threads()).rev().find(fits).ok_or_else(|| {
            let equations = self.symbolic.equations();
            DirectError::Memory { needed: self.bytes(1), allowed, equations }.into()
        })
    }

    /// Eliminates the interior, with as many threads as fit in the memory; the result is the same to the last bit.
    ///
    /// # Errors
    /// [`FemError::Direct`] if more than `allowed` bytes are needed. Also with the degree of freedom where the interior is not held by
    /// the retained and fixed ones.
    pub fn eliminate(self, allowed: usize) -> Result<Remainder, FemError> {
        let threads = self.threads(allowed)?;
        let Self { symbolic, values, free, retained, amplitudes } = self;
        let schur = || Cholesky::schur(&symbolic, &values);
        let matrix = if threads == rayon::current_num_threads() { schur() } else { limited(threads, schur)? };
        let matrix = matrix.map_err(|e| e.renumbered(|k| free[k]))?;
        Ok(Remainder { matrix, retained, amplitudes })
    }
}

/// Runs `work` in a pool of `threads` threads.
fn limited<R: Send>(threads: usize, work: impl FnOnce() -> R + Send) -> Result<R, FemError> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    Ok(pool.map_err(|e| FemError::Threads(e.to_string()))?.install(work))
}

/// Result of eliminating the interior of a body with its loads: forces on the retained degrees of freedom are `S u + Σ_c α_c(t)
/// h_c`.
#[derive(Debug)]
pub struct Remainder {
    /// `[S H; Hᵀ ·]`, symmetric.
    matrix: Triangle,
    retained: usize,
    amplitudes: Vec<Table>,
}

impl Remainder {
    /// Entry of S.
    #[must_use]
    #[inline]
    pub fn at(&self, row: usize, column: usize) -> f64 {
        self.matrix.at(row, column)
    }

    /// Number of rows of S.
    #[must_use]
    pub fn order(&self) -> usize {
        self.retained
    }

    /// Amplitude and h_c of each channel.
    pub fn channels(&self) -> impl Iterator<Item = (&Table, Vec<f64>)> {
        let forces = |c: usize| (0..self.retained).map(|k| self.matrix.at(self.retained + c, k)).collect();
        self.amplitudes.iter().enumerate().map(move |(c, amplitude)| (amplitude, forces(c)))
    }
}
