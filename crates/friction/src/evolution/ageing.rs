//! Ageing law (Dieterich 1979): dθ/dt = 1 - V θ/L and φ = b ψ, with the state variable ψ = ln(Vref θ/L).
//!
//! With a cut-off rate V2 (Okubo 1989) the contribution levels off at high rates: φ = b ln(1 + V2 θ/L).

use super::definition::{Bound, Common, Definition, Front, Parameter, TableEvolution, Unit, Variable};
use super::relaxation::decay;
use super::state::{Evolution, Rate, Speed, StateUpdate};

/// Below this x the series of x/(e^x - 1) - 1 is exact to rounding: its fifth term is x^7/604800 of the first. Above it, the
/// closed form loses two digits at most.
const SMALL: f64 = 2e-2;

/// Above this ψ_ss - ψ the two terms of dψ/dt differ by more than a factor e, and their difference does not cancel.
const APART: f64 = 1.0;

/// Above this y, ln(1 + e^y) = y to rounding.
const LARGE: f64 = 40.0;

/// See the module.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ageing {
    b: f64,
    length: f64,
    v_ref: f64,
    log_v_ref: f64,
    /// ln(V2/Vref), where there is a cut-off.
    cut_off: Option<f64>,
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
            log_v_ref: v_ref.ln(),
            cut_off: None,
        })
    }

    /// Adds the cut-off rate V2 > 0 \[m/s\] of the state effect.
    ///
    /// # Errors
    /// [`crate::Failure::Parameter`].
    pub fn with_cut_off(mut self, v_cut: f64) -> Result<Self, crate::Failure> {
        self.cut_off = Some((crate::positive("v_cut_state", v_cut)? / self.v_ref).ln());
        Ok(self)
    }

    /// Step of the same law without a cut-off and with the clock of θ slowed by `1/(1 + c)`: see [`super::nagata`].
    pub(super) fn slowed(&self, state: f64, dt: f64, c: f64) -> (f64, f64, f64) {
        self.start(state, dt / (1.0 + c))
    }
}

impl TableEvolution for Ageing {
    const DEFINITION: Definition = Definition {
        name: "ageing",
        equation: "dθ/dt = 1 - Vθ/L",
        parameters: &[Parameter {
            key: "v_cut_state",
            unit: Unit::Velocity,
            bound: Bound::Positive,
            optional: true,
            example: "\"1 mm/s\"",
            meaning: "φ = b ln(1 + `v_cut_state` θ/L)",
        }],
        one_state: None,
        memory: None,
        variable: Variable::Logarithm { lengths: 1.0 },
        front: Front::Ageing,
    };

    fn build(p: &Common, own: &[Option<f64>]) -> Result<Self, crate::Failure> {
        let law = Self::new(p.b, p.length, p.v_ref)?;
        own.first().copied().flatten().map_or(Ok(law), |v_cut| law.with_cut_off(v_cut))
    }
}

/// The exact step of ψ, with x = V Δt/L, from `(ψ_0, e^(ψ_0), Vref Δt/L)`: θ = θ_0 e^(-x) + Δt (1 - e^(-x))/x, a sum of
/// positive parts.
fn step(&(old, theta, time): &(f64, f64, f64), x: f64, steady: f64) -> StateUpdate {
    if time == 0.0 {
        return StateUpdate { state: old, d_log_rate: 0.0, curvature: 0.0, d_state: 1.0 };
    }
    let (decay, share) = decay(x);
    if decay == 0.0 {
        return StateUpdate { state: steady, d_log_rate: -1.0, curvature: 0.0, d_state: 0.0 };
    }
    let (mean, slope) = mean_decay(x, decay, share);
    let (kept, fading) = (theta * decay, x * decay);
    let sum = kept + time * mean;
    // d(mean)/dln x = e^(-x) - mean = mean * slope, and its derivative -x e^(-x) - (e^(-x) - mean).
    let first = (time * mean * slope - theta * fading) / sum;
    let second = (-time * (fading + mean * slope) - theta * (1.0 - x) * fading) / sum;
    StateUpdate { state: sum.ln(), d_log_rate: first, curvature: second - first * first, d_state: kept / sum }
}

/// m = (1 - e^(-x))/x and d ln m/d ln x = x/(e^x - 1) - 1, which runs from 0 to -1.
fn mean_decay(x: f64, decay: f64, share: f64) -> (f64, f64) {
    if x < SMALL {
        let y = x * x;
        let mean = if x == 0.0 { 1.0 } else { share / x };
        (mean, -0.5 * x + y * (1.0 / 12.0 - y * (1.0 / 720.0 - y / 30_240.0)))
    } else {
        (share / x, x * decay / share - 1.0)
    }
}

impl Evolution for Ageing {
    const STATES: usize = 1;
    const NAME: &'static str = "rate-and-state, ageing law";
    /// ψ_0, e^(ψ_0) and Vref Δt/L.
    type Start = (f64, f64, f64);

    #[inline]
    fn phi(&self, state: f64) -> f64 {
        match self.cut_off {
            None => self.b * state,
            Some(shift) => {
                let y = state + shift;
                self.b * if y > LARGE { y } else { y.exp().ln_1p() }
            }
        }
    }

    #[inline]
    fn phi_slopes(&self, state: f64) -> (f64, f64) {
        match self.cut_off {
            None => (self.b, 0.0),
            Some(shift) => {
                let share = 1.0 / (1.0 + (-state - shift).exp());
                (self.b * share, self.b * share * (1.0 - share))
            }
        }
    }

    fn per_phi(&self) -> f64 {
        1.0 / self.b
    }

    #[inline]
    fn steady(&self, log_rate: f64) -> f64 {
        self.log_v_ref - log_rate
    }

    #[inline]
    fn rate(&self, state: f64, speed: Speed) -> Rate {
        // dψ/dt = 1/θ - V/L = (V/L) (e^(ψ_ss - ψ) - 1).
        let (frequency, distance) = (speed.rate / self.length, self.steady(speed.log) - state);
        let healing = self.v_ref / self.length * (-state).exp();
        let rate = if distance.abs() > APART { healing - frequency } else { frequency * distance.exp_m1() };
        Rate { rate, d_log_rate: -frequency, d_state: -healing }
    }

    fn start(&self, state: f64, dt: f64) -> (f64, f64, f64) {
        (state, state.exp(), self.v_ref * dt / self.length)
    }

    fn evolve(&self, start: &(f64, f64, f64), speed: Speed) -> StateUpdate {
        step(start, speed.rate / self.v_ref * start.2, self.steady(speed.log))
    }

    fn linear(&self, state: f64, _log_rate: f64, dt: f64) -> (f64, f64) {
        // φ' Δθ/θ_0 = φ' (Δt/θ_0 - Δλ/L), 1/θ_0 = (Vref/L) e^(-ψ).
        let (slope, _) = self.phi_slopes(state);
        (slope * dt * self.v_ref / self.length * (-state).exp(), -slope / self.length)
    }

    fn weakening(&self, _state: f64, _log_rate: f64) -> f64 {
        // Of the weighted mean in `step`, -x is the old part and -x/2 bounds the new one; a cut-off only lowers φ'.
        self.b.max(0.0) / self.length
    }

    fn length(&self) -> Option<f64> {
        Some(self.length)
    }

    fn ageing(&self) -> Option<(f64, f64)> {
        self.cut_off.is_none().then_some((self.b, self.v_ref / self.length))
    }
}
