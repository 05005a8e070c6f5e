//! Critical stiffness: on a softer spring, steady sliding is unstable.
//!
//! Consider steady sliding at V, with springs whose far ends move at constant rates. With the response of friction
//! `μ = a x + q Σ φ_i`, `dφ_i/dt = -r_i (φ_i + b_i x) - C_i dμ/dt` ([`Response`]), small perturbations proportional to
//! `e^(s t)` satisfy
//!
//! ```text
//! f_n s N(s) + (k V + η V s + M V s²) D(s) = 0,   N = a - q Σ b_i r_i/(s + r_i),   D = 1 + q Σ C_i s/(s + r_i).
//! ```
//!
//! A pair of roots lies on the imaginary axis, s = i ω, where `Re N/D = -η V/f_n`, for the stiffness
//! `k = (f_n ω/V) Im N/D + M ω²`. For one state without memory that is `k_c = (f_n/L)(b - a')(1 + n/a')`.

use super::problem::Problem;
use asperity_friction::slider::{History, Response, Slider};
use nalgebra::Complex;

/// The search for roots begins at this share of the slowest relaxation rate, and ends at the fastest divided by this
/// share. Slower roots belong to stiffnesses below the square of this share of that of the law.
const LEAST: f64 = 1e-9;
/// Number of steps of the search in an e-fold of frequency. No term of the equation changes by more than a third in a step.
const STEPS: f64 = 8.0;
/// Number of halvings of such a step; they reach rounding.
const HALVINGS: usize = 60;

/// Stiffnesses at which small perturbations of steady sliding neither grow nor decay.
#[derive(Clone, Debug, PartialEq)]
pub struct Stability {
    /// Stiffness \[Pa/m\], and true if a softer spring has one more growing oscillation (false: one less).
    marginal: Vec<(f64, bool)>,
}

impl Stability {
    /// Stability of a slider that slides steadily at `rate` \[m/s\] under `normal` \[Pa\].
    #[must_use]
    pub fn new(slider: &Slider, rate: f64, normal: f64) -> Self {
        let speed = rate.abs();
        let response = slider.law.response(speed.ln());
        let (mass, damping) = (slider.mass.unwrap_or(0.0), slider.damping * speed / normal);
        let stiffness =
            |omega: f64| normal * omega / speed * ratio(&response, omega).im + mass * omega * omega;
        let marginal =
            frequencies(&response, damping).into_iter().map(|(omega, rises)| (stiffness(omega), rises));
        Self { marginal: marginal.filter(|m| m.0 > 0.0).collect() }
    }

    /// Critical stiffness k_c \[Pa/m\]: steady sliding is stable on any stiffer spring. Zero if it is stable on any
    /// spring.
    #[must_use]
    pub fn critical(&self) -> f64 {
        self.marginal.iter().map(|m| m.0).fold(0.0, f64::max)
    }

    /// True if steady sliding on a spring of this stiffness \[Pa/m\] is unstable. With several states it may be stable
    /// again on springs far softer than critical.
    #[must_use]
    pub fn unstable(&self, stiffness: f64) -> bool {
        let passed = self.marginal.iter().filter(|m| m.0 > stiffness);
        passed.map(|m| if m.1 { 1 } else { -1 }).sum::<i32>() > 0
    }
}

/// The critical stiffness of a slider \[Pa/m\]: see [`Stability::critical`].
#[must_use]
pub fn critical_stiffness(slider: &Slider, rate: f64, normal: f64) -> f64 {
    Stability::new(slider, rate, normal).critical()
}

/// N/D at s = i ω.
fn ratio(response: &Response, omega: f64) -> Complex<f64> {
    let (mut n, mut d) = (Complex::new(response.direct, 0.0), Complex::new(1.0, 0.0));
    for state in &response.states {
        let q = response.weight / Complex::new(state.rate, omega);
        n -= q * (state.weakening * state.rate);
        d += q * Complex::new(0.0, state.memory * omega);
    }
    n / d
}

