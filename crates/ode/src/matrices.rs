//! The Jacobian of an implicit method with the factors of its two matrices: dense for few unknowns, sparse for many unknowns with
//! known places of the nonzero entries.

use super::lu::Lu;
use super::problem::System;
use faer::linalg::solvers::SolveCore;
use faer::sparse::linalg::solvers::{Lu as SparseLu, SymbolicLu};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use faer::{Conj, MatMut};
use nalgebra::{Complex, DMatrix};

/// Number of unknowns below which dense factors are cheaper than the index lists of sparse ones.
const FEW: usize = 24;

/// Matrices `shift/h - J` with a real and a complex shift.
#[derive(Debug)]
pub(super) enum Matrices {
    /// No Jacobian was requested yet, for this many unknowns.
    Unknown(usize),
    /// All entries, column by column.
    Dense { jacobian: Vec<f64>, real: Lu<f64>, complex: Lu<Complex<f64>> },
    /// The entries at the places named by the problem.
    Sparse(Box<SparseMatrices>),
}

impl Matrices {
    /// Evaluates the Jacobian at local time `t`.
    pub fn evaluate(&mut self, system: &System<'_>, t: f64, y: &[f64]) {
        if let Self::Unknown(n) = *self {
            let places = if n < FEW { None } else { system.problem.places() };
            *self = match places.and_then(|places| SparseMatrices::new(n, &places)) {
                Some(sparse) => Self::Sparse(Box::new(sparse)),
                None => Self::Dense {
                    jacobian: vec![0.0; n * n],
                    real: Lu::new(n, 0.0),
                    complex: Lu::new(n, Complex::new(0.0, 0.0)),
                },
            };
        }
        match self {
            Self::Unknown(_) => {}
            Self::Dense { jacobian, .. } => system.jacobian(t, y, jacobian),
            Self::Sparse(sparse) => sparse.evaluate(system, t, y),
        }
    }

    /// Factorises both matrices. `false`: one is singular or not finite.
    pub fn factorise(&mut self, shift: f64, pair: Complex<f64>) -> bool {
        match self {
            Self::Unknown(_) => false,
            Self::Dense { jacobian, real, complex } => {
                let n = jacobian.len().isqrt();
                for (i, &entry) in jacobian.iter().enumerate() {
                    let on = i % n == i / n;
                    real.entries[i] = if on { shift } else { 0.0 } - entry;
                    complex.entries[i] =
                        Complex::new(if on { pair.re } else { 0.0 } - entry, if on { pair.im } else { 0.0 });
                }
                real.factorise() && complex.factorise()
            }
            Self::Sparse(sparse) => sparse.factorise(shift, pair),
        }
    }

    /// Solves with the real matrix in place.
    pub fn solve_real(&self, b: &mut [f64]) {
        match self {
            Self::Unknown(_) => b.fill(f64::NAN),
            Self::Dense { real, .. } => real.solve(b),
            Self::Sparse(sparse) => solve(sparse.real.as_ref(), b, f64::NAN),
        }
    }

    /// Solves with the complex matrix in place.
    pub fn solve_complex(&self, b: &mut [Complex<f64>]) {
        let undefined = Complex::new(f64::NAN, 0.0);
        match self {
            Self::Unknown(_) => b.fill(undefined),
            Self::Dense { complex, .. } => complex.solve(b),
            Self::Sparse(sparse) => solve(sparse.complex.as_ref(), b, undefined),
        }
    }

    /// True if [`Matrices::spectral_radius`] is below `limit` \[1/s\]; not computed where bounds of it decide.
    pub fn slower_than(&self, limit: f64) -> bool {
        if let Self::Sparse(sparse) = self {
            let [least, most] = sparse.bounds();
            if least >= limit || most < limit {
                return most < limit;
            }
        }
        self.spectral_radius() < limit
    }

    /// An upper estimate of the largest |λ| of the Jacobian J \[1/s\]: the eighth root of the largest row sum of J^8.
    fn spectral_radius(&self) -> f64 {
        let (entries, n) = match self {
            Self::Unknown(_) => return 0.0,
            Self::Dense { jacobian, .. } => (jacobian, jacobian.len().isqrt()),
            Self::Sparse(sparse) => (&sparse.values, sparse.diagonal.len()),
        };
        let largest = entries.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        if largest == 0.0 {
            return 0.0;
        }
        // Powers of J divided by its largest entry stay within the range of numbers.
        let row_sum = match self {
            Self::Sparse(sparse) => sparse.eighth_power(largest),
            _ => {
                let mut power = DMatrix::from_iterator(n, n, entries.iter().map(|v| v / largest));
                for _ in 0..3 {
                    power = &power * &power;
                }
                power.row_iter().map(|row| row.abs().sum()).fold(0.0, f64::max)
            }
        };
        largest * row_sum.powf(0.125)
    }
}

