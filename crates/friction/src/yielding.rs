//! Parts common to laws with a yield surface: the capped cone, the return of a point to it, and limit r6.

use crate::Failure;
use crate::law::{BAND, Increments, Limit, LimitKind, PresentStates, Regime, Responses, Trials};
use crate::line::Line;

/// A largest shear traction F_limit \[Pa\]; infinite if there is none.
///
/// # Errors
/// [`Failure::Parameter`] if it is not positive.
pub(crate) fn cap(limit: Option<f64>) -> Result<f64, Failure> {
    limit.map_or(Ok(f64::INFINITY), |value| crate::positive("f_limit", value))
}

/// A cohesion \[Pa\].
///
/// # Errors
/// [`Failure::Parameter`] if it is negative or not finite.
pub(crate) fn cohesion(value: f64) -> Result<f64, Failure> {
    if value >= 0.0 && value.is_finite() {
        return Ok(value);
    }
    Err(Failure::Parameter { name: "cohesion", value, admissible: "0 <= cohesion, finite" })
}

/// Cone of a yield law: the strength is c + μ f_n.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cone {
    /// μ \[-\].
    pub mu: f64,
    /// c \[Pa\].
    pub cohesion: f64,
}

/// Strength of a cone that is cut off.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ConeStrength {
    /// F̄ \[Pa\].
    pub value: f64,
    /// ∂F̄/∂f_n \[-\].
    pub slope: f64,
}

/// Strength F̄ = min(c + μ f_n, F_limit).
#[inline]
pub(crate) fn strength(cone: Cone, normal: f64, cap: f64) -> ConeStrength {
    let value = cone.cohesion + cone.mu * normal;
    let (value, slope) = if value <= cap { (value, cone.mu) } else { (cap, 0.0) };
    ConeStrength { value, slope }
}

/// Refuses a point with inputs that are not finite.
#[inline]
pub(crate) fn all_finite(point: usize, normal: f64, trial: f64, others: &[f64]) -> Result<(), Failure> {
    if normal.is_finite() && trial.is_finite() && others.iter().all(|x| x.is_finite()) {
        Ok(())
    } else {
        Err(Failure::NonFinite { point, normal, trial })
    }
}

/// The implicit answer of point k where the strength does not depend on slip: a trial up to `held` \[Pa\] sticks; one above slips
/// at its strength. The caller updates the states; the answer shows if the point sticks.
#[inline]
pub(crate) fn answer(
    t: &Trials<'_>,
    k: usize,
    held: f64,
    sliding: ConeStrength,
    out: &mut Responses<'_>,
) -> bool {
    let (trial, ConeStrength { value: strength, slope }) = (t.trial[k], sliding);
    let stick = trial <= held;
    out.regime[k] = if stick { Regime::Stick } else { Regime::Slip };
    out.traction[k] = if stick { trial } else { strength };
    out.slip[k] = if stick { 0.0 } else { (trial - strength) / t.stiffness };
    out.d_trial[k] = if stick { 1.0 } else { 0.0 };
    out.d_normal[k] = if stick { 0.0 } else { slope };
    out.rate[k] = if stick { 0.0 } else { rate_of(t, k, out.slip[k]) };
    stick
}

/// Slip rate \[m/s\] of point k that slips by Δλ \[m\] over an implicit step.
#[inline]
pub(crate) fn rate_of(t: &Trials<'_>, k: usize, slip: f64) -> f64 {
    let (weight, offset) = t.lag.map_or((1.0, 0.0), |lag| (lag.weight[k], lag.offset[k]));
    weight * slip / t.dt - offset
}

/// Limit r6 over all sticking points, with the cone that holds each and the cap \[Pa\].
pub(crate) fn first_exit(
    present: &PresentStates<'_>,
    step: &Increments<'_>,
    cone: impl Fn(usize) -> Cone,
    cap: f64,
) -> Option<Limit> {
    (0..present.normal.len())
        .filter(|&k| present.regime[k] == Regime::Stick)
        .map(|k| exit(present, step, k, cone(k), cap))
        .fold(None, smaller)
}

/// The smaller of two limits; the first if they are equal.
pub(crate) fn smaller(a: Option<Limit>, b: Option<Limit>) -> Option<Limit> {
    match (a, b) {
        (Some(a), Some(b)) => Some(if b.fraction < a.fraction { b } else { a }),
        (a, b) => a.or(b),
    }
}

/// Limit r6 of the sticking point k with this cone and cap \[Pa\].
pub(crate) fn exit(
    present: &PresentStates<'_>,
    step: &Increments<'_>,
    k: usize,
    Cone { mu, cohesion }: Cone,
    cap: f64,
) -> Option<Limit> {
    let line = Line { at: present.traction[k], change: step.traction[k] };
    let cone = Line { at: cohesion + mu * present.normal[k], change: mu * step.normal[k] };
    let fraction = line.exit(cone, Some(cap))?;
    // Cohesion is left of the strength of a point that opens before it would slip.
    let closed = present.normal[k] + fraction * step.normal[k] >= 0.0;
    (closed || cohesion == 0.0).then_some(Limit { fraction, point: k, kind: LimitKind::StickToSlip })
}

/// True if the traction of point k is its strength \[Pa\].
pub(crate) fn at_strength(present: &PresentStates<'_>, k: usize, strength: f64) -> bool {
    present.traction[k].abs() >= strength * (1.0 - BAND)
}
