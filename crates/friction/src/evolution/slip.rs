//! Slip law (Ruina 1983): dφ/dt = -(V/L)(φ + b ln(V/Vref)). The state variable is φ itself.

use super::definition::{Common, Definition, Front, TableEvolution, Variable};
use super::relaxation::{self, SteadyState};
use super::state::{Evolution, Rate, Speed, StateUpdate};

/// See the module.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slip {
    b: f64,
    length: f64,
    log_v_ref: f64,
}

impl Slip {
    /// b \[-\], L \[m\] > 0, Vref \[m/s\] > 0.
    ///
    /// # Errors
    /// [`crate::Failure::Parameter`].
    pub fn new(b: f64, length: f64, v_ref: f64) -> Result<Self, crate::Failure> {
        Ok(Self {
            b: crate::finite("b", b)?,
            length: crate::positive("l", length)?,
            log_v_ref: crate::positive("v_ref", v_ref)?.ln(),
        })
    }

    fn towards(&self, log_rate: f64) -> SteadyState {
        SteadyState { value: self.steady(log_rate), slope: -self.b, curvature: 0.0 }
    }
}

impl TableEvolution for Slip {
    const DEFINITION: Definition = Definition {
        name: "slip",
        equation: "dθ/dt = -(Vθ/L) ln(Vθ/L)",
        parameters: &[],
        one_state: None,
        memory: None,
        variable: Variable::Contribution { has_theta: true },
        front: Front::Slip { weakened: None },
    };

    fn build(p: &Common, _: &[Option<f64>]) -> Result<Self, crate::Failure> {
        Self::new(p.b, p.length, p.v_ref)
    }
}

impl Evolution for Slip {
    const STATES: usize = 1;
    const NAME: &'static str = "rate-and-state, slip law";
    /// φ_0 and Δt/L \[s/m\].
    type Start = (f64, f64);

    #[inline]
    fn phi(&self, state: f64) -> f64 {
        state
    }

    #[inline]
    fn phi_slopes(&self, _state: f64) -> (f64, f64) {
        (1.0, 0.0)
    }

    fn per_phi(&self) -> f64 {
        1.0
    }

    #[inline]
    fn steady(&self, log_rate: f64) -> f64 {
        -self.b * (log_rate - self.log_v_ref)
    }

    #[inline]
    fn rate(&self, state: f64, speed: Speed) -> Rate {
        relaxation::rate(state, speed, self.length, self.towards(speed.log))
    }

    fn start(&self, state: f64, dt: f64) -> (f64, f64) {
        (state, dt / self.length)
    }

    fn evolve(&self, &(old, per_rate): &(f64, f64), speed: Speed) -> StateUpdate {
        relaxation::step(old, speed.rate * per_rate, self.towards(speed.log))
    }

    fn linear(&self, state: f64, log_rate: f64, _dt: f64) -> (f64, f64) {
        (0.0, -(state - self.steady(log_rate)) / self.length)
    }

    fn weakening(&self, state: f64, log_rate: f64) -> f64 {
        // -∂φ/∂ln V = x e^(-x) (φ_0 - φ_ss) + b (1 - e^(-x)) ≤ x [max(0, φ_0 - φ_ss) + b], and φ_ss falls with V for b ≥ 0.
        if self.b < 0.0 {
            return f64::INFINITY;
        }
        ((state - self.steady(log_rate)).max(0.0) + self.b) / self.length
    }

    fn length(&self) -> Option<f64> {
        Some(self.length)
    }
}
