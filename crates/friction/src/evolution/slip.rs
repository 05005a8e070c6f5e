//! Slip law (Ruina 1983): dφ/dt = -(V/L)(φ + b ln(V/Vref)). The state variable is φ itself.

use super::{Evolution, Evolved};

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
}

impl Evolution for Slip {
    const STATES: usize = 1;
    const NAME: &'static str = "rate-and-state, slip law";

    fn phi(&self, state: f64) -> f64 {
        state
    }

    fn steady(&self, log_rate: f64) -> f64 {
        -self.b * (log_rate - self.log_v_ref)
    }

    fn rate(&self, state: f64, log_rate: f64) -> f64 {
        let speed = log_rate.exp() / self.length;
        if speed == 0.0 { 0.0 } else { -speed * (state - self.steady(log_rate)) }
    }

    fn step(&self, state: f64, log_rate: f64, dt: f64) -> Evolved {
        // φ = φ_0 e^(-x) + φ_ss (1 - e^(-x)), x = V Δt/L: a weighted mean, nothing cancels.
        let x = log_rate.exp() * dt / self.length;
        let (decay, share) = ((-x).exp(), -(-x).exp_m1());
        let steady = self.steady(log_rate);
        // A point at rest keeps its state, however far its steady state is.
        let reached = if share == 0.0 { 0.0 } else { steady * share };
        let drift = if decay == 0.0 || x == 0.0 { 0.0 } else { x * decay * (steady - state) };
        Evolved { state: state * decay + reached, d_phi: drift - self.b * share }
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
