//! A sparse system solved by factorisation.

use super::symmetry::Symmetry;
use crate::dof::Equations;
use crate::error::FemError;
use crate::multifrontal::{self, DirectError};
use crate::ordering::Ordering;
use crate::sparse::{Factor, Mirror, Part, ScatterMap, lower_pattern};
use crate::term::{Pattern, PatternId};
use faer::MatMut;
use faer::sparse::SymbolicSparseColMat;
use faer::sparse::linalg::solvers::SymbolicLu;
use std::sync::Arc;

/// Positions of the entries of the lower triangle of a system's matrix.
#[derive(Clone, Debug)]
pub struct LowerTriangle {
    equations: Equations,
    ids: Vec<PatternId>,
    pattern: SymbolicSparseColMat<usize>,
}

impl LowerTriangle {
    /// The pattern of the free equations of some terms.
    #[must_use]
    pub fn new(patterns: &[&Pattern], equations: &Equations) -> Self {
        Self { ids: ids(patterns), pattern: lower_pattern(patterns, equations), equations: equations.clone() }
    }

    /// Number of entries in the lower triangle.
    #[must_use]
    pub fn stored(&self) -> usize {
        self.pattern.row_idx().len()
    }

    /// Orders and analyses the pattern.
    ///
    /// # Errors
    /// [`FemError::Direct`] if it cannot be ordered.
    pub fn analyse(self) -> Result<Analysis, FemError> {
        let symbolic =
            Arc::new(multifrontal::SymbolicCholesky::new(self.pattern.as_ref(), Ordering::Automatic)?);
        Ok(Analysis { equations: self.equations, ids: self.ids, symbolic })
    }
}

/// A symbolic Cholesky analysis made before values exist. It serves a [`super::System`] of the same equations and terms, except
/// terms without a tangent.
#[derive(Clone, Debug)]
pub struct Analysis {
    equations: Equations,
    ids: Vec<PatternId>,
    symbolic: Arc<multifrontal::SymbolicCholesky>,
}

impl Analysis {
    /// Memory and costs of the factorisation.
    #[must_use]
    pub fn symbolic(&self) -> &multifrontal::SymbolicCholesky {
        &self.symbolic
    }
}

#[derive(Debug)]
enum SymbolicFactors {
    Cholesky(Arc<multifrontal::SymbolicCholesky>),
    Lu(SymbolicLu<usize>),
}

#[derive(Debug)]
pub(super) struct SparseStore {
    ids: Vec<PatternId>,
    pub map: Option<ScatterMap>,
    symbolic: Option<SymbolicFactors>,
    factor: Option<Factor>,
    /// The last Cholesky factor, whose storage is reused by the next.
    stale: Option<multifrontal::Cholesky>,
    /// Both triangles of a symmetric matrix, built when Cholesky first fails.
    mirror: Option<Mirror>,
    /// Memory limit of a Cholesky factorisation \[bytes\].
    memory: usize,
    analysis: Option<Analysis>,
}

impl Default for SparseStore {
    fn default() -> Self {
        Self {
            ids: Vec::new(),
            map: None,
            symbolic: None,
            factor: None,
            stale: None,
            mirror: None,
            memory: usize::MAX,
            analysis: None,
        }
    }
}

impl SparseStore {
    pub fn prepare(&mut self, memory: usize, analysis: Option<Analysis>) {
        self.memory = memory;
        self.analysis = analysis;
    }

    /// Forgets patterns and factors.
    pub fn forget(&mut self) {
        let (memory, analysis) = (self.memory, self.analysis.take());
        *self = Self { memory, analysis, ..Self::default() };
    }

