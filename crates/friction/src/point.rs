//! The point return: the slip rate at which a point behind a penalty spring balances its strength.
//!
//! With the spring's trial traction t^e and `c = E_t Δt/w`, the balance is `G(z) = c e^z + f_n μ(e^z, φ(e^z, Δt)) - T = 0`,
//! z = ln V, T = t^e - c offset. Without weakening G is increasing and convex (a sum of e^z and asinh(k e^z)), so that
//! Newton's method started where G ≥ 0 comes down on the root without overshooting. With a state G may fall in between: see
//! [`solve`].

use crate::Failure;
use crate::evolution::Evolution;
use crate::strength::{Form, Strength};

/// Iterations before a point is given up. Convex cases need 3 to 8; bisection over 700 e-folds to rounding needs 60.
const MOST: usize = 100;
/// G is a sum of three terms of the size of T; each is rounded once or twice.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Neighbouring numbers are at most this far apart, relatively; a step of two of them may be the rounding of G.
const SPACING: f64 = 2.0 * f64::EPSILON;
/// Stride of the search for the first root in ln V: x = V Δt/L and the asinh turn over one e-fold, so a quarter of it shows
/// every fold that matters.
const STRIDE: f64 = 0.25;
/// Widest range searched, in e-folds of V below the rate of the free spring: below it no state evolves over a step.
const WIDEST: f64 = 200.0;

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

impl Point {
    /// Strength and spring traction of an answer, adding up to the drive: the larger of the two is the drive less the
    /// smaller, so that neither loses digits.
    #[must_use]
    pub fn shares(&self, s: &Solution) -> (f64, f64) {
        let (strength, spring) = (self.normal * s.mu, self.spring * s.log_rate.exp());
        if spring >= strength { (strength, self.drive - strength) } else { (self.drive - spring, spring) }
    }
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

/// Solves one point. Where the state could weaken faster than the spring unloads, the answer is the one reached from rest
/// without passing a rate at which G falls.
///
/// # Errors
/// [`Failure::NotConverged`], [`Failure::NonFinite`], [`Failure::BareLogAtRest`] where the bare logarithm is negative at every
/// rate in question, or, without such an answer, [`Failure::Unstable`] (per weight of a two-step difference); point 0.
pub fn solve<F: Form, E: Evolution>(form: &F, evolution: &E, p: &Point) -> Result<Solution, Failure> {
    // The spring alone carries T at this rate.
    let top = (p.drive / p.spring).ln();
    let z = start(form, evolution, p, top);
    if !(z.is_finite() && top.is_finite()) {
        return Err(Failure::NonFinite { point: 0, normal: p.normal, trial: p.drive });
    }
    if !form.regular_at_rest() && evaluate(form, evolution, p, top, 0).g < 0.0 {
        return Err(Failure::BareLogAtRest { point: 0, rate: top.exp() });
    }
    let bracket = bracket(form, evolution, p, top)?;
    newton(form, evolution, p, z.clamp(bracket.0, bracket.1), bracket)
}

/// Newton's method from `z` inside the bracket, which it narrows.
fn newton<F: Form, E: Evolution>(
    form: &F,
    evolution: &E,
    p: &Point,
    mut z: f64,
    (mut low, mut high): (f64, f64),
) -> Result<Solution, Failure> {
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
        let step = step(p, &value);
        let floor = ROUNDING * (p.drive + p.normal * value.solution.mu.abs());
        // At the rounding floor of G, or when z can no longer be told from its successor, one is done.
        if value.g.abs() <= floor || step.abs() <= SPACING * z.abs() {
            return Ok(value.solution);
        }
        let next = guarded(z, step, (low, high));
        last = value.g;
        z = next;
    }
    Err(Failure::NotConverged { point: 0, normal: p.normal, trial: p.drive, residual: last })
}

/// Bounds of the answer in ln V. Without state or behind a stiff spring G increases everywhere, and below the rate of the
/// free spring is enough.
fn bracket<F: Form, E: Evolution>(
    form: &F,
    evolution: &E,
    p: &Point,
    top: f64,
) -> Result<(f64, f64), Failure> {
    // An e-fold above the bound, for rounding.
    let everywhere = (f64::NEG_INFINITY, top + 1.0);
    if E::STATES == 0 {
        return Ok(everywhere);
    }
    let weakening = evolution.weakening(p.state, top);
    if p.spring > p.normal * weakening * p.dt {
        return Ok(everywhere);
    }
    // Up to here the direct effect outweighs the state, and G increases.
    let safe = (form.direct_effect() / (weakening * p.dt)).ln().max(top - WIDEST);
    if safe >= top || evaluate(form, evolution, p, safe, 0).g >= 0.0 {
        return Ok((f64::NEG_INFINITY, safe.min(top)));
    }
    let mut z = safe;
    while z < top {
        let next = (z + STRIDE).min(top);
        let value = evaluate(form, evolution, p, next, 0);
        if value.g >= 0.0 || next == top {
            return Ok((z, next));
        }
        if value.slope <= 0.0 {
            let rate = next.exp();
            let weakening = -p.normal * value.solution.slope / (rate * p.dt);
            return Err(Failure::Unstable { point: 0, stiffness: p.spring / p.dt, weakening });
        }
        z = next;
    }
    Ok((z, top))
}

/// Where the iteration starts: the smaller of the rates at which the spring alone and the strength alone would balance.
fn start<F: Form, E: Evolution>(form: &F, evolution: &E, p: &Point, top: f64) -> f64 {
    top.min(form.log_rate(p.drive / p.normal, evolution.phi(p.state)))
}

/// The Newton step. Above the root on G, which is convex; below it on ln(G + T), which is close to concave (linear in z where
/// the strength is linear in V, logarithmic above): neither overshoots by much.
fn step(p: &Point, value: &Value) -> f64 {
    if value.g < 0.0 {
        -(value.g / p.drive).ln_1p() * (p.drive + value.g) / value.slope
    } else {
        -value.g / value.slope
    }
}

/// The Newton step where it stays inside the bracket, otherwise half the bracket or, without a lower bound, further down.
/// Far down G is linear in z to rounding, so that long steps down are good ones; steps up are bounded by the free spring.
fn guarded(z: f64, step: f64, (low, high): (f64, f64)) -> f64 {
    let next = z + step;
    if next > low && next < high {
        next
    } else if low.is_finite() {
        0.5 * (low + high)
    } else {
        high - WIDEST
    }
}
