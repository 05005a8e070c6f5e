//! The linear system of a step: tangents of all terms on the free degrees of freedom and its solution: dense, sparse by a
//! factorisation, or by iterations (conjugate gradients, or GMRES where it is unsymmetric).

mod aggregated;
mod dense;
mod dense_factor;
mod direct;
mod flexibility;
mod free_modes;
mod iterative;
mod memory;
mod preconditioned;
mod renewal;
mod schur_complement;
mod solution;
mod symmetric;
mod symmetry;

use crate::dof::Equations;
use crate::error::FemError;
use crate::multifrontal::{DirectError, Pivot};
use crate::term::{ForwardTerm, Linearized, Pattern, PatternId};
use aggregated::{AggregatedSystem, Tangent};
use dense::DenseStore;
use direct::SparseStore;
pub use direct::{Analysis, LowerTriangle};
pub use flexibility::FACTORED as FACTORED_COMPONENTS;
use flexibility::{FlexibilityStore, Part};
use iterative::IterativeStore;
pub use iterative::{Iterative, NearNull};
pub use memory::Memory;
use preconditioned::PreconditionedStore;
use rayon::prelude::*;
use solution::Solution;
use std::convert::Infallible;
pub use symmetry::Symmetry;

/// Storage of the system's matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Storage {
    /// Dense: condensed systems.
    Dense,
    /// Compliance of pairs: large condensed systems of constant terms and fixed pairs.
    Flexibility,
    /// Compressed columns: systems of all degrees of freedom.
    Sparse,
    /// The same, for systems so large that LU is avoided: unsymmetric ones are solved by GMRES, preconditioned by a Cholesky factor.
    Preconditioned,
}

/// Least number of products for which rounding of a force is stated: those of four quadrilaterals at a node.
const FEWEST_PRODUCTS: usize = 32;
/// Values scanned by one task.
const CHUNK: usize = 1 << 16;

/// Matrix, pattern and factorisation of the step's system. The symbolic analysis is kept as long as the patterns of all
/// terms keep their patterns; a factor never outlives the values it was made from. A system of terms whose tangents are
/// constant ([`Linearized::constant_tangent`]) is factored once.
#[derive(Debug)]
pub struct System {
    equations: Equations,
    symmetry: Symmetry,
    store: Store,
    /// Store that takes the place of levels for the rest of a step in which they do not serve.
    spare: Option<Store>,
    /// True if it does.
    replaced: bool,
    /// Identities of the patterns the present factor was made from; none without a factor.
    factored: Option<Vec<PatternId>>,
    /// Values of one term, reused.
    buffer: Vec<f64>,
    largest_entry: f64,
    /// Largest number of products of which a force of any term is the sum.
    products: usize,
    /// Numeric factorisations so far; for the iterative method, preconditioners set up.
    pub factorisations: usize,
    /// Those of them that were LU of a symmetric matrix which is not positive definite.
    pub indefinite: usize,
    /// Solves so far.
    pub solves: usize,
    /// Iterations of conjugate gradients and of GMRES so far.
    pub iterations: usize,
}

#[derive(Debug)]
enum Store {
    Dense(Box<DenseStore>),
    Flexibility(Box<FlexibilityStore>),
    Sparse(Box<SparseStore>),
    Preconditioned(Box<PreconditionedStore>),
    Iterative(Box<IterativeStore>),
    Aggregated(Box<dyn AggregatedSystem>),
}

impl System {
    /// A system on the free degrees of freedom, without knowledge of symmetry.
    #[must_use]
    pub fn new(equations: Equations, storage: Storage) -> Self {
        let store = match storage {
            Storage::Dense => Store::Dense(Box::new(DenseStore::new(equations.free.len()))),
            Storage::Flexibility => Store::Flexibility(Box::default()),
            Storage::Sparse => Store::Sparse(Box::default()),
            Storage::Preconditioned => {
                Store::Preconditioned(Box::new(PreconditionedStore::new(usize::MAX, None)))
            }
        };
        Self::with_store(equations, Symmetry::General, store)
    }

    /// A system solved by conjugate gradients; the tangents of all terms are symmetric, their sum positive definite.
    #[must_use]
    pub fn iterative(equations: Equations, iterative: Iterative) -> Self {
        Self::with_store(
            equations,
            Symmetry::Positive,
            Store::Iterative(Box::new(IterativeStore::new(iterative))),
        )
    }

    /// A system solved by GMRES with smoothed aggregation of a symmetric positive definite matrix near its own.
    #[must_use]
    pub fn aggregated(equations: Equations, iterative: Iterative) -> Self {
        let store = Store::Aggregated(aggregated::system(iterative));
        Self::with_store(equations, Symmetry::General, store)
    }

