//! Static and kinetic friction with an optional cap: an elastic domain whose strength drops once the point slips.
//!
//! A point at rest holds up to F̄_s = min(μ_s f_n, F_limit) \[Pa\]. Once it slips, the strength is F̄_k = min(μ_k f_n, F_limit)
//! for as long as it keeps slipping; a step in which it does not slip heals it to F̄_s. One state variable \[-\]: 1 while the
//! point slips, 0 at rest.
//!
//! The drop is a discontinuity in time, without a length or a duration. The energy that it releases depends on the stiffness
//! behind the point alone. The traction of a step that starts to slip does not tend to that of the step before as the step
//! shrinks. Slip weakening ([`crate::slip_weakening`]) spreads the drop over a length.

use crate::Failure;
use crate::evolution::{Bound, Parameter, Unit};
use crate::kind::{Kind, Order, TableLaw, Weakening, values};
use crate::law::{Increments, Law, Limit, PresentStates, RateBounds, Rates, Regime, Responses, Trials};
use crate::yielding::{Cone, ConeStrength, all_finite, answer, at_strength, cap, first_exit, strength};

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
    /// Law with μ_s > μ_k ≥ 0 \[-\] and an optional largest shear traction \[Pa\].
    ///
    /// # Errors
    /// [`Failure::Parameter`].
    pub fn new(mu_s: f64, mu_k: f64, limit: Option<f64>) -> Result<Self, Failure> {
        let mu_s = crate::positive("mu_s", mu_s)?;
        if !(mu_k >= 0.0 && mu_k < mu_s) {
            return Err(Failure::Parameter { name: "mu_k", value: mu_k, admissible: "0 <= mu_k < mu_s" });
        }
        Ok(Self { mu_s, mu_k, limit: cap(limit)? })
    }

    /// μ of a state.
    fn mu(&self, state: f64) -> f64 {
        if state == RESTING { self.mu_s } else { self.mu_k }
    }

    /// Strength in a state, and of a point that slips \[Pa\].
    pub(crate) fn strengths(&self, state: f64, normal: f64) -> (f64, f64) {
        (self.strength(self.mu(state), normal).value, self.strength(self.mu_k, normal).value)
    }

    /// State of a point that slips, or rests.
    pub(crate) fn state_at(slips: bool) -> f64 {
        if slips { SLIPPING } else { RESTING }
    }

    /// Strength at a friction coefficient.
    fn strength(&self, mu: f64, normal: f64) -> ConeStrength {
        strength(Cone { mu, cohesion: 0.0 }, normal, self.limit)
    }
}

impl TableLaw for StaticKinetic {
    const KIND: Kind = Kind {
        name: "static-kinetic",
        meaning: "the coefficient drops from `mu_s` to `mu_k` where slip begins",
        parameters: &[
            Parameter {
                key: "mu_s",
                unit: Unit::None,
                bound: Bound::Positive,
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
        ],
        capped: true,
        order: Some(Order {
            lower: 1,
            upper: 0,
            equal: false,
            help: "0 <= mu_k < mu_s; for a constant coefficient use `kind = \"coulomb\"`",
        }),
    };

    fn build(own: &[f64], cap: Option<f64>) -> Result<Self, Failure> {
        let [mu_s, mu_k] = values(own)?;
        Self::new(mu_s, mu_k, cap)
    }

    fn weakening(_: &[f64]) -> Weakening {
        Weakening::Drop
    }
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

    fn respond(&self, t: Trials<'_>, old: &[f64], mut out: Responses<'_>) -> Result<(), Failure> {
        for (k, &old) in old.iter().enumerate() {
            let normal = t.normal[k];
            all_finite(k, normal, t.trial[k], &[old])?;
            // The kinetic strength does not exceed the one just reached: the slip is not negative.
            let held = self.strength(self.mu(old), normal).value;
            let stick = answer(&t, k, held, self.strength(self.mu_k, normal), &mut out);
            out.states[k] = if stick { RESTING } else { SLIPPING };
        }
        Ok(())
    }

    /// Linearises the law; a point that leaves rest takes the drop F̄_k - F̄_s over the step.
    fn rates(&self, present: PresentStates<'_>, out: Rates<'_>) -> Result<(), Failure> {
        for k in 0..present.normal.len() {
            let (normal, traction) = (present.normal[k], present.traction[k]);
            all_finite(k, normal, traction, &[])?;
            (out.along[k], out.coupling[k], out.constant[k]) = match present.regime[k] {
                Regime::Stick => (1.0, 0.0, 0.0),
                Regime::Slip => {
                    let ConeStrength { value: strength, slope } = self.strength(self.mu_k, normal);
                    (0.0, slope, strength - traction)
                }
            };
        }
        Ok(())
    }

    fn limit(&self, present: PresentStates<'_>, step: Increments<'_>, _bounds: RateBounds) -> Option<Limit> {
        first_exit(&present, &step, |k| Cone { mu: self.mu(present.states[k]), cohesion: 0.0 }, self.limit)
    }

    fn stands(&self, present: PresentStates<'_>, k: usize) -> bool {
        at_strength(&present, k, self.strength(self.mu(present.states[k]), present.normal[k]).value)
    }
}
