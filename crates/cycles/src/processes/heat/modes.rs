//! Diffusion across a fault as a sum of decaying modes.
//!
//! A unit of heat in a Gaussian zone of standard deviation w leaves at its centre, after a time s, the density
//!
//! ```text
//! g(s) = 1/√(2π (w² + 2 α s)) = (1/π) ∫ exp(-k² (w²/2 + α s)) dk  over k > 0.
//! ```
//!
//! The integral over ln k is computed by the trapezoidal rule (H. Noda, N. Lapusta, J. Geophys. Res. 115 (2010) B12314,
//! use such wave numbers as well): `g(s) = Σ_j c_j exp(-λ_j s)` with `λ_j = α k_j²`. Relative to g, the error of the rule
//! with spacing h is `2/√cosh(π²/h)` at most, by the Fourier transform of the integrand, for every w and s. All wave
//! numbers below the smallest one are one mode with their sum and their mean decay.

use std::f64::consts::PI;

/// Spacing of ln k. The trapezoidal rule has a relative error of 1.0e-6.
const SPACING: f64 = 1.0 / 3.0;
/// Largest w k. Larger ones hold 2e-7 of the density at s = 0, and less later.
const LARGEST: f64 = 5.2;
/// Smallest k √(w²/2 + α s) at the longest time. To lump what is below changes the density by 5e-7 there, and less
/// earlier.
const SMALLEST: f64 = 0.1;

/// Modes of diffusion with one diffusivity.
#[derive(Clone, Debug, PartialEq)]
pub struct Modes {
    /// λ_j \[1/s\].
    rates: Vec<f64>,
    /// c_j \[1/m\].
    weights: Vec<f64>,
}

impl Modes {
    /// Modes of a zone of standard deviation w \[m\] with diffusivity α \[m²/s\], for times up to `longest` \[s\].
    #[must_use]
    pub fn new(width: f64, diffusivity: f64, longest: f64) -> Self {
        let spread = 0.5 * width * width + diffusivity * longest;
        let weight = |k: f64, size: f64| size / PI * (-0.5 * (k * width) * (k * width)).exp();
        let (mut rates, mut weights) = (Vec::new(), Vec::new());
        let mut k = LARGEST / width;
        loop {
            rates.push(diffusivity * k * k);
            weights.push(weight(k, SPACING * k));
            if k * spread.sqrt() <= SMALLEST {
                break;
            }
            k *= (-SPACING).exp();
        }
        // Geometric sums of k_j and k_j³ below the last k.
        let (sum, cubes) = (1.0 / SPACING.exp_m1(), 1.0 / (3.0 * SPACING).exp_m1());
        let mean = k * (cubes / sum).sqrt();
        rates.push(diffusivity * mean * mean);
        weights.push(weight(mean, SPACING * k * sum));
        Self { rates, weights }
    }

    /// Number of modes.
    #[must_use]
    pub fn len(&self) -> usize {
        self.rates.len()
    }

    /// False: there are always some.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.rates.is_empty()
    }

    /// g at a time s ≥ 0 \[1/m\].
    #[must_use]
    pub fn density(&self, time: f64) -> f64 {
        self.rates.iter().zip(&self.weights).map(|(rate, weight)| weight * (-rate * time).exp()).sum()
    }

    /// Prepares evaluations a time `length` ≥ 0 \[s\] after the modes were committed.
    pub(super) fn open(&self, length: f64, window: &mut Window) {
        window.length = length;
        window.moments = [0.0; 3];
        window.density = 0.0;
        window.decay.clear();
        window.fade.clear();
        for (rate, weight) in self.rates.iter().zip(&self.weights) {
            let left = weight * (-rate * length).exp();
            window.decay.push(left);
            window.fade.push(-rate * left);
            window.density += left;
            let parts = moments(rate * length);
            for (sum, part) in window.moments.iter_mut().zip(parts) {
                *sum += length * weight * part;
            }
        }
    }

    /// Advances modes over a step of this length \[s\] in which the heating is `course`.
    pub(super) fn advance(&self, length: f64, course: &Course, modes: &mut [f64]) {
        for (mode, rate) in modes.iter_mut().zip(&self.rates) {
            let z = rate * length;
            let [zeroth, first, second] = moments(z);
            let gained = course.flux * zeroth + course.linear * first + course.square * second;
            *mode = *mode * (-z).exp() + length * gained;
        }
    }
}

/// Below this z the recurrence of the moments loses digits.
const SERIES: f64 = 1.0;
/// Terms of the series, of which the next is below 1e-16.
const TERMS: i32 = 17;

/// `∫ exp(-z (1 - u)) u^m du` over (0, 1) for m = 0, 1, 2.
fn moments(z: f64) -> [f64; 3] {
    if z >= SERIES {
        let zeroth = -(-z).exp_m1() / z;
        let first = (1.0 - zeroth) / z;
        return [zeroth, first, (1.0 - 2.0 * first) / z];
    }
    // Σ_k (-z)^k m!/(m + k + 1)!
    let (mut sums, mut term) = ([0.0; 3], 1.0);
    for k in 0..TERMS {
        let k = f64::from(k);
        let terms = [term / (k + 1.0), term / ((k + 1.0) * (k + 2.0))];
        sums[0] += terms[0];
        sums[1] += terms[1];
        sums[2] += 2.0 * terms[1] / (k + 3.0);
        term *= -z / (k + 1.0);
    }
    sums
}

