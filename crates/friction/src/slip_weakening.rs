//! Linear slip weakening with optional cohesion and cap: `τ ≤ F̄ = min(c + μ(λ) f_n, F_limit)` \[Pa\] with `μ(λ) = μ_s - (μ_s - μ_k)
//! min(λ/d_c, 1)` \[-\], where λ \[m\] is the accumulated slip. It has an elastic domain and no healing. Cohesion c does not weaken, as in
//! the benchmarks TPV10, TPV11 and TPV24 (Harris, R. A. et al. (2009), Seismol. Res. Lett. 80, 119-126).
//!
//! At constant f_n and without a cap, the energy dissipated in excess of the residual strength is the fracture energy `G_c =
//! (μ_s - μ_k) f_n d_c/2` \[J/m²\] of a cohesive zone. Sources: Ida, Y. (1972), Cohesive force across the tip of a
//! longitudinal-shear crack and Griffith's specific surface energy, J. Geophys. Res. 77, 3796-3805; for the strength linear in
//! slip, Andrews, D. J. (1976), Rupture velocity of plane strain shear cracks, J. Geophys. Res. 81, 5679-5687.
//!
//! On the weakening branch the strength changes with slip by `H = -W`, `W = f_n (μ_s - μ_k)/d_c` \[Pa/m\]. Behind a spring
//! E_t > W the balance `|t^e| - E_t Δλ = F̄(λ_0 + Δλ)` has one root. There `∂τ/∂|t^e| = H/(E_t + H)`, which is negative, and
//! `∂τ/∂f_n = κ μ`, κ = E_t/(E_t + H) > 1. A softer spring cannot follow the branch: [`Failure::Unstable`].

use crate::Failure;
use crate::evolution::{Bound, Parameter, Unit};
use crate::kind::{COHESION, Kind, Order, TableLaw, Weakening, values};
use crate::law::{
    BAND, Increments, Law, Limit, LimitKind, PresentStates, RateBounds, Rates, Regime, Responses, Trials,
};
use crate::yielding::{Cone, all_finite, at_strength, cap, exit, rate_of, smaller};

/// See the module.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlipWeakening {
    mu_s: f64,
    mu_k: f64,
    length: f64,
    cohesion: f64,
    limit: f64,
}

/// Strength at some λ and f_n, and its change with further slip.
#[derive(Clone, Copy)]
struct Strength {
    /// F̄ \[Pa\].
    value: f64,
    /// ∂F̄/∂f_n \[-\].
    slope: f64,
    /// W = -∂F̄/∂λ ≥ 0 \[Pa/m\].
    weakening: f64,
}

/// A slipping point after an implicit step.
#[derive(Clone, Copy)]
struct Slide {
    /// Δλ \[m\].
    slip: f64,
    /// λ \[m\].
    total: f64,
    /// Strength at the end, on the branch of the answer.
    strength: Strength,
}

impl SlipWeakening {
    /// Law with μ_s ≥ μ_k ≥ 0 \[-\], d_c > 0 \[m\] and an optional largest shear traction \[Pa\].
    ///
    /// # Errors
    /// [`Failure::Parameter`].
    pub fn new(mu_s: f64, mu_k: f64, d_c: f64, limit: Option<f64>) -> Result<Self, Failure> {
        Self::cohesive(mu_s, mu_k, d_c, 0.0, limit)
    }

    /// Law with a cohesion c ≥ 0 \[Pa\] as well.
    ///
    /// # Errors
    /// [`Failure::Parameter`].
    pub fn cohesive(
        mu_s: f64,
        mu_k: f64,
        d_c: f64,
        cohesion: f64,
        limit: Option<f64>,
    ) -> Result<Self, Failure> {
        if !(mu_s >= 0.0 && mu_s.is_finite()) {
            return Err(Failure::Parameter { name: "mu_s", value: mu_s, admissible: "0 <= mu_s, finite" });
        }
        if !(mu_k >= 0.0 && mu_k <= mu_s) {
            return Err(Failure::Parameter { name: "mu_k", value: mu_k, admissible: "0 <= mu_k <= mu_s" });
        }
        let length = crate::positive("d_c", d_c)?;
        Ok(Self { mu_s, mu_k, length, cohesion: crate::yielding::cohesion(cohesion)?, limit: cap(limit)? })
    }

