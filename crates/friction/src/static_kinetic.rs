//! Static and kinetic friction with an optional cap: an elastic domain whose strength drops once the point slips.
//!
//! A point at rest holds up to F̄_s = min(μ_s f_n, F_limit) \[Pa\]. Once it slips the strength is F̄_k = min(μ_k f_n, F_limit)
//! for as long as it goes on slipping; a step in which it does not slip heals it to F̄_s. One state variable \[-\]: 1 while
//! the point slips, 0 at rest.
//!
//! The drop is a discontinuity in time, of no length and no duration: the work it releases depends on the stiffness behind
//! the point alone, and the traction of a step that starts to slip does not tend to that of the step before as the step
//! shrinks. Slip weakening ([`crate::slip_weakening`]) spreads the drop over a length.

use crate::Failure;
use crate::law::{
    BAND, Increments, Law, Limit, LimitKind, Present, RateBounds, Rates, Regime, Responses, Trials,
};
use crate::line::Line;

/// The state variable of a point that slips.
const SLIPPING: f64 = 1.0;
/// The state variable of a point at rest.
const RESTING: f64 = 0.0;

/// See the module.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StaticKinetic {
    mu_s: f64,
    mu_k: f64,
    limit: f64,
}

impl StaticKinetic {
    /// μ_s > μ_k ≥ 0 \[-\] and an optional largest shear traction \[Pa\].
    ///
    /// # Errors
    /// [`Failure::Parameter`].
    pub fn new(mu_s: f64, mu_k: f64, limit: Option<f64>) -> Result<Self, Failure> {
        let mu_s = crate::positive("mu_s", mu_s)?;
        if !(mu_k >= 0.0 && mu_k < mu_s) {
            return Err(Failure::Parameter { name: "mu_k", value: mu_k, admissible: "0 <= mu_k < mu_s" });
        }
        let limit = match limit {
            Some(value) => crate::positive("f_limit", value)?,
            None => f64::INFINITY,
        };
        Ok(Self { mu_s, mu_k, limit })
    }

    /// μ of a state.
    fn mu(&self, state: f64) -> f64 {
        if state == RESTING { self.mu_s } else { self.mu_k }
    }

    /// Strength F̄ and ∂F̄/∂f_n at a friction coefficient.
    fn strength(&self, mu: f64, normal: f64) -> (f64, f64) {
        let cone = mu * normal;
        if cone <= self.limit { (cone, mu) } else { (self.limit, 0.0) }
    }
}

/// Refuses a point with inputs that are not finite.
pub(crate) fn all_finite(point: usize, normal: f64, trial: f64, others: &[f64]) -> Result<(), Failure> {
    if normal.is_finite() && trial.is_finite() && others.iter().all(|x| x.is_finite()) {
        Ok(())
    } else {
        Err(Failure::NonFinite { point, normal, trial })
    }
}

/// The smaller of two limits; the first of equals.
pub(crate) fn smaller(a: Option<Limit>, b: Option<Limit>) -> Option<Limit> {
    match (a, b) {
        (Some(a), Some(b)) => Some(if b.fraction < a.fraction { b } else { a }),
        (a, b) => a.or(b),
    }
}

/// Limit r6 of the sticking point k with friction coefficient μ and cap \[Pa\].
pub(crate) fn exit(
    present: &Present<'_>,
    step: &Increments<'_>,
    k: usize,
    mu: f64,
    cap: f64,
) -> Option<Limit> {
    let line = Line { at: present.traction[k], change: step.traction[k] };
    let cone = Line { at: mu * present.normal[k], change: mu * step.normal[k] };
    let fraction = line.exit(cone, Some(cap))?;
    Some(Limit { fraction, point: k, kind: LimitKind::StickToSlip })
}

/// Regime after an accepted forward step over which the strength ends at `strength` \[Pa\]: a sticking point slips from the
/// surface on, a slipping one sticks when its slip reverses.
pub(crate) fn next_regime(present: &Present<'_>, step: &Increments<'_>, k: usize, strength: f64) -> Regime {
    let slipping = match present.regime[k] {
        Regime::Stick => (present.traction[k] + step.traction[k]).abs() >= strength * (1.0 - BAND),
        Regime::Slip => step.slip[k] > 0.0,
    };
    if slipping { Regime::Slip } else { Regime::Stick }
}

