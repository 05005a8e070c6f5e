//! The linear system of a step: tangents of all terms on the free degrees of freedom, dense or sparse, and its solution.

use crate::dof::Equations;
use crate::error::FemError;
use crate::multifrontal;
use crate::sparse::{Factor, Part, ScatterMap};
use crate::term::{Linearized, Pattern};
use faer::linalg::solvers::{Llt, PartialPivLu, SolveCore};
use faer::sparse::linalg::solvers::SymbolicLu;
use faer::{Conj, Mat, MatMut, Side};
use rayon::prelude::*;
use std::sync::Arc;

/// How the system's matrix is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Storage {
    /// Dense with partial pivoting: condensed systems.
    Dense,
    /// Compressed columns with sparse LU: systems of all degrees of freedom.
    Sparse,
}

/// What the caller knows of the tangents of all terms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symmetry {
    /// Nothing: LU.
    General,
    /// Symmetric, and their sum positive definite on the free degrees of freedom: Cholesky, half the entries.
    Positive,
}

/// Values scanned by one task.
const CHUNK: usize = 1 << 16;

/// Matrix, pattern and factorisation of the step's system. The symbolic analysis is kept as long as the patterns of all
/// terms keep their version; a factor never outlives the values it was made from.
#[derive(Debug)]
pub struct System {
    equations: Equations,
    symmetry: Symmetry,
    store: Store,
    /// Versions and sizes of the patterns the present factor was made from; none without a factor.
    factored: Option<Vec<Version>>,
    /// Values of one term, reused.
    buffer: Vec<f64>,
    largest_entry: f64,
    /// Numeric factorisations so far.
    pub factorisations: usize,
    /// Solves so far.
    pub solves: usize,
}

/// Version and size of a pattern.
type Version = (u64, usize);

#[derive(Debug)]
enum Store {
    Dense { matrix: Mat<f64>, factor: Option<DenseFactor> },
    Sparse(Box<SparseStore>),
}

#[derive(Debug)]
enum DenseFactor {
    Cholesky(Llt<f64>),
    Lu(PartialPivLu<f64>),
}

#[derive(Debug)]
enum Symbolic {
    Cholesky(Arc<multifrontal::Symbolic>),
    Lu(SymbolicLu<usize>),
}

#[derive(Debug, Default)]
struct SparseStore {
    versions: Vec<Version>,
    map: Option<ScatterMap>,
    symbolic: Option<Symbolic>,
    factor: Option<Factor>,
}

impl System {
    /// A system on the free degrees of freedom, without knowledge of symmetry.
    #[must_use]
    pub fn new(equations: Equations, storage: Storage) -> Self {
        let n = equations.free.len();
        let store = match storage {
            Storage::Dense => Store::Dense { matrix: Mat::zeros(n, n), factor: None },
            Storage::Sparse => Store::Sparse(Box::default()),
        };
        Self {
            equations,
            symmetry: Symmetry::General,
            store,
            factored: None,
            buffer: Vec::new(),
            largest_entry: 0.0,
            factorisations: 0,
            solves: 0,
        }
    }

    /// The same system with what the caller knows of the tangents. What was factored is forgotten.
    #[must_use]
    pub fn with_symmetry(self, symmetry: Symmetry) -> Self {
        let storage = match self.store {
            Store::Dense { .. } => Storage::Dense,
            Store::Sparse(_) => Storage::Sparse,
        };
        Self { symmetry, ..Self::new(self.equations, storage) }
    }

