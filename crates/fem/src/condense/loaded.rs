//! Condensation of a body together with its loads, for bodies whose interior nobody asks for again.
//!
//! With every load f_c as a row of its own beside the stiffness, `[K -F; -Fᵀ 0]`, and these rows retained as the displacements u_i are,
//! elimination of the interior leaves `[S H; Hᵀ ·]`: the condensed forces `H = K_ib K_bb⁻¹ F_b - F_i` stand beside S. No solve needs
//! the factor, so that no front is kept after its parent has taken what it passes on.

use super::{Stiffness, coupling, load, not_retained, number_in};
use crate::dof::{Channel, Constraints, Equations};
use crate::error::FemError;
use crate::multifrontal::{Cholesky, DirectError, Symbolic};
use crate::ordering::Ordering;
use crate::sparse::lower_matrix;
use crate::table::Table;
use std::sync::Arc;

/// A body with its loads, analysed for condensation: what it will cost is known, no number computed.
#[derive(Debug)]
pub struct Loaded {
    symbolic: Arc<Symbolic>,
    /// Values of the lower triangle.
    values: Vec<f64>,
    /// Degree of freedom of each equation; loads come after them.
    free: Vec<usize>,
    retained: usize,
    amplitudes: Vec<Table>,
}

impl Loaded {
    /// Orders and analyses `body` for condensation onto `retained` (sorted), with the loads of `channels`; `fixed` (sorted) are its prescribed
    /// degrees of freedom, of which those that are retained stay as they are. The body's own memory is given back before the analysis begins.
    ///
    /// # Errors
    /// [`FemError::Direct`] when the pattern cannot be ordered.
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
        let Equations { number, free } = active;
        let mut last: Vec<usize> = retained.iter().map(|&d| number[d]).collect();
        last.extend(free.len()..free.len() + loads.len());
        let (lower, values) = lower_matrix(&body.pattern, &body.values, &number, free.len(), &loads);
        drop((body, number, columns, loads));
        let symbolic = Arc::new(Symbolic::retaining(lower.as_ref(), Ordering::Automatic, &last)?);
        let amplitudes = channels.into_iter().map(|c| c.amplitude).collect();
        Ok(Self { symbolic, values, free, retained: retained.len(), amplitudes })
    }

    /// Memory of the condensation at its worst moment by so many threads \[bytes\].
    #[must_use]
    pub fn bytes(&self, threads: usize) -> usize {
        self.symbolic.bytes_of_schur(threads) + self.own()
    }

    /// Memory it asks for at most, of which some is never written \[bytes\].
    #[must_use]
    pub fn asked(&self, threads: usize) -> usize {
        self.symbolic.asked_by_schur(threads) + self.own()
    }

    fn own(&self) -> usize {
        size_of_val(self.values.as_slice()) + size_of_val(self.free.as_slice())
    }

    /// The most threads, of those there are, whose work takes no more than `allowed` bytes: each holds fronts of its own.
    ///
    /// # Errors
    /// [`FemError::Direct`] when one alone needs more.
    pub fn threads(&self, allowed: usize) -> Result<usize, FemError> {
        let fits = |&threads: &usize| self.bytes(threads) <= allowed;
        (1..=rayon::current_num_threads()).rev().find(fits).ok_or_else(|| {
            let equations = self.symbolic.equations();
            DirectError::Memory { needed: self.bytes(1), allowed, equations }.into()
        })
    }

    /// Eliminates the interior, with as many threads as the memory serves; the result is the same bits.
    ///
    /// # Errors
    /// [`FemError::Direct`] when more than `allowed` bytes are needed, or with the degree of freedom where the interior is not held by
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

/// Does work in a pool of so many threads.
fn limited<R: Send>(threads: usize, work: impl FnOnce() -> R + Send) -> Result<R, FemError> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    Ok(pool.map_err(|e| FemError::Threads(e.to_string()))?.install(work))
}

/// Result of the elimination of the interior for a body and its loads: forces on the retained degrees of freedom are
/// `S u + Σ_c α_c(t) h_c`.
#[derive(Debug)]
pub struct Remainder {
    /// `[S H; Hᵀ ·]`, symmetric.
    matrix: Vec<f64>,
    retained: usize,
    amplitudes: Vec<Table>,
}

impl Remainder {
    /// Row k of S.
    #[must_use]
    pub fn row(&self, k: usize) -> &[f64] {
        &self.matrix[k * (self.retained + self.amplitudes.len())..][..self.retained]
    }

    /// Amplitude and h_c of each channel.
    pub fn channels(&self) -> impl Iterator<Item = (&Table, &[f64])> {
        self.amplitudes.iter().enumerate().map(|(c, amplitude)| (amplitude, self.row(self.retained + c)))
    }
}
