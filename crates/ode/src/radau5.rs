//! Radau IIA of order 5: implicit, L-stable, with three stages solved together by a simplified Newton iteration.
//!
//! Source: E. Hairer, G. Wanner, "Solving Ordinary Differential Equations II", 2nd ed. (1996), section IV.8. The three linear systems
//! are separated into a real and a complex one; the error estimate is of order 3 and filtered by the real matrix.

use super::matrices::Matrices;
use super::one_step::{Formula, Span, Trial};
use super::problem::System;
use super::radau5_table::{COMPLEX_IMAGINARY, COMPLEX_REAL, DENSE, ERROR, FROM, INTO, NODES, REAL};
use super::report::Counts;
use nalgebra::Complex;

/// Newton iterations after which a shorter step is cheaper.
const MOST_ITERATIONS: usize = 6;
/// Largest fraction of the tolerance to which the stages are solved: a looser solution spoils the error estimate.
const SOLVED: f64 = 0.03;
/// Ratio of rounding to the tolerance below which the stages cannot be solved.
const ROUNDING: f64 = 10.0 * f64::EPSILON;
const SAFETY: f64 = 0.9;
const SHRINK: f64 = 0.2;
const GROWTH: f64 = 10.0;

/// The method.
#[derive(Debug)]
pub(super) struct Radau5 {
    matrices: Matrices,
    /// True if the Jacobian is that of the beginning of the step.
    ///
    /// It is never kept for the next step. Relaxation rates scale as 1/V where a mass acts, and fall by many decades while a
    /// slider accelerates. With the large rates of an old Jacobian, the iteration barely moves the fast unknowns and appears
    /// converged. The error estimate, filtered by the same matrix, does not detect it. Keeping it is also slower: a new Jacobian
    /// costs less than the iterations it saves.
    known: bool,
    /// Step length for which the matrices are factorised; 0: none.
    factorised: f64,
    /// Increments of the three stages, one after the other, and their transforms.
    z: Vec<f64>,
    w: Vec<f64>,
    f: Vec<f64>,
    delta: Vec<f64>,
    pair: Vec<Complex<f64>>,
    stage: Vec<f64>,
    error: Vec<f64>,
    /// Coefficients of the polynomial of the last accepted step, and its length; 0: none.
    last: Vec<f64>,
    last_length: f64,
    iterations: usize,
    /// Length and error of the previous accepted step.
    before: Option<(f64, f64)>,
    rejected: bool,
    factorisations: u64,
    solves: u64,
    failures: u64,
}

impl Radau5 {
    pub fn new(n: usize) -> Self {
        let zeros = |count: usize| vec![0.0; count];
        Self {
            matrices: Matrices::Unknown(n),
            known: false,
            factorised: 0.0,
            z: zeros(3 * n),
            w: zeros(3 * n),
            f: zeros(3 * n),
            delta: zeros(3 * n),
            pair: vec![Complex::new(0.0, 0.0); n],
            stage: zeros(n),
            error: zeros(n),
            last: zeros(3 * n),
            last_length: 0.0,
            iterations: 0,
            before: None,
            rejected: false,
            factorisations: 0,
            solves: 0,
            failures: 0,
        }
    }

    /// True if an upper estimate of the largest |λ| of the Jacobian is below `limit` \[1/s\].
    pub fn slower_than(&self, limit: f64) -> bool {
        self.matrices.slower_than(limit)
    }

    /// Factorises both matrices for steps of length `h`.
    fn factorise(&mut self, h: f64) -> bool {
        self.factorisations += 2;
        let pair = Complex::new(COMPLEX_REAL / h, COMPLEX_IMAGINARY / h);
        let regular = self.matrices.factorise(REAL / h, pair);
        self.factorised = if regular { h } else { 0.0 };
        regular
    }

    /// Writes the increments predicted by extrapolating the last polynomial.
    fn predict(&mut self, n: usize, h: f64) {
        if self.last_length == 0.0 {
            self.z.fill(0.0);
        } else {
            for (z, node) in self.z.chunks_exact_mut(n).zip(NODES) {
                let x = 1.0 + node * h / self.last_length;
                for (i, value) in z.iter_mut().enumerate() {
                    // The polynomial minus its value at 1, which is the end of the last step.
                    let c = [self.last[i], self.last[n + i], self.last[2 * n + i]];
                    *value = c[0] * (x - 1.0) + c[1] * (x * x - 1.0) + c[2] * (x * x * x - 1.0);
                }
            }
        }
        transform(&INTO, n, &self.z, &mut self.w);
    }