    /// Rebuilds pattern and symbolic analysis if the pattern of a term has changed.
    pub fn renew(
        &mut self,
        patterns: &[&Pattern],
        equations: &Equations,
        symmetry: Symmetry,
    ) -> Result<(), FemError> {
        let exact: Vec<PatternId> = patterns.iter().map(|p| p.id()).collect();
        if self.map.is_some() && exact == self.ids {
            return Ok(());
        }
        self.forget();
        let part = if symmetry == Symmetry::General { Part::Whole } else { Part::Lower };
        let map = ScatterMap::new(patterns, equations, part);
        self.symbolic = match symmetry {
            // Analysed when it is first factored.
            Symmetry::General => None,
            Symmetry::Symmetric | Symmetry::Positive => {
                let fits = |a: &&Analysis| a.equations == *equations && a.ids == ids(patterns);
                let symbolic = match self.analysis.as_ref().filter(fits) {
                    Some(analysis) => analysis.symbolic.clone(),
                    None => map.analyse_cholesky()?,
                };
                symbolic.admit(self.memory)?;
                Some(SymbolicFactors::Cholesky(symbolic))
            }
        };
        self.map = Some(map);
        self.ids = exact;
        Ok(())
    }

    pub fn clear(&mut self) {
        if let Some(Factor::Cholesky(factor)) = self.factor.take() {
            self.stale = Some(factor);
        }
        if let Some(map) = &mut self.map {
            map.clear();
        }
    }

    pub fn add(&mut self, offset: usize, values: &[f64]) -> usize {
        self.map.as_mut().map_or(offset, |map| map.add(offset, values))
    }

    /// The diagonal, by equation.
    pub fn diagonal(&self) -> Vec<f64> {
        self.map.as_ref().map_or_else(Vec::new, |map| {
            let matrix = map.matrix();
            (0..map.order()).map(|k| matrix.get(k, k).copied().unwrap_or(0.0)).collect()
        })
    }

    /// The first column whose stored entries are all zero.
    pub fn empty_column(&self) -> Option<usize> {
        let map = self.map.as_ref()?;
        let matrix = map.matrix();
        (0..map.order()).position(|k| matrix.val_of_col(k).iter().all(|&v| v == 0.0))
    }

    /// Factors the matrix; returns true if LU had to replace Cholesky.
    pub fn factor(&mut self, symmetry: Symmetry) -> Result<bool, FemError> {
        let Some(map) = &self.map else {
            return Err(FemError::Factorisation("there is no matrix to factor".into()));
        };
        let symbolic = match self.symbolic.take() {
            Some(symbolic) => symbolic,
            None => SymbolicFactors::Lu(map.analyse_lu()?),
        };
        let factor = match self.symbolic.insert(symbolic) {
            SymbolicFactors::Lu(symbolic) => map.lu(symbolic)?,
            SymbolicFactors::Cholesky(symbolic) => {
                let factor = match self.stale.take() {
                    Some(stale) => stale.refactor(map.values()),
                    None => multifrontal::Cholesky::new(symbolic.clone(), map.values()),
                };
                match factor {
                    Ok(factor) => Factor::Cholesky(factor),
                    Err(DirectError::NotPositive(_)) if symmetry == Symmetry::Symmetric => {
                        let mirror = match self.mirror.take() {
                            Some(mirror) => mirror,
                            None => Mirror::new(map)?,
                        };
                        self.factor = Some(self.mirror.insert(mirror).lu(map.values())?);
                        return Ok(true);
                    }
                    Err(error) => return Err(error.into()),
                }
            }
        };
        self.factor = Some(factor);
        Ok(false)
    }

    /// Analysis of the Cholesky factor.
    pub fn cholesky(&self) -> Option<&multifrontal::SymbolicCholesky> {
        match &self.symbolic {
            Some(SymbolicFactors::Cholesky(symbolic)) => Some(symbolic),
            _ => None,
        }
    }

    /// Solves in place; false without a factor.
    pub fn solve(&self, rhs: &mut [f64]) -> bool {
        let n = rhs.len();
        let columns = MatMut::from_column_major_slice_mut(rhs, n, 1);
        let Some(factor) = &self.factor else { return false };
        factor.solve(columns);
        true
    }
}

/// Identities of the patterns that have entries.
fn ids(patterns: &[&Pattern]) -> Vec<PatternId> {
    patterns.iter().filter(|p| !p.dofs().is_empty()).map(|p| p.id()).collect()
}