    /// Solves with a Cholesky factor, of this memory at most \[bytes\], for the rest of a step in which levels do not serve. An analysis made
    /// beforehand is used where it fits.
    #[must_use]
    pub fn with_factors(mut self, memory: usize, analysis: Option<Analysis>) -> Self {
        self.spare = Some(Store::Preconditioned(Box::new(PreconditionedStore::new(memory, analysis))));
        self
    }

    fn with_store(equations: Equations, symmetry: Symmetry, store: Store) -> Self {
        Self {
            equations,
            symmetry,
            store,
            spare: None,
            replaced: false,
            factored: None,
            buffer: Vec::new(),
            largest_entry: 0.0,
            products: 0,
            factorisations: 0,
            indefinite: 0,
            solves: 0,
            iterations: 0,
        }
    }

    /// The same system with what the caller knows of the tangents.
    #[must_use]
    pub fn with_symmetry(mut self, symmetry: Symmetry) -> Self {
        self.set_symmetry(symmetry);
        self
    }

    /// Sets what the caller knows of the tangents. Where that changes, what was factored is forgotten. The iterative method
    /// needs [`Symmetry::Positive`] and keeps it.
    pub fn set_symmetry(&mut self, symmetry: Symmetry) {
        if symmetry == self.symmetry || matches!(self.store, Store::Iterative(_)) {
            return;
        }
        self.symmetry = symmetry;
        self.factored = None;
        match &mut self.store {
            Store::Sparse(store) => store.forget(),
            Store::Preconditioned(store) => store.forget(),
            Store::Dense(_) | Store::Flexibility(_) | Store::Iterative(_) | Store::Aggregated(_) => {}
        }
    }

    /// Begins a step, whose solution depends on none before it.
    pub fn begin_step(&mut self) {
        if self.replaced {
            self.exchange();
        }
        match &mut self.store {
            Store::Preconditioned(store) => store.begin_step(),
            Store::Flexibility(store) => store.begin_step(),
            Store::Aggregated(store) => store.begin_step(),
            Store::Dense(_) | Store::Sparse(_) | Store::Iterative(_) => {}
        }
    }

    /// Exchanges the store and the spare one.
    fn exchange(&mut self) {
        if let Some(spare) = &mut self.spare {
            std::mem::swap(&mut self.store, spare);
            self.replaced = !self.replaced;
            self.factored = None;
            match spare {
                Store::Preconditioned(store) => store.forget(),
                Store::Aggregated(store) => store.forget(),
                _ => {}
            }
        }
    }

    /// Bounds the memory of sparse Cholesky factorisations \[bytes\]; those that need more are refused before they begin. An
    /// analysis made beforehand is used where it fits.
    #[must_use]
    pub fn prepared(mut self, memory: usize, analysis: Option<Analysis>) -> Self {
        match &mut self.store {
            Store::Sparse(store) => store.prepare(memory, analysis),
            Store::Preconditioned(store) => **store = PreconditionedStore::new(memory, analysis),
            Store::Dense(_) | Store::Flexibility(_) | Store::Iterative(_) | Store::Aggregated(_) => {}
        }
        self
    }