    /// μ(λ) as a mean of μ_s and μ_k, exact at both ends and without cancellation in between.
    fn mu(&self, slip: f64) -> f64 {
        let gone = (slip / self.length).min(1.0);
        let left = ((self.length - slip) / self.length).max(0.0);
        // A rounded mean of two equal numbers may differ from them.
        (self.mu_s * left + self.mu_k * gone).clamp(self.mu_k, self.mu_s)
    }

    /// c + μ f_n \[Pa\].
    fn cone(&self, mu: f64, normal: f64) -> f64 {
        self.cohesion + mu * normal
    }

    /// W of the weakening branch \[Pa/m\].
    fn weakening(&self, normal: f64) -> f64 {
        normal * ((self.mu_s - self.mu_k) / self.length)
    }

    /// True if further slip has no effect. A point that a forward step has brought to d_c is there to rounding.
    fn weakened(&self, slip: f64) -> bool {
        slip >= self.length * (1.0 - BAND) || self.mu_s == self.mu_k
    }

    /// The strength at λ, with the slopes for further slip.
    fn strength(&self, slip: f64, normal: f64) -> Strength {
        let mu = self.mu(slip);
        let cone = self.cone(mu, normal);
        if cone > self.limit {
            Strength { value: self.limit, slope: 0.0, weakening: 0.0 }
        } else {
            let weakening = if self.weakened(slip) { 0.0 } else { self.weakening(normal) };
            Strength { value: cone, slope: mu, weakening }
        }
    }

    /// Slip at which this share of the weakening is done \[m\].
    pub(crate) fn imposed(&self, share: f64) -> f64 {
        share * self.length
    }

    /// Strength at slip λ \[Pa\].
    pub(crate) fn strength_at(&self, slip: f64, normal: f64) -> f64 {
        self.strength(slip, normal).value
    }

    /// The first root of `E_t Δλ + F̄(λ_0 + Δλ) = |t^e|` for a trial above F̄(λ_0): along the cap, the weakening branch and
    /// the residual strength, each a straight line.
    fn slide(&self, normal: f64, trial: f64, stiffness: f64, old: f64) -> Result<Slide, Failure> {
        let cone = self.cone(self.mu(old), normal);
        if cone > self.limit {
            let slip = (trial - self.limit) / stiffness;
            if self.cone(self.mu(old + slip), normal) >= self.limit {
                let strength = Strength { value: self.limit, slope: 0.0, weakening: 0.0 };
                return Ok(Slide { slip, total: old + slip, strength });
            }
        }
        let weakening = self.weakening(normal);
        if stiffness > weakening && old < self.length {
            // Past the cap, the root lies beyond it except for rounding, which must not reverse the slip.
            let slip = ((trial - cone) / (stiffness - weakening)).max(0.0);
            let total = old + slip;
            if total <= self.length {
                let slope = self.mu(total);
                let value = self.cone(slope, normal).min(self.limit);
                return Ok(Slide { slip, total, strength: Strength { value, slope, weakening } });
            }
        } else if !self.weakened(old) {
            return Err(Failure::Unstable { point: 0, stiffness, weakening });
        }
        let value = self.cone(self.mu_k, normal);
        let slip = (trial - value) / stiffness;
        // This branch is reached only past d_c, whatever the last digit of the sum.
        let total = (old + slip).max(self.length);
        Ok(Slide { slip, total, strength: Strength { value, slope: self.mu_k, weakening: 0.0 } })
    }

    /// The limits of a slipping point: r8, and the kink of the strength at d_c, beyond which nothing depends on slip.
    fn slip_limit(&self, old: f64, slip: f64, point: usize, zeta: f64) -> Option<Limit> {
        if self.weakened(old) {
            return None;
        }
        let admissible = (zeta * self.length).min(self.length - old);
        (slip > admissible).then(|| Limit { fraction: admissible / slip, point, kind: LimitKind::SlipLength })
    }
}

impl TableLaw for SlipWeakening {
    const KIND: Kind = Kind {
        name: "slip-weakening",
        meaning: "the coefficient falls linearly from `mu_s` to `mu_k` over the slip `d_c`",
        parameters: &[
            Parameter {
                key: "mu_s",
                unit: Unit::None,
                bound: Bound::NotNegative,
                optional: false,
                example: "0.6",
                meaning: "",
            },
            Parameter {
                key: "mu_k",
                unit: Unit::None,
                bound: Bound::NotNegative,
                optional: false,
                example: "0.5",
                meaning: "",
            },
            Parameter {
                key: "d_c",
                unit: Unit::Length,
                bound: Bound::Positive,
                optional: false,
                example: "\"0.4 m\"",
                meaning: "",
            },
            COHESION,
        ],
        capped: true,
        order: Some(Order {
            lower: 1,
            upper: 0,
            equal: true,
            help: "0 <= mu_k <= mu_s; `mu_s` is the coefficient before slip",
        }),
    };

