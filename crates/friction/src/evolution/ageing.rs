//! Ageing law (Dieterich 1979): dθ/dt = 1 - V θ/L, φ = b ψ with ψ = ln(Vref θ/L), which is the state variable.

use super::{Evolution, Evolved};

/// Below this x the series of [`log_slope`] is exact to rounding (its fifth term is x^7/604800 of the first), and above it
/// the closed form loses two digits at most.
const SMALL: f64 = 2e-2;

/// Above this x the memory of the old state is below rounding in (1 - e^(-x))/x.
const LARGE: f64 = 40.0;

/// Above this ψ_ss - ψ the two terms of dψ/dt differ by more than a factor e, and their difference does not cancel.
const APART: f64 = 1.0;

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

/// d ln m/d ln x of m = (1 - e^(-x))/x, that is x/(e^x - 1) - 1: from 0 at x = 0 to -1.
fn log_slope(x: f64) -> f64 {
    if x < SMALL {
        let y = x * x;
        -0.5 * x + y * (1.0 / 12.0 - y * (1.0 / 720.0 - y / 30_240.0))
    } else if x > LARGE {
        -1.0
    } else {
        x / x.exp_m1() - 1.0
    }
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

    fn rate(&self, state: f64, log_rate: f64) -> f64 {
        // dψ/dt = 1/θ - V/L = (V/L) (e^(ψ_ss - ψ) - 1).
        let (speed, distance) = (log_rate.exp() / self.length, self.steady(log_rate) - state);
        if distance > APART {
            self.v_ref / self.length * (-state).exp() - speed
        } else {
            speed * distance.exp_m1()
        }
    }

    fn step(&self, state: f64, log_rate: f64, dt: f64) -> Evolved {
        // θ = θ_0 e^(-x) + Δt (1 - e^(-x))/x, x = V Δt/L, summed in logarithms so that no power overflows.
        let x = log_rate.exp() * dt / self.length;
        let new = if x > LARGE {
            self.steady(log_rate)
        } else {
            let mean_decay = if x == 0.0 { 1.0 } else { -(-x).exp_m1() / x };
            (self.v_ref * dt / self.length * mean_decay).ln()
        };
        let old = state - x;
        let largest = old.max(new);
        let (weight_old, weight_new) = ((old - largest).exp(), (new - largest).exp());
        let sum = weight_old + weight_new;
        let forgotten = if weight_old == 0.0 { 0.0 } else { x * weight_old };
        Evolved { state: largest + sum.ln(), d_phi: self.b * (weight_new * log_slope(x) - forgotten) / sum }
    }

    fn linear(&self, state: f64, _log_rate: f64, dt: f64) -> (f64, f64) {
        // b Δθ/θ_0 = b (Δt/θ_0 - Δλ/L), 1/θ_0 = (Vref/L) e^(-ψ).
        (self.b * dt * self.v_ref / self.length * (-state).exp(), -self.b / self.length)
    }

    fn weakening(&self, _state: f64, _log_rate: f64) -> f64 {
        // Of the weighted mean in `step`, -x is the old part and -x/2 bounds the new one.
        self.b.max(0.0) / self.length
    }

    fn length(&self) -> Option<f64> {
        Some(self.length)
    }
}
