//! The stabilised explicit method of order 2 of Runge, Kutta and Chebyshev, with as many stages as stability requires.
//!
//! The stages follow Chebyshev's recursion, so that s of them are stable along the negative real axis up to `h |λ| = 2/3 (s² - 1)(1 -
//! 2ε/15)`. The work per unit time scales with the square root of the stiffness. Source: B. P. Sommeijer, L. F. Shampine, J. G. Verwer,
//! "RKC: an explicit solver for parabolic PDEs", J. Comput. Appl. Math. 88 (1998) 315-326, equations (2.1) to (2.7). The dense output is
//! Hermite's cubic.

use super::explicit::Control;
use super::one_step::{Formula, Span, Trial};
use super::problem::System;
use super::tasks::each;

/// ε: strength of damping along the axis.
const DAMPING: f64 = 2.0 / 13.0;
/// Limits on the stages of a step: fewer than two do not give order 2. Beyond the most, rounding grows with their square, and a
/// shorter step is no loss.
const FEWEST: usize = 2;
const MOST: usize = 250;
/// Safety factor on the stretch, for a spectral radius that grows within the step.
const RESERVE: f64 = 1.05;
/// Factor on the length of a step that needs too many stages.
const SHORTER: f64 = 0.8;

/// Number of stages that are stable up to `stretch = h |λ|`.
fn stages(stretch: f64) -> f64 {
    let room = 2.0 / 3.0 * (1.0 - 2.0 / 15.0 * DAMPING);
    (1.0 + RESERVE * stretch / room).sqrt().ceil().max(FEWEST as f64)
}

/// The coefficients of a stage.
#[derive(Clone, Copy, Debug, Default)]
struct Stage {
    /// Weights of the last stage and of the one before it; the start has the rest, so that the weights add up to one.
    mu: f64,
    nu: f64,
    /// Weights of the rates of the last stage and of the start, times the step length.
    mu_rate: f64,
    gamma: f64,
    /// Time of the last stage as a fraction of the step.
    node: f64,
}

/// Chebyshev's polynomials at w of one degree and of the degree below, with their first two derivatives.
#[derive(Clone, Copy)]
struct Chebyshev {
    w: f64,
    last: [f64; 3],
    before: [f64; 3],
}

impl Chebyshev {
    fn first(w: f64) -> Self {
        Self { w, last: [w, 1.0, 0.0], before: [1.0, 0.0, 0.0] }
    }

    fn next(&mut self) {
        let ([t, d, dd], [t0, d0, dd0], w) = (self.last, self.before, self.w);
        self.before = self.last;
        self.last = [2.0 * w * t - t0, 2.0 * (t + w * d) - d0, 2.0 * (2.0 * d + w * dd) - dd0];
    }

    /// b = T''/T'², constant over the first three degrees.
    fn b(&self) -> f64 {
        self.last[2] / (self.last[1] * self.last[1])
    }
}

/// The coefficients of the stages 1 to `count`, in order.
fn coefficients(count: usize, out: &mut Vec<Stage>) {
    let w0 = 1.0 + DAMPING / (count * count) as f64;
    let mut t = Chebyshev::first(w0);
    (1..count).for_each(|_| t.next());
    let w1 = t.last[1] / t.last[2];
    let mut t = Chebyshev::first(w0);
    t.next();
    let second = t.b();
    t = Chebyshev::first(w0);
    // b_0 = b_2, b_1 = 1/w0.
    let (mut b_before, mut b_last) = (second, 1.0 / w0);
    out.clear();
    out.push(Stage { mu_rate: b_last * w1, ..Stage::default() });
    let mut node = b_last * w1;
    for _ in 2..=count {
        let a = 1.0 - b_last * t.last[0];
        t.next();
        let b = t.b();
        let (mu, nu, mu_rate) = (2.0 * b * w0 / b_last, -b / b_before, 2.0 * b * w1 / b_last);
        out.push(Stage { mu, nu, mu_rate, gamma: -a * mu_rate, node });
        node = w1 * t.last[2] / t.last[1];
        (b_before, b_last) = (b_last, b);
    }
}

/// The method.
#[derive(Debug)]
pub(super) struct Rkc2 {
    /// Coefficients for the number of stages last used.
    stages: Vec<Stage>,
    before: Vec<f64>,
    last: Vec<f64>,
    rate: Vec<f64>,
    control: Control,
}

impl Rkc2 {
    pub fn new(size: usize) -> Self {
        let zeros = || vec![0.0; size];
        Self {
            stages: Vec::with_capacity(MOST),
            before: zeros(),
            last: zeros(),
            rate: zeros(),
            control: Control::new(3.0, 0.75, 0.2, 5.0),
        }
    }

    /// Error of the step over the tolerance: equation (2.9).
    fn error(&mut self, system: &System<'_>, span: &Span) -> f64 {
        let ends = [&span.y0[..], &span.y1, &span.f0, &span.f1];
        each(&mut self.rate, ends, |error, [y0, y1, f0, f1]| {
            *error = 0.8 * (y0 - y1) + 0.4 * span.h * (f0 + f1);
        });
        system.norm(&self.rate, &span.y0, &span.y1)
    }
}