    fn build(own: &[f64], cap: Option<f64>) -> Result<Self, Failure> {
        let [mu_s, mu_k, d_c, cohesion] = values(own)?;
        Self::cohesive(mu_s, mu_k, d_c, cohesion, cap)
    }

    fn weakening(own: &[f64]) -> Weakening {
        match *own {
            [mu_s, mu_k, length, _] if mu_s > mu_k => Weakening::Linear { drop: mu_s - mu_k, length },
            _ => Weakening::None,
        }
    }
}

impl Law for SlipWeakening {
    fn name(&self) -> &'static str {
        "slip-weakening"
    }

    fn states(&self) -> usize {
        1
    }

    fn has_elastic_domain(&self) -> bool {
        true
    }

    fn cohesion(&self, _point: usize) -> f64 {
        self.cohesion
    }

    fn initial(&self, states: &mut [f64]) {
        states.fill(0.0);
    }

    fn coefficient(
        &self,
        _normal: &[f64],
        _rate: &[f64],
        states: &[f64],
        mu: &mut [f64],
    ) -> Result<(), Failure> {
        for (mu, &slip) in mu.iter_mut().zip(states) {
            *mu = self.mu(slip);
        }
        Ok(())
    }

    fn respond(&self, t: Trials<'_>, old: &[f64], out: Responses<'_>) -> Result<(), Failure> {
        for k in 0..t.trial.len() {
            let (normal, trial, old) = (t.normal[k], t.trial[k], old[k]);
            all_finite(k, normal, trial, &[old])?;
            if trial <= self.strength(old, normal).value {
                out.regime[k] = Regime::Stick;
                out.traction[k] = trial;
                (out.slip[k], out.rate[k], out.states[k]) = (0.0, 0.0, old);
                (out.d_trial[k], out.d_normal[k]) = (1.0, 0.0);
                continue;
            }
            let Slide { slip, total, strength } =
                self.slide(normal, trial, t.stiffness, old).map_err(|failure| failure.at(k))?;
            all_finite(k, normal, trial, &[slip])?;
            let left = t.stiffness - strength.weakening;
            out.regime[k] = Regime::Slip;
            out.traction[k] = strength.value;
            out.slip[k] = slip;
            out.rate[k] = rate_of(&t, k, slip);
            out.states[k] = total;
            out.d_trial[k] = -strength.weakening / left;
            out.d_normal[k] = t.stiffness / left * strength.slope;
        }
        Ok(())
    }

    fn rates(&self, present: PresentStates<'_>, out: Rates<'_>) -> Result<(), Failure> {
        for k in 0..present.normal.len() {
            let (normal, traction, slip) = (present.normal[k], present.traction[k], present.states[k]);
            all_finite(k, normal, traction, &[slip])?;
            (out.along[k], out.coupling[k], out.constant[k]) = match present.regime[k] {
                Regime::Stick => (1.0, 0.0, 0.0),
                Regime::Slip => {
                    let Strength { value, slope, weakening } = self.strength(slip, normal);
                    let (stiffness, left) = (present.stiffness, present.stiffness - weakening);
                    if left <= 0.0 {
                        return Err(Failure::Unstable { point: k, stiffness, weakening });
                    }
                    let kappa = stiffness / left;
                    (-weakening / left, kappa * slope, kappa * (value - traction))
                }
            };
        }
        Ok(())
    }

    /// Limits r6 of sticking points and r8 of slipping ones. Where a slipping point passes from the cap to the weakening
    /// branch, the step is not cut: r8 bounds the difference, and the next step corrects it.
    fn limit(&self, present: PresentStates<'_>, step: Increments<'_>, bounds: RateBounds) -> Option<Limit> {
        (0..present.normal.len())
            .map(|k| match present.regime[k] {
                Regime::Stick => exit(
                    &present,
                    &step,
                    k,
                    Cone { mu: self.mu(present.states[k]), cohesion: self.cohesion },
                    self.limit,
                ),
                Regime::Slip => self.slip_limit(present.states[k], step.slip[k], k, bounds.zeta),
            })
            .fold(None, smaller)
    }

    fn stands(&self, present: PresentStates<'_>, k: usize) -> bool {
        at_strength(&present, k, self.strength(present.states[k], present.normal[k]).value)
    }
}
