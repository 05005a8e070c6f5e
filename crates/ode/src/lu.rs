//! Factorisation of small dense matrices with partial pivoting, without allocation.

use nalgebra::Complex;
use std::ops::{Div, Mul, Sub};

/// A real or complex number.
pub(super) trait Number: Copy + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> {
    /// Magnitude for the choice of the pivot.
    fn size(self) -> f64;
}

impl Number for f64 {
    fn size(self) -> f64 {
        self.abs()
    }
}

impl Number for Complex<f64> {
    fn size(self) -> f64 {
        self.re.abs() + self.im.abs()
    }
}

/// A matrix of `n` rows, stored column by column, and its factors once factorised.
#[derive(Debug)]
pub(super) struct Lu<T> {
    pub entries: Vec<T>,
    pivots: Vec<usize>,
}

impl<T: Number> Lu<T> {
    /// A matrix of `n` rows filled with `zero`.
    pub fn new(n: usize, zero: T) -> Self {
        Self { entries: vec![zero; n * n], pivots: vec![0; n] }
    }

    /// Factorises in place. `false`: the matrix is singular or not finite.
    pub fn factorise(&mut self) -> bool {
        let n = self.pivots.len();
        let a = &mut self.entries;
        for c in 0..n {
            let mut pivot = c;
            for r in c + 1..n {
                if a[c * n + r].size() > a[c * n + pivot].size() {
                    pivot = r;
                }
            }
            let size = a[c * n + pivot].size();
            if size == 0.0 || !size.is_finite() {
                return false;
            }
            self.pivots[c] = pivot;
            if pivot != c {
                for column in a.chunks_exact_mut(n) {
                    column.swap(c, pivot);
                }
            }
            for r in c + 1..n {
                let factor = a[c * n + r] / a[c * n + c];
                a[c * n + r] = factor;
                for later in c + 1..n {
                    a[later * n + r] = a[later * n + r] - factor * a[later * n + c];
                }
            }
        }
        true
    }

    /// Solves for `b` in place.
    pub fn solve(&self, b: &mut [T]) {
        let n = self.pivots.len();
        let a = &self.entries;
        for (c, &pivot) in self.pivots.iter().enumerate() {
            b.swap(c, pivot);
        }
        for c in 0..n {
            for r in c + 1..n {
                b[r] = b[r] - a[c * n + r] * b[c];
            }
        }
        for c in (0..n).rev() {
            b[c] = b[c] / a[c * n + c];
            for r in 0..c {
                b[r] = b[r] - a[c * n + r] * b[c];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Lu;
    use nalgebra::Complex;

    #[test]
    fn a_matrix_that_needs_pivots_is_solved() {
        // Columns (0, 1, 2), (3, 1, 0), (1, 0, 4).
        let columns = [0.0, 1.0, 2.0, 3.0, 1.0, 0.0, 1.0, 0.0, 4.0];
        let mut real = Lu::new(3, 0.0);
        real.entries.copy_from_slice(&columns);
        assert!(real.factorise());
        let mut b = [9.0, 3.0, 14.0];
        real.solve(&mut b);
        for (value, expected) in b.into_iter().zip([1.0, 2.0, 3.0]) {
            assert!((value - expected).abs() < 1e-14, "{value}");
        }
        let turn = Complex::new(0.0, 2.0);
        let mut complex = Lu::new(3, turn);
        for (entry, value) in complex.entries.iter_mut().zip(columns) {
            *entry = turn * value;
        }
        assert!(complex.factorise());
        let mut b = [9.0, 3.0, 14.0].map(|v| turn * v);
        complex.solve(&mut b);
        for (value, expected) in b.into_iter().zip([1.0, 2.0, 3.0]) {
            assert!((value - expected).norm() < 1e-14, "{value}");
        }
    }

    #[test]
    fn singular_and_undefined_matrices_are_refused() {
        let mut lu = Lu::new(2, 1.0);
        assert!(!lu.factorise());
        lu.entries.fill(f64::NAN);
        assert!(!lu.factorise());
    }
}
