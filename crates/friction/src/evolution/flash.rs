//! Slip law towards a strongly weakening steady state (flash heating; Rice 2006, Noda et al. 2009, Dunham et al. 2011): dφ/dt =
//! -(V/L)(φ - φ_ss(V)). The steady state is φ_ss = μ_ss - μ0 - a ln(V/Vref) with μ_ss = μ_w + (μ_lv - μ_w)/[1 +
//! (V/V_w)⁸]^(1/8), μ_lv = μ0 + (a - b) ln(V/Vref).
//!
//! φ_ss is that of the bare logarithm. It differs from that of the regularised strength by a e^(-2μ_ss/a) and exists for every
//! rate. As a direct function of V, such weakening would be ill-posed; as the target of a state that evolves over L, it is not.

use super::definition::{
    Bound, Common, Definition, Front, Parameter, TableEvolution, Unit, Variable, needed,
};
use super::relaxation::{self, SteadyState};
use super::state::{Evolution, Rate, Speed, StateUpdate};

/// Exponent of the transition (Dunham et al. 2011).
const POWER: f64 = 8.0;

/// Parameters of the steady state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weakening {
    /// μ0 \[-\] of the strength.
    pub mu0: f64,
    /// a \[-\] of the strength.
    pub a: f64,
    /// b \[-\].
    pub b: f64,
    /// Vref \[m/s\] > 0.
    pub v_ref: f64,
    /// Fully weakened coefficient μ_w ≥ 0 \[-\].
    pub mu_w: f64,
    /// Rate V_w > 0 at which weakening begins \[m/s\].
    pub v_w: f64,
}

/// See the module.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flash {
    p: Weakening,
    length: f64,
    log_v_ref: f64,
    /// ln V_w at the present temperature.
    log_v_w: f64,
    /// Dependence of V_w on temperature, where there is one.
    contacts: Option<Contacts>,
}

/// Contacts that weaken at T_w: `V_w = V_w(T_f) [(T_w - T)/(T_w - T_f)]²` (Rice 2006), whose factor `(π α/D)
/// (ρ c/τ_c)²` is in V_w(T_f)).
#[derive(Clone, Copy, Debug, PartialEq)]
struct Contacts {
    /// Weakening temperature T_w \[K\].
    weakening: f64,
    /// Temperature T_f of the surface at which V_w is that of the parameters \[K\].
    ambient: f64,
}

impl TableEvolution for Flash {
    const DEFINITION: Definition = Definition {
        name: "flash",
        equation: "slip law towards a steady state weakened by flash heating",
        parameters: &[
            Parameter {
                key: "mu_w",
                unit: Unit::None,
                bound: Bound::BelowReference,
                optional: false,
                example: "0.13",
                meaning: "",
            },
            Parameter {
                key: "v_w",
                unit: Unit::Velocity,
                bound: Bound::Positive,
                optional: false,
                example: "\"0.1 m/s\"",
                meaning: "",
            },
        ],
        one_state: Some("its steady state is that of the whole law"),
        memory: None,
        variable: Variable::Contribution { has_theta: false },
        front: Front::Slip { weakened: Some(0) },
    };

    fn build(p: &Common, own: &[Option<f64>]) -> Result<Self, crate::Failure> {
        let (mu_w, v_w) = (needed(own, 0, "mu_w")?, needed(own, 1, "v_w")?);
        let &Common { mu0, a, v_ref, b, length } = p;
        Self::new(Weakening { mu0, a, b, v_ref, mu_w, v_w }, length)
    }
}

impl Flash {
    /// Law with the steady state and L \[m\] > 0.
    ///
    /// # Errors
    /// [`crate::Failure::Parameter`].
    pub fn new(p: Weakening, length: f64) -> Result<Self, crate::Failure> {
        crate::finite("mu0", p.mu0)?;
        crate::finite("a", p.a)?;
        crate::finite("b", p.b)?;
        if !(p.mu_w >= 0.0 && p.mu_w < p.mu0) {
            let admissible = "0 <= mu_w < mu0";
            return Err(crate::Failure::Parameter { name: "mu_w", value: p.mu_w, admissible });
        }
        Ok(Self {
            p,
            length: crate::positive("l", length)?,
            log_v_ref: crate::positive("v_ref", p.v_ref)?.ln(),
            log_v_w: crate::positive("v_w", p.v_w)?.ln(),
            contacts: None,
        })
    }

    /// φ_ss with its derivatives with respect to ln V.
    fn towards(&self, log_rate: f64) -> SteadyState {
        let p = &self.p;
        let y = log_rate - self.log_v_ref;
        // w = [1 + (V/V_w)⁸]^(-1/8) in logarithms: ln w = -ln(1 + e^u)/8, u = 8 ln(V/V_w).
        let u = POWER * (log_rate - self.log_v_w);
        let softened = if u > 0.0 { u + (-u).exp().ln_1p() } else { u.exp().ln_1p() };
        let w = (-softened / POWER).exp();
        // d ln w/dln V = -q with q = e^u/(1 + e^u), dq/dln V = 8 q (1 - q).
        let q = 1.0 / (1.0 + (-u).exp());
        let above = p.mu0 + (p.a - p.b) * y - p.mu_w;
        let slope = w * ((p.a - p.b) - q * above);
        let bend = w * (-2.0 * q * (p.a - p.b) + (q * q - POWER * q * (1.0 - q)) * above);
        SteadyState { value: p.mu_w + above * w - p.mu0 - p.a * y, slope: slope - p.a, curvature: bend }
    }