fn solve<T: faer::traits::ComplexField>(factor: Option<&SparseLu<usize, T>>, b: &mut [T], undefined: T) {
    match factor {
        Some(factor) => {
            let n = b.len();
            factor.solve_in_place_with_conj(Conj::No, MatMut::from_column_major_slice_mut(b, n, 1));
        }
        None => b.iter_mut().for_each(|b| *b = undefined.clone()),
    }
}

/// See [`Matrices::Sparse`].
#[derive(Debug)]
pub(super) struct SparseMatrices {
    pattern: SymbolicSparseColMat<usize>,
    symbolic: SymbolicLu<usize>,
    /// Slots to which the entries given by the problem are added.
    slots: Vec<usize>,
    /// Slots of the diagonal entries.
    diagonal: Vec<usize>,
    given: Vec<f64>,
    values: Vec<f64>,
    real: Option<SparseLu<usize, f64>>,
    complex: Option<SparseLu<usize, Complex<f64>>>,
}

impl SparseMatrices {
    /// `None` if the places are not those of a matrix of this size.
    fn new(n: usize, places: &[(usize, usize)]) -> Option<Self> {
        if places.iter().any(|&(row, column)| row >= n || column >= n) {
            return None;
        }
        let mut sorted: Vec<(usize, usize)> = places.iter().map(|&(row, column)| (column, row)).collect();
        sorted.extend((0..n).map(|i| (i, i)));
        sorted.sort_unstable();
        sorted.dedup();
        let slot = |row: usize, column: usize| sorted.binary_search(&(column, row)).ok();
        let slots = places.iter().map(|&(row, column)| slot(row, column)).collect::<Option<Vec<_>>>()?;
        let diagonal = (0..n).map(|i| slot(i, i)).collect::<Option<Vec<_>>>()?;
        let starts = (0..=n).map(|column| sorted.partition_point(|place| place.0 < column)).collect();
        let rows = sorted.iter().map(|place| place.1).collect();
        let pattern = SymbolicSparseColMat::new_checked(n, n, starts, None, rows);
        let symbolic = SymbolicLu::try_new(pattern.as_ref()).ok()?;
        Some(Self {
            symbolic,
            slots,
            diagonal,
            given: vec![0.0; places.len()],
            values: vec![0.0; sorted.len()],
            pattern,
            real: None,
            complex: None,
        })
    }

    fn evaluate(&mut self, system: &System<'_>, t: f64, y: &[f64]) {
        system.entries(t, y, &mut self.given);
        self.values.fill(0.0);
        for (&slot, value) in self.slots.iter().zip(&self.given) {
            self.values[slot] += value;
        }
    }

    fn factorise(&mut self, shift: f64, pair: Complex<f64>) -> bool {
        (self.real, self.complex) = (None, None);
        if !self.values.iter().all(|v| v.is_finite()) {
            return false;
        }
        let mut real: Vec<f64> = self.values.iter().map(|v| -v).collect();
        let mut complex: Vec<Complex<f64>> = self.values.iter().map(|v| Complex::new(-v, 0.0)).collect();
        for &place in &self.diagonal {
            real[place] += shift;
            complex[place] += pair;
        }
        let pattern = self.pattern.as_ref();
        self.real =
            SparseLu::try_new_with_symbolic(self.symbolic.clone(), SparseColMatRef::new(pattern, &real)).ok();
        self.complex =
            SparseLu::try_new_with_symbolic(self.symbolic.clone(), SparseColMatRef::new(pattern, &complex))
                .ok();
        self.real.is_some() && self.complex.is_some()
    }

    /// Bounds of the estimate of the spectral radius \[1/s\]. Products of J^8 with vectors of ±1 cannot exceed its largest row sum; the
    /// row sums of |J|^8 cannot fall below it. Both take a few products with J; the power itself takes as many as there are unknowns.
    fn bounds(&self) -> [f64; 2] {
        let n = self.diagonal.len();
        let largest = self.values.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        if largest == 0.0 {
            return [0.0; 2];
        }
        let size = |absolute: bool, sign: fn(usize) -> f64| {
            let mut x: Vec<f64> = (0..n).map(sign).collect();
            let mut product = vec![0.0; n];
            for _ in 0..8 {
                self.multiply(&x, largest, absolute, &mut product);
                std::mem::swap(&mut x, &mut product);
            }
            largest * x.iter().fold(0.0, |m: f64, v| m.max(v.abs())).powf(0.125)
        };
        let signs: [fn(usize) -> f64; 3] =
            [|_| 1.0, |i| if i % 2 == 0 { 1.0 } else { -1.0 }, |i| if (i / 2) % 2 == 0 { 1.0 } else { -1.0 }];
        let least = signs.into_iter().map(|sign| size(false, sign)).fold(0.0, f64::max);
        [least, size(true, |_| 1.0)]
    }

