//! Ageing law (Dieterich 1979): dθ/dt = 1 - V θ/L, φ = b ψ with ψ = ln(Vref θ/L), which is the state variable.

use super::{Evolution, Evolved};

/// Below this x the series of [`slope`] is exact to rounding (its sixth term is x^6/840 of the first).
const SMALL: f64 = 1e-2;

/// See the module.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ageing {
    b: f64,
    length: f64,
    v_ref: f64,
}

impl Ageing {
    /// b \[-\], L \[m\] > 0, Vref \[m/s\] > 0.
    ///
    /// # Errors
    /// [`crate::Failure::Parameter`].
    pub fn new(b: f64, length: f64, v_ref: f64) -> Result<Self, crate::Failure> {
        Ok(Self {
            b: crate::finite("b", b)?,
            length: crate::positive("l", length)?,
            v_ref: crate::positive("v_ref", v_ref)?,
        })
    }
}

/// x d/dx [(1 - e^(-x))/x] = e^(-x) - (1 - e^(-x))/x.
fn slope(x: f64) -> f64 {
    if x < SMALL {
        x * (-1.0 / 2.0 + x * (1.0 / 3.0 + x * (-1.0 / 8.0 + x * (1.0 / 30.0 - x / 144.0))))
    } else {
        (-x).exp() + (-x).exp_m1() / x
    }
}

/// (1 - e^(-x))/x, 1 at x = 0.
fn mean_decay(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { -(-x).exp_m1() / x }
}

impl Evolution for Ageing {
    const STATES: usize = 1;
    const NAME: &'static str = "rate-and-state, ageing law";

    fn phi(&self, state: f64) -> f64 {
        self.b * state
    }

    fn steady(&self, log_rate: f64) -> f64 {
        self.v_ref.ln() - log_rate
    }

    fn step(&self, state: f64, log_rate: f64, dt: f64) -> Evolved {
        // θ = θ_0 e^(-x) + Δt (1 - e^(-x))/x, x = V Δt/L, summed in logarithms so that no power overflows.
        let x = log_rate.exp() * dt / self.length;
        let old = state - x;
        let new = (self.v_ref * dt / self.length * mean_decay(x)).ln();
        let largest = old.max(new);
        let (weight_old, weight_new) = ((old - largest).exp(), (new - largest).exp());
        let sum = weight_old + weight_new;
        let change = -x * weight_old + weight_new * slope(x) / mean_decay(x);
        Evolved { state: largest + sum.ln(), d_phi: self.b * change / sum }
    }

    fn linear(&self, state: f64, _log_rate: f64, dt: f64) -> (f64, f64) {
        // b Δθ/θ_0 = b (Δt/θ_0 - Δλ/L), 1/θ_0 = (Vref/L) e^(-ψ).
        (self.b * dt * self.v_ref / self.length * (-state).exp(), -self.b / self.length)
    }

    fn length(&self) -> Option<f64> {
        Some(self.length)
    }
}