impl Formula for Rkc2 {
    fn order(&self) -> i32 {
        2
    }

    fn attempt(&mut self, system: &System<'_>, span: &mut Span) -> Trial {
        let h = span.h;
        let wanted = stages(h * system.spectral_radius(span.t, &span.y0));
        if wanted > MOST as f64 {
            return Trial::Unsolved(SHORTER * (MOST as f64 / wanted).powi(2));
        }
        if !wanted.is_finite() {
            return Trial::Error(f64::NAN);
        }
        let count = wanted as usize;
        if self.stages.len() != count {
            coefficients(count, &mut self.stages);
        }
        let first = h * self.stages[0].mu_rate;
        self.before.copy_from_slice(&span.y0);
        for ((y, y0), f0) in self.last.iter_mut().zip(&span.y0).zip(&span.f0) {
            *y = y0 + first * f0;
        }
        for s in &self.stages[1..] {
            system.rates(span.t + s.node * h, &self.last, &mut self.rate);
            let (mu_rate, gamma) = (h * s.mu_rate, h * s.gamma);
            let known = [&span.y0[..], &span.f0, &self.last, &self.rate];
            each(&mut self.before, known, |y, [y0, f0, last, f]| {
                // Differences from the start retain their digits.
                *y = y0 + (s.mu * (last - y0) + s.nu * (*y - y0)) + (mu_rate * f + gamma * f0);
            });
            std::mem::swap(&mut self.before, &mut self.last);
        }
        span.y1.copy_from_slice(&self.last);
        system.rates(span.t + h, &span.y1, &mut span.f1);
        Trial::Error(self.error(system, span))
    }

    fn share(&mut self, h: f64, error: f64, accepted: bool, rejected_before: bool) -> f64 {
        self.control.share(h, error, accepted, rejected_before)
    }

    fn forget(&mut self) {
        self.control.forget();
    }

    fn interpolate(&self, _system: &System<'_>, span: &Span, fraction: f64, y: &mut [f64]) {
        hermite(span, fraction, y);
    }
}

/// Hermite's cubic through both ends of a step.
fn hermite(span: &Span, x: f64, y: &mut [f64]) {
    let z = 1.0 - x;
    for (i, y) in y.iter_mut().enumerate() {
        let (a, b, h) = (span.y0[i], span.y1[i], span.h);
        let (s0, s1) = (h * span.f0[i] - (b - a), h * span.f1[i] - (b - a));
        *y = (z * a + x * b) + x * z * (z * s0 - x * s1);
    }
}

#[cfg(test)]
mod tests {
    use super::{DAMPING, Stage, coefficients, stages};

    /// The stability function and the internal consistency: y' = z y with h = 1, starting from 1.
    fn grown(table: &[Stage], z: f64) -> f64 {
        let (mut before, mut last) = (1.0, 1.0 + table[0].mu_rate * z);
        for s in &table[1..] {
            let next = (1.0 - s.mu - s.nu) + s.mu * last + s.nu * before + s.mu_rate * z * last + s.gamma * z;
            (before, last) = (last, next);
        }
        last
    }

    fn table(count: usize) -> Vec<Stage> {
        let mut table = Vec::new();
        coefficients(count, &mut table);
        table
    }

    #[test]
    fn a_step_is_the_exponential_to_second_order() {
        for count in [2, 3, 5, 20, 200] {
            let table = table(count);
            let off = |z: f64| (grown(&table, z) - z.exp()).abs();
            assert!(off(1e-2) < 1e-6, "{count}: {}", off(1e-2));
            assert!(off(1e-1) / off(0.5e-1) > 6.5, "{count}");
        }
    }

    #[test]
    fn stages_have_the_times_of_their_states() {
        for count in [2, 4, 17] {
            let table = table(count);
            let (mut before, mut last) = (0.0, table[0].mu_rate);
            for s in &table[1..] {
                assert!((s.node - last).abs() < 1e-13, "{count}");
                let next = s.mu * last + s.nu * before + s.mu_rate + s.gamma;
                (before, last) = (last, next);
            }
            assert!((last - 1.0).abs() < 1e-12, "{count}: {last}");
        }
    }

    #[test]
    fn as_many_stages_as_are_asked_for_are_damped_to_their_end() {
        for stretch in [0.5, 3.0, 40.0, 1e3, 2e4] {
            let table = table(stages(stretch) as usize);
            for k in 1..=400 {
                let z = -stretch * f64::from(k) / 400.0;
                assert!(grown(&table, z).abs() < 1.0, "{stretch}: {z}");
            }
            let end = grown(&table, -stretch).abs();
            assert!(stretch < 3.0 || end < 1.0 - DAMPING / 3.0 + 0.05, "{stretch}: {end}");
        }
    }
}