    /// Multiplies a vector by the Jacobian, or by that of the absolute values of its entries, divided by `largest`.
    fn multiply(&self, x: &[f64], largest: f64, absolute: bool, product: &mut [f64]) {
        product.fill(0.0);
        let (starts, rows) = (self.pattern.col_ptr(), self.pattern.row_idx());
        for (column, x) in x.iter().enumerate() {
            let own = starts[column]..starts[column + 1];
            for (&row, &value) in rows[own.clone()].iter().zip(&self.values[own]) {
                product[row] += if absolute { value.abs() } else { value } / largest * x;
            }
        }
    }

    /// Largest row sum of the eighth power of the Jacobian divided by `largest`. It is computed column by column, each with only
    /// the rows it has.
    fn eighth_power(&self, largest: f64) -> f64 {
        let n = self.diagonal.len();
        let (starts, rows) = (self.pattern.col_ptr(), self.pattern.row_idx());
        let (mut sums, mut next) = (vec![0.0; n], vec![0.0; n]);
        let mut touched = vec![false; n];
        for unit in 0..n {
            let mut column = vec![(unit, 1.0)];
            for _ in 0..8 {
                let mut support = Vec::new();
                for &(j, x) in &column {
                    let own = starts[j]..starts[j + 1];
                    for (&row, value) in rows[own.clone()].iter().zip(&self.values[own]) {
                        if !touched[row] {
                            touched[row] = true;
                            support.push(row);
                        }
                        next[row] += value / largest * x;
                    }
                }
                column.clear();
                for row in support {
                    column.push((row, next[row]));
                    (next[row], touched[row]) = (0.0, false);
                }
            }
            for (row, x) in column {
                sums[row] += f64::abs(x);
            }
        }
        sums.into_iter().fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A chain of unsymmetric blocks of two.
    fn chain(n: usize) -> (Vec<(usize, usize)>, Vec<f64>) {
        let mut places = Vec::new();
        for i in 0..n {
            for j in i.saturating_sub(1)..=(i + 1).min(n - 1) {
                places.extend([(0, 0), (1, 0), (0, 1), (1, 1)].map(|(r, c)| (2 * i + r, 2 * j + c)));
            }
        }
        // The first entry twice: entries at the same place add up.
        places.push((0, 0));
        let values = (0..places.len()).map(|k| ((7 * k) % 11) as f64 - 5.0).collect();
        (places, values)
    }

    #[test]
    fn sparse_and_dense_factors_solve_the_same() {
        let (places, given) = chain(20);
        let n = 40;
        let mut sparse = SparseMatrices::new(n, &places).unwrap();
        let mut dense = vec![0.0; n * n];
        for ((&(row, column), &slot), value) in places.iter().zip(&sparse.slots).zip(&given) {
            sparse.values[slot] += value;
            dense[column * n + row] += value;
        }
        let mut both = [
            Matrices::Sparse(Box::new(sparse)),
            Matrices::Dense {
                jacobian: dense,
                real: Lu::new(n, 0.0),
                complex: Lu::new(n, Complex::new(0.0, 0.0)),
            },
        ];
        let radii = both.each_ref().map(Matrices::spectral_radius);
        assert!((radii[0] / radii[1] - 1.0).abs() < 1e-12, "{radii:?}");
        let Matrices::Sparse(sparse) = &both[0] else { unreachable!() };
        let [least, most] = sparse.bounds();
        // The tightness of the bounds affects only the time: the signs of this matrix vary.
        assert!(least <= radii[0] && radii[0] <= most, "{least} {radii:?} {most}");
        for share in [0.1, 0.99, 1.01, 10.0] {
            assert!(both.iter().all(|m| m.slower_than(share * radii[0]) == (share > 1.0)), "{share}");
        }
        let solutions = both.each_mut().map(|m| {
            assert!(m.factorise(30.0, Complex::new(20.0, 25.0)));
            let mut real: Vec<f64> = (0..n).map(|i| i as f64).collect();
            let mut complex: Vec<Complex<f64>> = (0..n).map(|i| Complex::new(1.0, i as f64)).collect();
            m.solve_real(&mut real);
            m.solve_complex(&mut complex);
            (real, complex)
        });
        for i in 0..n {
            assert!((solutions[0].0[i] - solutions[1].0[i]).abs() < 1e-12);
            assert!((solutions[0].1[i] - solutions[1].1[i]).norm() < 1e-12);
        }
    }

    #[test]
    fn entries_that_are_not_finite_are_refused() {
        let (places, _) = chain(20);
        let mut sparse = SparseMatrices::new(40, &places).unwrap();
        sparse.values[3] = f64::NAN;
        assert!(!sparse.factorise(1.0, Complex::new(1.0, 1.0)));
        assert!(SparseMatrices::new(39, &places).is_none());
    }
}
