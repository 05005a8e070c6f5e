//! The linear system of a step: tangents of all terms on the free degrees of freedom, dense or sparse, and its solution.

use crate::dof::Equations;
use crate::error::FemError;
use crate::sparse::{Factor, Part, ScatterMap};
use crate::term::{Linearized, Pattern};
use faer::linalg::solvers::{PartialPivLu, SolveCore};
use faer::sparse::linalg::solvers::SymbolicLu;
use faer::{Conj, Mat, MatMut};

/// How the system's matrix is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Storage {
    /// Dense with partial pivoting: condensed systems.
    Dense,
    /// Compressed columns with sparse LU: systems of all degrees of freedom.
    Sparse,
}

/// Matrix, pattern and factorisation of the step's system. The symbolic analysis is kept as long as the patterns of all
/// terms keep their version; a factor never outlives the values it was made from.
#[derive(Debug)]
pub struct System {
    equations: Equations,
    store: Store,
    /// Values of one term, reused.
    buffer: Vec<f64>,
    largest_entry: f64,
    /// Numeric factorisations so far.
    pub factorisations: usize,
    /// Solves so far.
    pub solves: usize,
}

#[derive(Debug)]
enum Store {
    Dense { matrix: Mat<f64>, factor: Option<PartialPivLu<f64>> },
    Sparse(Box<SparseStore>),
}

#[derive(Debug, Default)]
struct SparseStore {
    versions: Vec<(u64, usize)>,
    map: Option<ScatterMap>,
    symbolic: Option<SymbolicLu<usize>>,
    factor: Option<Factor>,
}

impl System {
    /// A system on the free degrees of freedom.
    #[must_use]
    pub fn new(equations: Equations, storage: Storage) -> Self {
        let n = equations.free.len();
        let store = match storage {
            Storage::Dense => Store::Dense { matrix: Mat::zeros(n, n), factor: None },
            Storage::Sparse => Store::Sparse(Box::default()),
        };
        Self { equations, store, buffer: Vec::new(), largest_entry: 0.0, factorisations: 0, solves: 0 }
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
        if let Store::Sparse(store) = &mut self.store {
            let patterns: Vec<&Pattern> = terms.iter().map(&pattern_of).collect();
            store.renew(&patterns, &self.equations);
        }
        self.store.clear();
        self.largest_entry = 0.0;
        let mut offset = 0;
        for term in terms {
            self.buffer.clear();
            self.buffer.resize(pattern_of(term).values(), 0.0);
            values_of(term, &mut self.buffer)?;
            self.largest_entry = self.buffer.iter().fold(self.largest_entry, |m, v| m.max(v.abs()));
            offset = self.store.add(&self.equations, pattern_of(term), offset, &self.buffer);
        }
        self.factorisations += 1;
        Ok(self.store.factor())
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

    /// Solves `K x = rhs` in place over the free equations.
    ///
    /// # Errors
    /// [`FemError::Factorisation`] when the solution is not finite: the matrix was numerically singular.
    pub fn solve(&mut self, rhs: &mut [f64]) -> Result<(), FemError> {
        let n = rhs.len();
        let columns = MatMut::from_column_major_slice_mut(rhs, n, 1);
        match &self.store {
            Store::Dense { factor: Some(f), .. } => f.solve_in_place_with_conj(Conj::No, columns),
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

    fn factor(&mut self) -> Result<(), FemError> {
        match self {
            Self::Dense { matrix, factor } => {
                *factor = Some(matrix.partial_piv_lu());
                Ok(())
            }
            Self::Sparse(store) => {
                let store = store.as_mut();
                let (Some(map), Some(symbolic)) = (&store.map, &store.symbolic) else {
                    return Err(FemError::Factorisation("the pattern was not analysed".into()));
                };
                store.factor = Some(map.lu(symbolic)?);
                Ok(())
            }
        }
    }
}

impl SparseStore {
    /// Builds pattern and symbolic analysis anew when a term's pattern changed.
    fn renew(&mut self, patterns: &[&Pattern], equations: &Equations) {
        let versions: Vec<(u64, usize)> = patterns.iter().map(|p| (p.version, p.dofs.len())).collect();
        if self.map.is_none() || versions != self.versions {
            let map = ScatterMap::new(patterns, equations, Part::Whole);
            self.symbolic = map.analyse_lu().ok();
            self.map = Some(map);
            self.versions = versions;
        }
    }
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