    /// True if there is a factor, made from these patterns.
    pub fn is_factored<'a>(&self, patterns: impl IntoIterator<Item = &'a Pattern>) -> bool {
        self.factored.as_ref().is_some_and(|f| f.iter().copied().eq(patterns.into_iter().map(Pattern::id)))
    }

    /// The numbering.
    #[must_use]
    pub fn equations(&self) -> &Equations {
        &self.equations
    }

    /// Largest entry of any term's tangent in the last assembly.
    #[must_use]
    pub fn largest_entry(&self) -> f64 {
        self.largest_entry
    }

    /// Rounding of the forces over the largest displacement: n products of the largest entry are added up with an error of at
    /// most n u of each, u being half the spacing at one (Higham 2002, section 3.1).
    #[must_use]
    pub fn rounding(&self) -> f64 {
        self.products.max(FEWEST_PRODUCTS) as f64 * (0.5 * f64::EPSILON) * self.largest_entry
    }

    /// Relative residual a solution may have: 0 for direct methods, whose residual is rounding.
    #[must_use]
    pub fn tolerance(&self) -> f64 {
        match &self.store {
            Store::Iterative(store) => store.tolerance(),
            _ => 0.0,
        }
    }

    /// Assembles and factors the consistent tangents of `terms` at the state of their last residual. Returns false when all of
    /// them are constant and there is a factor already.
    ///
    /// # Errors
    /// [`FemError::Unheld`] when the matrix is singular, or not positive definite where it must be.
    pub fn factor_tangent(&mut self, terms: &mut [&mut dyn Linearized]) -> Result<bool, FemError> {
        let outcome: Result<_, Infallible> = self.assemble(
            terms,
            false,
            |t, values| {
                t.tangent(values);
                Ok(())
            },
            |t, values| t.symmetric_tangent(values),
        );
        match outcome {
            Ok(result) => result,
            Err(never) => match never {},
        }
    }

    /// Assembles and factors the rate tangents that `values_of` writes. It is asked for those of all terms; false is returned
    /// when all of them are constant and there is a factor already.
    ///
    /// # Errors
    /// As [`System::factor_tangent`]; whatever `values_of` refuses.
    pub fn factor_rate<E>(
        &mut self,
        terms: &mut [&mut dyn ForwardTerm],
        mut values_of: impl FnMut(&mut dyn ForwardTerm, &mut [f64]) -> Result<(), E>,
    ) -> Result<Result<bool, FemError>, E> {
        self.assemble(terms, true, |t, values| values_of(t, values), |_, _| {})
    }

    /// Assembles and factors, unless the values of all terms are constant and factored. With `always`, `values_of` is called
    /// for constant terms as well. `near_of` replaces the values of a term by those from which a system is preconditioned; their
    /// symmetric part is taken.
    fn assemble<T: Linearized + ?Sized, E>(
        &mut self,
        terms: &mut [&mut T],
        always: bool,
        mut values_of: impl FnMut(&mut T, &mut [f64]) -> Result<(), E>,
        near_of: impl Fn(&mut T, &mut [f64]),
    ) -> Result<Result<bool, FemError>, E> {
        let keep = terms.iter().all(|t| t.constant_tangent().is_some())
            && self.is_factored(terms.iter().map(|t| t.pattern()));
        if !keep && let Err(error) = self.begin(terms, always) {
            return Ok(Err(error));
        }
        let mut own: Vec<Option<Vec<f64>>> = Vec::new();
        let mut offset = 0;
        for (number, term) in terms.iter_mut().enumerate() {
            if always || term.constant_tangent().is_none() {
                self.buffer.clear();
                self.buffer.resize(term.pattern().values(), 0.0);
                values_of(term, &mut self.buffer)?;
            }
            if keep {
                continue;
            }
            let constant = term.constant_tangent();
            let tangent = constant.unwrap_or(&self.buffer);
            self.largest_entry = self.largest_entry.max(largest(tangent));
            self.products = self.products.max(term.pattern().most_products());
            match &mut self.store {
                Store::Dense(store) => {
                    store.add(&self.equations, term.pattern(), tangent, constant.is_some());
                }
                Store::Flexibility(store) => {
                    store.add(&self.equations, term.pattern(), tangent, term.relative());
                }
                Store::Sparse(store) => offset = store.add(offset, tangent),
                Store::Preconditioned(store) => {
                    let first = offset;
                    offset = store.add(first, tangent);
                    if let Some(constant) = constant.filter(|_| store.is_due()) {
                        store.add_near(first, constant);
                    } else if store.is_due() {
                        store.add_near(first, symmetric(&mut **term, &mut self.buffer, &near_of));
                    }
                }
                Store::Aggregated(store) => {
                    let constant = constant.is_some();
                    let own = Tangent { pattern: term.pattern(), values: tangent, constant };
                    if let Err(error) = store.set(number, own, &self.equations) {
                        return Ok(Err(error));
                    }
                    if store.is_due() && !constant {
                        store.set_near(number, symmetric(&mut **term, &mut self.buffer, &near_of));
                    }
                }
                Store::Iterative(_) => {
                    own.push(constant.is_none().then(|| std::mem::take(&mut self.buffer)));
                }
            }
        }
        if keep {
            return Ok(Ok(false));
        }
        let outcome = match &mut self.store {
            Store::Iterative(store) => {
                let patterns: Vec<&Pattern> = terms.iter().map(|t| t.pattern()).collect();
                let tangents = terms.iter().zip(&own).map(|(t, own)| match own {
                    Some(own) => own.as_slice(),
                    None => t.constant_tangent().unwrap_or_default(),
                });
                store.set(&patterns, &tangents.collect::<Vec<_>>(), &self.equations).map(|()| 1)
            }
            _ => self.finish(),
        };
        let outcome = outcome.map_err(|e| self.in_degrees_of_freedom(e));
        if let Ok(made) = outcome {
            self.factorisations += made;
            self.factored = Some(terms.iter().map(|t| t.pattern().id()).collect());
        }
        Ok(outcome.map(|_| true))
    }

    /// Prepares an assembly of these terms; `exact` if nothing corrects what a solution leaves.
    fn begin<T: Linearized + ?Sized>(&mut self, terms: &[&mut T], exact: bool) -> Result<(), FemError> {
        self.factored = None;
        self.largest_entry = 0.0;
        self.products = 0;
        let patterns: Vec<&Pattern> = terms.iter().map(|t| t.pattern()).collect();
        match &mut self.store {
            Store::Dense(store) => {
                let constant = terms.iter().map(|t| t.constant_tangent().map(|_| t.pattern().id()));
                store.begin(constant.collect());
            }
            Store::Flexibility(store) => {
                let part = |t: &&mut T| match (t.constant_tangent(), t.relative()) {
                    (Some(_), _) => Part::Constant(t.pattern().id()),
                    (None, Some(_)) => Part::Pairs(t.pattern().id()),
                    (None, None) => Part::Changing,
                };
                store.begin(&patterns, terms.iter().map(part).collect(), &self.equations, exact);
            }
            Store::Sparse(store) => {
                store.renew(&patterns, &self.equations, self.symmetry)?;
                store.clear();
            }
            Store::Preconditioned(store) => store.begin(&patterns, &self.equations, self.symmetry)?,
            Store::Iterative(_) | Store::Aggregated(_) => {}
        }
        Ok(())
    }

    /// Factors what was assembled. Returns the number of factorisations.
    fn finish(&mut self) -> Result<usize, FemError> {
        self.check_held()?;
        let (made, indefinite) = match &mut self.store {
            Store::Dense(store) => (1, store.factor(self.symmetry)?),
            Store::Flexibility(store) => (store.factor()?, false),
            Store::Sparse(store) => (1, store.factor(self.symmetry)?),
            Store::Preconditioned(store) => store.factor()?,
            Store::Aggregated(store) => (store.finish(&self.equations)?, false),
            Store::Iterative(_) => (0, false),
        };
        self.indefinite += usize::from(indefinite);
        Ok(made)
    }

    /// Degrees of freedom that nothing holds can be named before the factorisation: a column without entries, and in a symmetric matrix a
    /// diagonal that is zero or, where it must be positive, negative.
    fn check_held(&self) -> Result<(), FemError> {
        let (diagonal, unheld) = match &self.store {
            Store::Dense(store) => (store.diagonal(), store.empty_column()),
            Store::Sparse(store) => (store.diagonal(), store.empty_column()),
            Store::Preconditioned(store) => (store.matrix().diagonal(), store.matrix().empty_column()),
            // Pairs may hold what is not held otherwise: the solution tells.
            Store::Flexibility(_) | Store::Iterative(_) | Store::Aggregated(_) => return Ok(()),
        };
        let unheld = match self.symmetry {
            Symmetry::General => unheld,
            Symmetry::Symmetric => diagonal.iter().position(|&d| d.is_nan() || d == 0.0),
            Symmetry::Positive => diagonal.iter().position(|&d| d.is_nan() || d <= 0.0),
        };
        let pivot = |k: usize| Pivot { equation: k, pivot: diagonal[k], diagonal: diagonal[k] };
        match unheld.map(pivot) {
            None => Ok(()),
            Some(pivot) if pivot.pivot == 0.0 => Err(DirectError::Singular(pivot).into()),
            Some(pivot) => Err(DirectError::NotPositive(pivot).into()),
        }
    }

    /// An error with the degree of freedom instead of the equation.
    fn in_degrees_of_freedom(&self, error: FemError) -> FemError {
        match error {
            FemError::Direct(direct) => match direct.pivot() {
                Some(pivot) => FemError::Unheld {
                    singular: matches!(direct, DirectError::Singular(_)),
                    pivot: Pivot { equation: self.equations.free[pivot.equation], ..pivot },
                },
                None => FemError::Direct(direct),
            },
            other => other,
        }
    }

    /// Solves `K x = rhs` in place over the free equations with the tangents of `terms`. Returns the number of assemblies.
    ///
    /// # Errors
    /// As [`System::factor_tangent`] and [`System::solve`].
    pub fn solve_tangent(
        &mut self,
        terms: &mut [&mut dyn Linearized],
        rhs: &mut [f64],
    ) -> Result<usize, FemError> {
        let load = self.spare.is_some().then(|| rhs.to_vec());
        match (self.try_tangent(terms, rhs), load) {
            (Err(_), Some(load)) if !self.replaced => {
                rhs.copy_from_slice(&load);
                self.exchange();
                self.try_tangent(terms, rhs)
            }
            (solved, _) => solved,
        }
    }

    /// Solves with the present store.
    fn try_tangent(&mut self, terms: &mut [&mut dyn Linearized], rhs: &mut [f64]) -> Result<usize, FemError> {
        let mut assemblies = usize::from(self.factor_tangent(terms)?);
        if !self.attempt(rhs, true)? {
            assemblies += usize::from(self.factor_tangent(terms)?);
            self.attempt(rhs, false)?;
        }
        Ok(assemblies)
    }

    /// Solves `K x = rhs` in place over the free equations.
    ///
    /// # Errors
    /// [`FemError::Unheld`] when the matrix was numerically singular, which LU does not notice before.
    /// [`FemError::NotConverged`] of the iterative method.
    pub fn solve(&mut self, rhs: &mut [f64]) -> Result<(), FemError> {
        self.attempt(rhs, false).map(|_| ())
    }

    /// Solves in place. With `again` it may return false instead, where another assembly costs less.
    fn attempt(&mut self, rhs: &mut [f64], again: bool) -> Result<bool, FemError> {
        let size = |v: &[f64]| v.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let load = size(rhs);
        let direct = |solved: bool| solved.then_some(Solution::Direct);
        let solution = match &mut self.store {
            Store::Dense(store) => direct(store.solve(rhs)),
            Store::Sparse(store) => direct(store.solve(rhs)),
            Store::Flexibility(store) => store.solve(rhs).map(|(outcome, made)| {
                self.factorisations += made;
                outcome.map_or(Solution::Direct, |outcome| Solution::Iterated { outcome, made: 0 })
            }),
            Store::Preconditioned(store) => store.solve(rhs, again)?,
            Store::Aggregated(store) => store.solve(rhs, again)?,
            Store::Iterative(store) => match store.solve(rhs) {
                Some(outcome) if !outcome.converged() => {
                    self.iterations += outcome.report().iterations;
                    return Err(FemError::NotConverged(outcome));
                }
                solved => solved.map(|outcome| Solution::Iterated { outcome, made: 0 }),
            },
        };
        match solution {
            None => return Err(FemError::Factorisation("there is no factor to solve with".into())),
            Some(Solution::Direct) => {}
            Some(Solution::Iterated { outcome, made }) => {
                self.iterations += outcome.report().iterations;
                self.factorisations += made;
            }
            Some(Solution::Distant { outcome }) => {
                self.iterations += outcome.report().iterations;
                return Ok(false);
            }
        }
        self.solves += 1;
        let pivot = match rhs.iter().position(|x| !x.is_finite()) {
            // Tractions that are not finite spread over all that they act on.
            Some(k) => {
                let pairs = matches!(self.store, Store::Flexibility(_));
                let found = if pairs { self.lower().and_then(|lower| lower.singular()) } else { None };
                found.unwrap_or(Pivot { equation: k, pivot: 0.0, diagonal: 0.0 })
            }
            None => match self.suspect(size(rhs), load) {
                Some(pivot) => pivot,
                None => return Ok(true),
            },
        };
        Err(self.in_degrees_of_freedom(DirectError::Singular(pivot).into()))
    }
}

/// Largest magnitude. The order of the pieces does not matter to a maximum.
fn largest(values: &[f64]) -> f64 {
    values
        .par_chunks(CHUNK)
        .map(|part| part.iter().fold(0.0_f64, |m, v| m.max(v.abs())))
        .reduce(|| 0.0, f64::max)
}

/// The symmetric part of the values of a term, in the buffer that holds its tangent, after `near_of` has replaced them.
fn symmetric<'a, T: Linearized + ?Sized>(
    term: &mut T,
    buffer: &'a mut [f64],
    near_of: impl Fn(&mut T, &mut [f64]),
) -> &'a [f64] {
    near_of(term, buffer);
    symmetrise(term.pattern(), buffer);
    buffer
}

/// Replaces each block of a pattern by its symmetric part.
fn symmetrise(pattern: &Pattern, values: &mut [f64]) {
    let mut rest = values;
    for block in pattern.blocks() {
        let n = block.len();
        let (own, after) = std::mem::take(&mut rest).split_at_mut(n * n);
        for i in 0..n {
            for j in 0..i {
                let mean = 0.5 * (own[i * n + j] + own[j * n + i]);
                (own[i * n + j], own[j * n + i]) = (mean, mean);
            }
        }
        rest = after;
    }
}