    /// Solves for the stages by Newton's method. `false`: it does not converge.
    fn solve(&mut self, system: &System<'_>, span: &Span) -> bool {
        let (n, h) = (span.y0.len(), span.h);
        self.predict(n, h);
        let tolerance = (ROUNDING / system.rtol).max(SOLVED.min(system.rtol.sqrt()));
        let mut norm_before = None;
        for iteration in 0..MOST_ITERATIONS {
            for (s, node) in NODES.into_iter().enumerate() {
                for i in 0..n {
                    self.stage[i] = span.y0[i] + self.z[s * n + i];
                }
                system.rates(span.t + node * h, &self.stage, &mut self.f[s * n..(s + 1) * n]);
            }
            let norm = self.correction(system, &span.y0, h);
            self.iterations = iteration + 1;
            let rate = norm_before.map(|before: f64| norm / before);
            if !norm.is_finite() || rate.is_some_and(|r| hopeless(r, norm, iteration, tolerance)) {
                return false;
            }
            for (w, d) in self.w.iter_mut().zip(&self.delta) {
                *w += d;
            }
            transform(&FROM, n, &self.w, &mut self.z);
            if norm == 0.0 || rate.is_some_and(|r| r / (1.0 - r) * norm < tolerance) {
                return true;
            }
            norm_before = Some(norm);
        }
        false
    }

    /// Computes the correction of the transformed stages into `delta`, and its norm.
    fn correction(&mut self, system: &System<'_>, y0: &[f64], h: f64) -> f64 {
        let n = y0.len();
        transform(&INTO, n, &self.f, &mut self.delta);
        let eigenvalue = Complex::new(COMPLEX_REAL, COMPLEX_IMAGINARY) / h;
        for i in 0..n {
            self.delta[i] -= REAL / h * self.w[i];
            self.pair[i] = Complex::new(self.delta[n + i], self.delta[2 * n + i])
                - eigenvalue * Complex::new(self.w[n + i], self.w[2 * n + i]);
        }
        self.matrices.solve_real(&mut self.delta[..n]);
        self.matrices.solve_complex(&mut self.pair);
        self.solves += 2;
        for i in 0..n {
            self.delta[n + i] = self.pair[i].re;
            self.delta[2 * n + i] = self.pair[i].im;
        }
        let squares: f64 = self.delta.chunks_exact(n).map(|d| system.norm(d, y0, y0).powi(2)).sum();
        (squares / 3.0).sqrt()
    }

    /// The error of the step over the tolerance.
    fn estimate(&mut self, system: &System<'_>, span: &Span) -> f64 {
        let (n, h) = (span.y0.len(), span.h);
        let from_stages = |z: &[f64], i: usize| (0..3).map(|s| ERROR[s] * z[s * n + i]).sum::<f64>() / h;
        for i in 0..n {
            self.error[i] = span.f0[i] + from_stages(&self.z, i);
        }
        self.matrices.solve_real(&mut self.error);
        self.solves += 1;
        let norm = system.norm(&self.error, &span.y0, &span.y1);
        if !(self.rejected || self.last_length == 0.0) || norm <= 1.0 {
            return norm;
        }
        // After a rejection and in the first step the filter is applied twice: stiff components would shorten the step
        // needlessly.
        for i in 0..n {
            self.stage[i] = span.y0[i] + self.error[i];
        }
        system.rates(span.t, &self.stage, &mut self.error);
        for i in 0..n {
            self.error[i] += from_stages(&self.z, i);
        }
        self.matrices.solve_real(&mut self.error);
        self.solves += 1;
        system.norm(&self.error, &span.y0, &span.y1)
    }
}

/// True if the remaining iterations will not reach the tolerance.
fn hopeless(rate: f64, norm: f64, iteration: usize, tolerance: f64) -> bool {
    let left = i32::try_from(MOST_ITERATIONS - iteration).unwrap_or(1);
    rate >= 1.0 || rate.powi(left) / (1.0 - rate) * norm > tolerance
}

/// Applies a 3 by 3 matrix across the stages.
fn transform(matrix: &[[f64; 3]; 3], n: usize, from: &[f64], into: &mut [f64]) {
    for (row, out) in matrix.iter().zip(into.chunks_exact_mut(n)) {
        for (i, value) in out.iter_mut().enumerate() {
            *value = row[0] * from[i] + row[1] * from[n + i] + row[2] * from[2 * n + i];
        }
    }
}

impl Formula for Radau5 {
    fn order(&self) -> i32 {
        3
    }

