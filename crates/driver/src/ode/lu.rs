//! Factorisation of small dense matrices with partial pivoting, without allocation.

use nalgebra::Complex;
use std::ops::{Div, Mul, Sub};

/// A real or complex number.
pub(super) trait Number: Copy + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> {
    /// A size for the choice of the pivot.
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

/// A matrix of `n` rows, column by column, and its factors once factorised.
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