/// Heating of a point since the modes were committed: `q(s) = flux + linear u + square u²` with u = s/Δ \[W/m²\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Course {
    pub flux: f64,
    pub linear: f64,
    pub square: f64,
}

/// Sums over modes at a time Δ after they were committed.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Window {
    length: f64,
    /// c_j exp(-λ_j Δ).
    decay: Vec<f64>,
    /// Their rates.
    fade: Vec<f64>,
    /// J_m = ∫ g(Δ - s) u^m ds for m = 0, 1, 2.
    moments: [f64; 3],
    /// g(Δ).
    density: f64,
}

impl Window {
    /// Density of heat at the centre \[J/m³\].
    pub fn value(&self, modes: &[f64], course: &Course) -> f64 {
        let [zeroth, first, second] = self.moments;
        dot(&self.decay, modes) + course.flux * zeroth + course.linear * first + course.square * second
    }

    /// Its rate \[W/m³\] for this course, whose end is the present heating.
    pub fn rate(&self, modes: &[f64], course: &Course) -> f64 {
        let [zeroth, first, _] = self.moments;
        let before = dot(&self.fade, modes) + course.flux * self.density;
        if self.length == 0.0 {
            return before;
        }
        before + (course.linear * zeroth + 2.0 * course.square * first) / self.length
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn exact(width: f64, diffusivity: f64, time: f64) -> f64 {
        1.0 / (2.0 * PI * (width * width + 2.0 * diffusivity * time)).sqrt()
    }

    #[test]
    fn the_density_is_that_of_the_gaussian_at_all_times_to_the_stated_error() {
        let (width, diffusivity, longest) = (1e-3, 1e-6, 3e10);
        let modes = Modes::new(width, diffusivity, longest);
        assert!(modes.len() < 64, "{}", modes.len());
        for k in 0..400 {
            let time = if k == 0 { 0.0 } else { 1e-6 * (longest / 1e-6).powf(f64::from(k) / 399.0) };
            let error = modes.density(time) / exact(width, diffusivity, time) - 1.0;
            // 1.0e-6 of the rule, 2e-7 above and 5e-7 below.
            assert!(error.abs() < 2e-6, "{time}: {error}");
        }
    }

    #[test]
    fn a_coarser_rule_has_the_error_of_the_formula() {
        // The first term of the Fourier series of the error; the next is its square over two, relative to the bound.
        let error = |spacing: f64| {
            let sum = |x0: f64| -> f64 {
                let term = |j: i32| {
                    let k = (x0 + spacing * f64::from(j)).exp();
                    spacing * k * (-k * k).exp()
                };
                (-200..200).map(term).sum::<f64>() / (0.5 * PI.sqrt()) - 1.0
            };
            (0..40).map(|i| sum(spacing * f64::from(i) / 40.0).abs()).fold(0.0, f64::max)
        };
        for spacing in [1.0, 0.7, 0.5] {
            let bound = 2.0 / (PI * PI / spacing).cosh().sqrt();
            let found = error(spacing);
            assert!((found / bound - 1.0).abs() < 0.01, "{spacing}: {found} {bound}");
        }
    }

    #[test]
    fn moments_are_those_of_both_formulas() {
        let by_recurrence = |z: f64| {
            let zeroth = -(-z).exp_m1() / z;
            let first = (1.0 - zeroth) / z;
            [zeroth, first, (1.0 - 2.0 * first) / z]
        };
        for z in [0.3, 0.9, 1.0 - 1e-12] {
            for (a, b) in moments(z).iter().zip(by_recurrence(z)) {
                assert!((a / b - 1.0).abs() < 1e-13, "{z}: {a} {b}");
            }
        }
        assert_eq!(moments(0.0), [1.0, 0.5, 2.0 / 6.0]);
    }

    #[test]
    fn the_rate_is_the_derivative_of_the_density() {
        let modes = Modes::new(1e-3, 1e-6, 1e3);
        let state: Vec<f64> = (0..modes.len()).map(|j| 1.0 + 0.1 * j as f64).collect();
        // Heating 3 + 5 s², whose course at Δ has linear = 0 and square = 5 Δ².
        let at = |length: f64| {
            let mut window = Window::default();
            modes.open(length, &mut window);
            let course = Course { flux: 3.0, linear: 0.0, square: 5.0 * length * length };
            (window.value(&state, &course), window.rate(&state, &course))
        };
        for length in [1e-3, 0.1, 10.0] {
            let step = 1e-5 * length;
            let slope = (at(length + step).0 - at(length - step).0) / (2.0 * step);
            let rate = at(length).1;
            assert!((slope / rate - 1.0).abs() < 1e-7, "{length}: {slope} {rate}");
        }
        assert!((at(0.0).1 / at(1e-12).1 - 1.0).abs() < 1e-6);
    }
}