    /// Whether there is a factor, made from these patterns. A caller whose values depend on nothing that changed (small
    /// strain, linear materials, no contact) need not factor anew then.
    pub fn is_factored<'a>(&self, patterns: impl IntoIterator<Item = &'a Pattern>) -> bool {
        self.factored.as_ref().is_some_and(|f| f.iter().copied().eq(patterns.into_iter().map(version)))
    }

    /// The numbering.
    #[must_use]
    pub fn equations(&self) -> &Equations {
        &self.equations
    }

    /// Largest entry of any term's tangent in the last assembly: the scale of rounding in the forces.
    #[must_use]
    pub fn largest_entry(&self) -> f64 {
        self.largest_entry
    }

    /// Assembles what `values_of` writes for each term (a consistent or a rate tangent) and factors it.
    ///
    /// # Errors
    /// [`FemError::Factorisation`] when the matrix is singular; whatever `values_of` refuses.
    pub fn factor<T, E>(
        &mut self,
        terms: &mut [T],
        pattern_of: impl Fn(&T) -> &Pattern,
        mut values_of: impl FnMut(&mut T, &mut [f64]) -> Result<(), E>,
    ) -> Result<Result<(), FemError>, E> {
        self.factored = None;
        if let Store::Sparse(store) = &mut self.store {
            let patterns: Vec<&Pattern> = terms.iter().map(&pattern_of).collect();
            if let Err(error) = store.renew(&patterns, &self.equations, self.symmetry) {
                return Ok(Err(error));
            }
        }
        self.store.clear();
        self.largest_entry = 0.0;
        let mut offset = 0;
        for term in &mut *terms {
            self.buffer.clear();
            self.buffer.resize(pattern_of(term).values(), 0.0);
            values_of(term, &mut self.buffer)?;
            self.largest_entry = self.largest_entry.max(largest(&self.buffer));
            offset = self.store.add(&self.equations, pattern_of(term), offset, &self.buffer);
        }
        self.factorisations += 1;
        let outcome = self.check_held().and_then(|()| self.store.factor(self.symmetry));
        if outcome.is_ok() {
            self.factored = Some(terms.iter().map(|t| version(pattern_of(t))).collect());
        }
        Ok(outcome)
    }

    /// What nothing holds can be named before the factorisation: a column without entries, and in a positive definite
    /// matrix a diagonal that is not positive.
    fn check_held(&self) -> Result<(), FemError> {
        let (what, unheld) = match self.symmetry {
            Symmetry::General => ("singular", self.store.empty_column()),
            Symmetry::Positive => {
                ("not positive definite", self.store.diagonal().iter().position(|&d| d.is_nan() || d <= 0.0))
            }
        };
        unheld.map_or(Ok(()), |k| {
            let dof = self.equations.free[k];
            Err(FemError::Factorisation(format!(
                "the tangent is {what}: degree of freedom {dof} is not held"
            )))
        })
    }

    /// Assembles and factors the consistent tangents of `terms` at the state of their last residual.
    ///
    /// # Errors
    /// [`FemError::Factorisation`] when the tangent is singular.
    pub fn factor_tangent(&mut self, terms: &mut [&mut dyn Linearized]) -> Result<(), FemError> {
        let outcome: Result<_, std::convert::Infallible> = self.factor(
            terms,
            |t| t.pattern(),
            |t, values| {
                t.tangent(values);
                Ok(())
            },
        );
        match outcome {
            Ok(result) => result,
            Err(never) => match never {},
        }
    }

    /// As [`System::factor_tangent`], but only when there is no factor of these patterns: the caller vouches that the values
    /// are the same. Tells whether it factored.
    ///
    /// # Errors
    /// As [`System::factor_tangent`].
    pub fn factor_tangent_once(&mut self, terms: &mut [&mut dyn Linearized]) -> Result<bool, FemError> {
        if self.is_factored(terms.iter().map(|t| t.pattern())) {
            return Ok(false);
        }
        self.factor_tangent(terms).map(|()| true)
    }

    /// Solves `K x = rhs` in place over the free equations.
    ///
    /// # Errors
    /// [`FemError::Factorisation`] when the solution is not finite: the matrix was numerically singular.
    pub fn solve(&mut self, rhs: &mut [f64]) -> Result<(), FemError> {
        let n = rhs.len();
        let columns = MatMut::from_column_major_slice_mut(rhs, n, 1);
        match &self.store {
            Store::Dense { factor: Some(DenseFactor::Lu(f)), .. } => {
                f.solve_in_place_with_conj(Conj::No, columns)
            }
            Store::Dense { factor: Some(DenseFactor::Cholesky(f)), .. } => {
                f.solve_in_place_with_conj(Conj::No, columns);
            }
            Store::Sparse(store) => match &store.factor {
                Some(f) => f.solve(columns),
                None => return Err(FemError::Factorisation("there is no factor to solve with".into())),
            },
            Store::Dense { factor: None, .. } => {
                return Err(FemError::Factorisation("there is no factor to solve with".into()));
            }
        }
        self.solves += 1;
        match rhs.iter().position(|x| !x.is_finite()) {
            None => Ok(()),
            Some(k) => Err(FemError::Factorisation(format!(
                "the tangent is singular: degree of freedom {} is not held",
                self.equations.free[k]
            ))),
        }
    }
}

impl Store {
    fn clear(&mut self) {
        match self {
            Self::Dense { matrix, factor } => {
                matrix.fill(0.0);
                *factor = None;
            }
            Self::Sparse(store) => {
                store.factor = None;
                if let Some(map) = &mut store.map {
                    map.clear();
                }
            }
        }
    }

