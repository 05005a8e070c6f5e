//! The point return: the slip rate at which a point behind a penalty spring balances its strength.
//!
//! With the spring's trial traction t^e and `c = E_t Δt/w`, the balance is `G(z) = c e^z + f_n μ(e^z, φ(e^z, Δt)) - T = 0`,
//! z = ln V, T = t^e - c offset. Without weakening G is increasing and convex (a sum of e^z and asinh(k e^z)), so that
//! Newton's method started where G ≥ 0 comes down on the root without overshooting. A bracket guards the laws with state.

use crate::Failure;
use crate::evolution::Evolution;
use crate::strength::{Form, Strength};

/// Iterations before a point is given up. Convex cases need 3 to 8; bisection over 700 e-folds to rounding needs 60.
const MOST: usize = 100;
/// G is a sum of three terms of the size of T; each is rounded once or twice.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// One point's problem.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// f_n > 0 \[Pa\].
    pub normal: f64,
    /// T > 0 \[Pa\].
    pub drive: f64,
    /// c = E_t Δt/w \[Pa s/m\], positive.
    pub spring: f64,
    /// Δt \[s\] over which the state evolves.
    pub dt: f64,
    /// State before the step.
    pub state: f64,
}

/// One point's answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solution {
    /// ln V.
    pub log_rate: f64,
    /// μ.
    pub mu: f64,
    /// dμ/dln V with the state following \[-\].
    pub slope: f64,
    /// State after the step.
    pub state: f64,
    /// Iterations.
    pub iterations: usize,
}

/// G, its derivative and what they are made of.
struct Value {
    g: f64,
    slope: f64,
    solution: Solution,
}

fn evaluate<F: Form, E: Evolution>(form: &F, evolution: &E, p: &Point, z: f64, iterations: usize) -> Value {
    let evolved = evolution.step(p.state, z, p.dt);
    let Strength { mu, d_log_rate, d_phi } = form.at(z, evolution.phi(evolved.state));
    let spring = p.spring * z.exp();
    let slope = d_log_rate + d_phi * evolved.d_phi;
    Value {
        g: spring + p.normal * mu - p.drive,
        slope: spring + p.normal * slope,
        solution: Solution { log_rate: z, mu, slope, state: evolved.state, iterations },
    }
}

/// Solves one point.
///
/// # Errors
/// [`Failure::NotConverged`] or [`Failure::NonFinite`], with point number 0.
pub fn solve<F: Form, E: Evolution>(form: &F, evolution: &E, p: &Point) -> Result<Solution, Failure> {
    let mut z = start(form, evolution, p);
    if !z.is_finite() {
        return Err(Failure::NonFinite { point: 0, normal: p.normal, trial: p.drive });
    }
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    let mut last = f64::INFINITY;
    for iteration in 1..=MOST {
        let value = evaluate(form, evolution, p, z, iteration);
        if !value.g.is_finite() {
            return Err(Failure::NonFinite { point: 0, normal: p.normal, trial: p.drive });
        }
        if value.g > 0.0 {
            high = z;
        } else {
            low = z;
        }
        let next = guarded(z, -value.g / value.slope, (low, high));
        let floor = ROUNDING * (p.drive + p.normal * value.solution.mu.abs());
        // At the rounding floor of G, or when z can no longer be told from its successor, one is done.
        if value.g.abs() <= floor || next == z || (next - z).abs() <= f64::EPSILON * z.abs() {
            return Ok(value.solution);
        }
        last = value.g;
        z = next;
    }
    Err(Failure::NotConverged { point: 0, normal: p.normal, trial: p.drive, residual: last })
}

/// Where the iteration starts: the smaller of the rates at which the spring alone and the strength alone would balance.
fn start<F: Form, E: Evolution>(form: &F, evolution: &E, p: &Point) -> f64 {
    let spring = (p.drive / p.spring).ln();
    let strength = form.log_rate(p.drive / p.normal, evolution.phi(p.state));
    spring.min(strength)
}

/// The Newton step kept inside the bracket; without a bracket on that side, its length is limited.
fn guarded(z: f64, step: f64, (low, high): (f64, f64)) -> f64 {
    /// Longest step outside a bracket: e-folds of V over which the exponential may be extrapolated.
    const LONGEST: f64 = 50.0;
    let next = z + step;
    if next.is_finite() && next > low && next < high && (low.is_finite() && high.is_finite() || step.abs() <= LONGEST) {
        return next;
    }
    match (low.is_finite(), high.is_finite()) {
        (true, true) => 0.5 * (low + high),
        (true, false) => low + step.abs().clamp(1.0, LONGEST),
        _ => high - step.abs().clamp(1.0, LONGEST),
    }
}