    /// μ_ss(V) \[-\].
    #[must_use]
    pub fn steady_coefficient(&self, log_rate: f64) -> f64 {
        self.steady(log_rate) + self.p.mu0 + self.p.a * (log_rate - self.log_v_ref)
    }
}

impl Evolution for Flash {
    const STATES: usize = 1;
    const NAME: &'static str = "rate-and-state, slip law with flash heating";
    /// φ_0 and Δt/L \[s/m\].
    type Start = (f64, f64);

    fn phi(&self, state: f64) -> f64 {
        state
    }

    fn phi_slopes(&self, _state: f64) -> (f64, f64) {
        (1.0, 0.0)
    }

    fn per_phi(&self) -> f64 {
        1.0
    }

    fn steady(&self, log_rate: f64) -> f64 {
        self.towards(log_rate).value
    }

    fn rate(&self, state: f64, speed: Speed) -> Rate {
        relaxation::rate(state, speed, self.length, self.towards(speed.log))
    }

    fn start(&self, state: f64, dt: f64) -> (f64, f64) {
        (state, dt / self.length)
    }

    fn evolve(&self, &(old, per_rate): &(f64, f64), speed: Speed) -> StateUpdate {
        let x = speed.rate * per_rate;
        // At rest the target lies at -∞, and nothing moves towards it.
        if x == 0.0 {
            return StateUpdate { state: old, d_log_rate: 0.0, curvature: 0.0, d_state: 1.0 };
        }
        relaxation::step(old, x, self.towards(speed.log))
    }

    fn linear(&self, state: f64, log_rate: f64, _dt: f64) -> (f64, f64) {
        (0.0, -(state - self.steady(log_rate)) / self.length)
    }

    fn weakening(&self, state: f64, log_rate: f64) -> f64 {
        // As for the slip law, with -dφ_ss/dln V = a (1 - w) + b w + w q (μ_lv - μ_w). Here μ_lv - μ_w takes its largest value
        // over the rates in question: at `log_rate` if a > b, otherwise at V_w, since w q falls as V⁸ below it.
        let p = &self.p;
        let at = |log: f64| (p.mu0 + (p.a - p.b) * (log - self.log_v_ref) - p.mu_w).max(0.0);
        // Below V_w, q ≤ (V/V_w)⁸, and y e^(-8 y) has its maximum 1/(8 e) at y = 1/8.
        let steep = at(log_rate).max(at(self.log_v_w)) + (p.b - p.a).abs() / POWER;
        if p.b < 0.0 {
            return f64::INFINITY;
        }
        ((state - self.steady(log_rate)).max(0.0) + p.a.max(p.b) + steep) / self.length
    }

    fn heat(&mut self, weakening: f64, ambient: f64) -> bool {
        self.contacts = Some(Contacts { weakening, ambient });
        true
    }

    fn warms(&self) -> bool {
        self.contacts.is_some()
    }

    fn warm(&mut self, temperature: f64) {
        if let Some(Contacts { weakening, ambient }) = self.contacts {
            // A surface at T_w has no strong contacts: V_w = 0.
            let share = ((weakening - temperature) / (weakening - ambient)).max(0.0);
            self.log_v_w = self.p.v_w.ln() + 2.0 * share.ln();
        }
    }

    fn length(&self) -> Option<f64> {
        Some(self.length)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::{Evolution, Flash, Weakening};

    fn flash(v_w: f64) -> Flash {
        Flash::new(Weakening { mu0: 0.6, a: 0.01, b: 0.015, v_ref: 1e-6, mu_w: 0.2, v_w }, 1e-2).unwrap()
    }

    #[test]
    fn contacts_of_a_warmer_surface_weaken_at_a_rate_that_falls_with_the_square_of_what_they_lack() {
        let mut law = flash(0.1);
        assert!(law.heat(1200.0, 400.0));
        for (temperature, share) in [(400.0, 1.0), (800.0, 0.25), (1000.0, 0.0625)] {
            law.warm(temperature);
            let wanted = flash(0.1 * share);
            for log_rate in [-20.0, -3.0, -1.0, 1.0] {
                let (found, wanted) = (law.steady_coefficient(log_rate), wanted.steady_coefficient(log_rate));
                assert!((found - wanted).abs() < 1e-13, "{temperature}: {found} {wanted}");
            }
        }
        for temperature in [1200.0, 2000.0] {
            law.warm(temperature);
            assert!((law.steady_coefficient(-18.0) - 0.2).abs() < 1e-13);
        }
    }

    #[test]
    fn without_contacts_temperature_changes_nothing() {
        let mut law = flash(0.1);
        law.warm(1000.0);
        assert!(law == flash(0.1) && !law.warms());
    }
}