    fn add(&mut self, equations: &Equations, pattern: &Pattern, offset: usize, values: &[f64]) -> usize {
        match self {
            Self::Dense { matrix, .. } => {
                add_dense(matrix, equations, pattern, values);
                offset
            }
            Self::Sparse(store) => store.map.as_mut().map_or(offset, |map| map.add(offset, values)),
        }
    }

    /// The first column all of whose entries are zero.
    fn empty_column(&self) -> Option<usize> {
        let empty = |column: &[f64]| column.iter().all(|&v| v == 0.0);
        match self {
            Self::Dense { matrix, .. } => (0..matrix.ncols()).position(|k| empty(matrix.col_as_slice(k))),
            Self::Sparse(store) => store.map.as_ref().and_then(|map| {
                let matrix = map.matrix();
                (0..map.order()).position(|k| empty(matrix.val_of_col(k)))
            }),
        }
    }

    /// The diagonal, by equation.
    fn diagonal(&self) -> Vec<f64> {
        match self {
            Self::Dense { matrix, .. } => (0..matrix.nrows()).map(|k| matrix[(k, k)]).collect(),
            Self::Sparse(store) => store.map.as_ref().map_or_else(Vec::new, |map| {
                let matrix = map.matrix();
                (0..map.order()).map(|k| matrix.get(k, k).copied().unwrap_or(0.0)).collect()
            }),
        }
    }

    fn factor(&mut self, symmetry: Symmetry) -> Result<(), FemError> {
        match self {
            Self::Dense { matrix, factor } => {
                *factor = Some(match symmetry {
                    Symmetry::General => DenseFactor::Lu(matrix.partial_piv_lu()),
                    Symmetry::Positive => DenseFactor::Cholesky(matrix.llt(Side::Lower).map_err(|e| {
                        FemError::Factorisation(format!("the tangent is not positive definite ({e:?})"))
                    })?),
                });
            }
            Self::Sparse(store) => {
                let store = store.as_mut();
                let (Some(map), Some(symbolic)) = (&store.map, &store.symbolic) else {
                    return Err(FemError::Factorisation("the pattern was not analysed".into()));
                };
                store.factor = Some(match symbolic {
                    Symbolic::Cholesky(symbolic) => map.cholesky(symbolic)?,
                    Symbolic::Lu(symbolic) => map.lu(symbolic)?,
                });
            }
        }
        Ok(())
    }
}

impl SparseStore {
    /// Builds pattern and symbolic analysis anew when a term's pattern changed.
    fn renew(
        &mut self,
        patterns: &[&Pattern],
        equations: &Equations,
        symmetry: Symmetry,
    ) -> Result<(), FemError> {
        let versions: Vec<Version> = patterns.iter().map(|p| version(p)).collect();
        if self.symbolic.is_some() && versions == self.versions {
            return Ok(());
        }
        *self = Self::default();
        let part = if symmetry == Symmetry::Positive { Part::Lower } else { Part::Whole };
        let map = ScatterMap::new(patterns, equations, part);
        self.symbolic = Some(match symmetry {
            Symmetry::Positive => Symbolic::Cholesky(map.analyse_cholesky()?),
            Symmetry::General => Symbolic::Lu(map.analyse_lu()?),
        });
        self.map = Some(map);
        self.versions = versions;
        Ok(())
    }
}

fn version(pattern: &Pattern) -> Version {
    (pattern.version, pattern.dofs.len())
}

/// Largest magnitude. The order of the pieces does not matter to a maximum.
fn largest(values: &[f64]) -> f64 {
    values
        .par_chunks(CHUNK)
        .map(|part| part.iter().fold(0.0_f64, |m, v| m.max(v.abs())))
        .reduce(|| 0.0, f64::max)
}

/// Adds blocks to a dense matrix on the free equations.
fn add_dense(matrix: &mut Mat<f64>, equations: &Equations, pattern: &Pattern, values: &[f64]) {
    let mut offset = 0;
    for block in pattern.blocks() {
        let n = block.len();
        for (j, &c) in block.iter().enumerate() {
            let col = equations.number[c];
            if col == Equations::FIXED {
                continue;
            }
            let column = matrix.col_as_slice_mut(col);
            for (i, &r) in block.iter().enumerate() {
                let row = equations.number[r];
                if row != Equations::FIXED {
                    column[row] += values[offset + i * n + j];
                }
            }
        }
        offset += n * n;
    }
}