impl Law for StaticKinetic {
    fn name(&self) -> &'static str {
        "static-kinetic"
    }

    fn states(&self) -> usize {
        1
    }

    fn has_elastic_domain(&self) -> bool {
        true
    }

    fn initial(&self, states: &mut [f64]) {
        states.fill(RESTING);
    }

    fn coefficient(
        &self,
        _normal: &[f64],
        _rate: &[f64],
        states: &[f64],
        mu: &mut [f64],
    ) -> Result<(), Failure> {
        for (mu, &state) in mu.iter_mut().zip(states) {
            *mu = self.mu(state);
        }
        Ok(())
    }

    fn respond(&self, t: Trials<'_>, old: &[f64], out: Responses<'_>) -> Result<(), Failure> {
        for (k, &old) in old.iter().enumerate() {
            let (normal, trial) = (t.normal[k], t.trial[k]);
            all_finite(k, normal, trial, &[old])?;
            let stick = trial <= self.strength(self.mu(old), normal).0;
            // No more than the strength just exceeded: the slip is not negative.
            let (strength, slope) = self.strength(self.mu_k, normal);
            out.regime[k] = if stick { Regime::Stick } else { Regime::Slip };
            out.traction[k] = if stick { trial } else { strength };
            out.slip[k] = if stick { 0.0 } else { (trial - strength) / t.stiffness };
            out.d_trial[k] = if stick { 1.0 } else { 0.0 };
            out.d_normal[k] = if stick { 0.0 } else { slope };
            let (weight, offset) = t.lag.map_or((1.0, 0.0), |lag| (lag.weight, lag.offset[k]));
            out.rate[k] = if stick { 0.0 } else { weight * out.slip[k] / t.dt - offset };
            out.states[k] = if stick { RESTING } else { SLIPPING };
        }
        Ok(())
    }

    /// In slip the constant is the residual, where it is carried. A point that has just left rest takes the drop F̄_k - F̄_s
    /// over the step in any case: that is the law, not an error of the steps before.
    fn rates(&self, present: Present<'_>, out: Rates<'_>) -> Result<(), Failure> {
        for k in 0..present.normal.len() {
            let (normal, traction) = (present.normal[k], present.traction[k]);
            all_finite(k, normal, traction, &[])?;
            (out.along[k], out.coupling[k], out.constant[k]) = match present.regime[k] {
                Regime::Stick => (1.0, 0.0, 0.0),
                Regime::Slip => {
                    let (strength, slope) = self.strength(self.mu_k, normal);
                    let constant = if present.carry {
                        strength - traction
                    } else if present.rate[k] == 0.0 {
                        strength - self.strength(self.mu_s, normal).0
                    } else {
                        0.0
                    };
                    (0.0, slope, constant)
                }
            };
        }
        Ok(())
    }

    fn limit(&self, present: Present<'_>, step: Increments<'_>, _bounds: RateBounds) -> Option<Limit> {
        (0..present.normal.len())
            .filter(|&k| present.regime[k] == Regime::Stick)
            .map(|k| exit(&present, &step, k, self.mu(present.states[k]), self.limit))
            .fold(None, smaller)
    }

    fn advance(
        &self,
        present: Present<'_>,
        step: Increments<'_>,
        regime: &mut [Regime],
        rate: &mut [f64],
        states: &mut [f64],
    ) -> Result<(), Failure> {
        for k in 0..present.normal.len() {
            let (normal, traction) =
                (present.normal[k] + step.normal[k], present.traction[k] + step.traction[k]);
            all_finite(k, normal, traction, &[step.slip[k], present.states[k]])?;
            let (strength, _) = self.strength(self.mu(present.states[k]), normal);
            regime[k] = next_regime(&present, &step, k, strength);
            rate[k] =
                if present.regime[k] == Regime::Slip { (step.slip[k] / present.dt).max(0.0) } else { 0.0 };
            states[k] = if regime[k] == Regime::Slip { SLIPPING } else { RESTING };
        }
        Ok(())
    }
}