    fn attempt(&mut self, system: &System<'_>, span: &mut Span) -> Trial {
        let n = span.y0.len();
        if !self.known {
            self.matrices.evaluate(system, span.t, &span.y0);
            (self.known, self.factorised) = (true, 0.0);
        }
        let ready = self.factorised == span.h || self.factorise(span.h);
        if !ready || !self.solve(system, span) {
            self.failures += u64::from(ready);
            self.rejected = true;
            return Trial::Unsolved(0.5);
        }
        for i in 0..n {
            span.y1[i] = span.y0[i] + self.z[2 * n + i];
        }
        let error = self.estimate(system, span);
        if error <= 1.0 {
            system.rates(span.t + span.h, &span.y1, &mut span.f1);
        }
        Trial::Error(error)
    }

    fn complete(&mut self, system: &System<'_>, span: &mut Span) {
        system.rates(span.t + span.h, &span.y1, &mut span.f1);
    }

    fn share(&mut self, h: f64, error: f64, accepted: bool, rejected_before: bool) -> f64 {
        let most = MOST_ITERATIONS as f64;
        let safety = SAFETY * (2.0 * most + 1.0) / (2.0 * most + self.iterations as f64);
        let error = error.max(f64::MIN_POSITIVE);
        // Gustafsson's predictive control: the last two steps show how the error changes from step to step.
        let trend = self.before.map_or(1.0, |(length, last)| h / length * (last / error).powf(0.25));
        let share = safety * trend.min(1.0) * error.powf(-0.25);
        if !accepted {
            self.rejected = true;
            return share.clamp(SHRINK, SAFETY);
        }
        share.clamp(SHRINK, if rejected_before { 1.0 } else { GROWTH })
    }

    fn accept(&mut self, _system: &System<'_>, span: &Span, error: f64) {
        let n = span.y0.len();
        for (power, coefficients) in self.last.chunks_exact_mut(n).enumerate() {
            for (i, c) in coefficients.iter_mut().enumerate() {
                *c = (0..3).map(|s| DENSE[s][power] * self.z[s * n + i]).sum();
            }
        }
        self.last_length = span.h;
        self.before = Some((span.h, error.max(f64::MIN_POSITIVE)));
        self.rejected = false;
        self.known = false;
    }

    fn again(&mut self) {
        // The polynomial begins at the start of the step, not at its end.
        self.last_length = 0.0;
    }

    fn forget(&mut self) {
        (self.known, self.rejected) = (false, false);
        (self.last_length, self.factorised) = (0.0, 0.0);
        self.before = None;
    }

    fn interpolate(&self, _system: &System<'_>, span: &Span, fraction: f64, y: &mut [f64]) {
        let n = y.len();
        let powers = [fraction, fraction * fraction, fraction * fraction * fraction];
        let weights = DENSE.map(|row| row[0] * powers[0] + row[1] * powers[1] + row[2] * powers[2]);
        for (i, value) in y.iter_mut().enumerate() {
            *value = span.y0[i] + (0..3).map(|s| weights[s] * self.z[s * n + i]).sum::<f64>();
        }
    }

    fn tally(&self, counts: &mut Counts) {
        counts.factorisations += self.factorisations;
        counts.solves += self.solves;
        counts.newton_failures += self.failures;
    }
}

#[cfg(test)]
mod tests {
    use super::{COMPLEX_IMAGINARY, COMPLEX_REAL, DENSE, FROM, INTO, NODES, REAL};

    fn near(a: f64, b: f64) {
        assert!((a - b).abs() < 1e-12, "{a} is not {b}");
    }

    fn product(a: &[[f64; 3]; 3], b: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
        std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
    }

    #[test]
    fn the_polynomial_takes_the_values_of_the_stages() {
        for (s, x) in NODES.into_iter().enumerate() {
            for (stage, c) in DENSE.iter().enumerate() {
                near(x * (c[0] + x * (c[1] + x * c[2])), if s == stage { 1.0 } else { 0.0 });
            }
        }
    }

    #[test]
    fn the_transformation_separates_the_stages() {
        let unit = product(&INTO, &FROM);
        for (i, row) in unit.iter().enumerate() {
            for (j, value) in row.iter().enumerate() {
                near(*value, if i == j { 1.0 } else { 0.0 });
            }
        }
        // Slopes of the polynomial at the nodes: the inverse of the matrix of the method.
        let inverse: [[f64; 3]; 3] = NODES.map(|x| DENSE.map(|c| c[0] + x * (2.0 * c[1] + 3.0 * x * c[2])));
        let separated = product(&INTO, &product(&inverse, &FROM));
        let expected = [
            [REAL, 0.0, 0.0],
            [0.0, COMPLEX_REAL, -COMPLEX_IMAGINARY],
            [0.0, COMPLEX_IMAGINARY, COMPLEX_REAL],
        ];
        for (row, values) in separated.iter().zip(expected) {
            for (a, b) in row.iter().zip(values) {
                near(*a, b);
            }
        }
    }
}