/// Frequencies of marginal oscillations \[1/s\], ascending, each with true if Re N/D + η V/f_n rises there.
fn frequencies(response: &Response, damping: f64) -> Vec<(f64, bool)> {
    let rates = response.states.iter().map(|s| s.rate);
    let (slowest, fastest) = (rates.clone().fold(f64::INFINITY, f64::min), rates.fold(0.0, f64::max));
    if fastest == 0.0 || !fastest.is_finite() {
        return Vec::new();
    }
    let value = |log: f64| ratio(response, log.exp()).re + damping;
    let (first, last) = ((LEAST * slowest).ln(), (fastest / LEAST).ln());
    let count = ((last - first) * STEPS).ceil();
    let mut found = Vec::new();
    let mut low = (first, value(first));
    for i in 1..=count as usize {
        let log = first + (last - first) * i as f64 / count;
        let high = (log, value(log));
        if (low.1 < 0.0) != (high.1 < 0.0) {
            found.push((zero(&value, low, high.0).exp(), low.1 < 0.0));
        }
        low = high;
    }
    found
}

/// Finds the zero of a function between two arguments; its value at the first is given.
fn zero(f: &impl Fn(f64) -> f64, (mut low, value): (f64, f64), mut high: f64) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if (f(middle) < 0.0) == (value < 0.0) { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// Stiffness K and stability of each slider under the load and normal traction at time 0; none where there is no steady
/// sliding.
fn each(problem: &Problem) -> Vec<Option<(f64, Stability)>> {
    let rate = problem.system.load().piece(0.0).at(0.0).0;
    let each = problem.system.sliders().iter().enumerate();
    each.map(|(i, s)| {
        let slides = rate != 0.0 && problem.system.imposed(i).is_none();
        slides.then(|| (problem.system.stiffness(i), Stability::new(s, rate, s.normal.piece(0.0).at(0.0).0)))
    })
    .collect()
}

/// Stiffness of a slider's springs against the critical one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Against {
    /// Stiffness of all its springs \[Pa/m\].
    pub stiffness: f64,
    /// Critical stiffness; 0 if it is stable on any spring \[Pa/m\].
    pub critical: f64,
    /// True if steady sliding is unstable.
    pub unstable: bool,
}

/// Stiffness of each slider against the critical one at the rate of the load point; none where there is no steady sliding.
#[must_use]
pub fn against(problem: &Problem) -> Vec<Option<Against>> {
    let of = |(stiffness, stability): (f64, Stability)| Against {
        stiffness,
        critical: stability.critical(),
        unstable: stability.unstable(stiffness),
    };
    each(problem).into_iter().map(|one| one.map(of)).collect()
}

/// Description of the stability of each slider.
#[must_use]
pub fn words(problem: &Problem) -> Vec<Option<String>> {
    let coupled = !problem.system.springs().is_empty();
    let of = if coupled { "K of all its springs" } else { "k" };
    let of_one = |(stiffness, stability): (f64, Stability)| {
        let critical = stability.critical();
        if critical == 0.0 {
            return "stable on any spring at the rate of the load point".to_string();
        }
        let again = stiffness < critical && !stability.unstable(stiffness);
        let again = if again { "; stable again on a spring as soft as this" } else { "" };
        format!("{of}/k_c = {:.6}, k_c = {critical:.6e} Pa/m{again}", stiffness / critical)
    };
    each(problem).into_iter().map(|one| one.map(of_one)).collect()
}

/// Remarks about the stability of the whole system.
#[must_use]
pub fn remarks(problem: &Problem) -> Vec<String> {
    let steady = matches!(problem.system.load(), History::Constant(_))
        && problem.system.sliders().iter().all(|s| matches!(s.normal, History::Constant(_)));
    let alone = problem.events.is_some() && problem.system.springs().is_empty();
    let stable = |one: Option<(f64, Stability)>| one.is_some_and(|(k, s)| !s.unstable(k));
    if alone && steady && each(problem).into_iter().all(stable) {
        return vec![
            "steady sliding at the rate of the load point is stable (k >= k_c): events come from the start alone, if at all"
                .to_string(),
        ];
    }
    Vec::new()
}

/// Sliders on springs softer than critical with neither damping nor mass, which run away, each with k/k_c.
#[must_use]
pub fn runaways(problem: &Problem) -> Vec<(usize, f64)> {
    let found = each(problem).into_iter().enumerate();
    found
        .filter_map(|(i, one)| {
            let (stiffness, stability) = one?;
            let s = &problem.system.sliders()[i];
            let free = s.damping == 0.0 && s.mass.is_none();
            (free && stability.unstable(stiffness)).then(|| (i, stiffness / stability.critical()))
        })
        .collect()
}
