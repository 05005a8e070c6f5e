//! Slip rate at which states evolve over a step whose slip is found by two-step differences.
//!
//! The slip of the step is Δλ, so that its mean rate is `Λ = Δλ/Δt = (V + offset)/weight`, linear in the rate V at its end. A state whose
//! exact step is taken at Λ receives the true slip, and where V changes linearly its error is of third order in Δt. Over many L, the state
//! forgets all but the end of the step. With `x = V Δt/L`, the weight of Λ in the evolution rate is then `g = 2 [1/x - 1/(e^x - 1)]`. This
//! makes the step exact to first order in the change of V for every x, and a steady state follows V without delay.

use crate::evolution::{AT_REST, Speed};

/// Below this x the series of g is exact to rounding: its next term is x^5/15120.
const SMALL: f64 = 1e-2;
/// Above this x, e^x is effectively infinite in g.
const LARGE: f64 = 40.0;

/// A two-step difference: `V = weight Δλ/Δt - offset`, with V > 0 at the end of the step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pace {
    pub weight: f64,
    /// \[m/s\].
    pub offset: f64,
}

impl Pace {
    /// `None` for backward Euler, and where slip reverses within the step: its states evolve at the rate of its end.
    pub(crate) fn new(weight: f64, offset: f64) -> Option<Self> {
        (weight > 1.0 && offset > 0.0).then_some(Self { weight, offset })
    }

    /// Evolution rate of a state of characteristic slip `length` \[m\].
    pub(crate) fn rate(self, length: Option<f64>, dt: f64) -> LinearRate {
        // The mean rate of the step before gives x; only the weight depends on x, and only to second order.
        let before = self.offset / (self.weight - 1.0);
        let g = length.map_or(1.0, |l| share(before * dt / l));
        LinearRate { slope: 1.0 - g + g / self.weight, constant: g * self.offset / self.weight }
    }
}

/// g(x), which runs from 1 to 2/x.
fn share(x: f64) -> f64 {
    if x < SMALL {
        1.0 - x / 6.0 * (1.0 - x * x / 60.0)
    } else if x < LARGE {
        2.0 * (1.0 / x - 1.0 / x.exp_m1())
    } else {
        2.0 / x
    }
}

/// A rate that is linear in V: `slope V + constant`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LinearRate {
    pub slope: f64,
    /// \[m/s\].
    pub constant: f64,
}

impl LinearRate {
    /// V itself.
    pub(crate) const SAME: Self = Self { slope: 1.0, constant: 0.0 };

    /// The rate, with its derivative by V in logarithms.
    pub(crate) fn at(self, speed: Speed) -> (Speed, f64) {
        if self == Self::SAME {
            return (speed, 1.0);
        }
        let own = self.slope * speed.rate;
        let rate = own + self.constant;
        let log = if rate > 0.0 { rate.ln() } else { AT_REST };
        (Speed { rate, log }, if rate > 0.0 { own / rate } else { 1.0 })
    }
}

/// A step with its mean rate and the change of V over it \[m/s\], for V linear in time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Halves {
    pub mean: f64,
    pub change: f64,
}

impl Halves {
    /// Rates of the two halves of the step, for a state of characteristic slip `length` \[m\].
    pub(crate) fn rates(self, length: Option<f64>, dt: f64) -> [Speed; 2] {
        let Self { mean, change } = self;
        let g = length.map_or(1.0, |l| share(0.5 * mean * dt / l));
        [mean, mean + 0.5 * change].map(|end| {
            let rate = (end - 0.25 * g * change).max(0.0);
            Speed { rate, log: if rate > 0.0 { rate.ln() } else { AT_REST } }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_share_is_continuous_and_falls() {
        let mut before = 1.0;
        for power in -80..=30 {
            let x = 10f64.powf(0.1 * f64::from(power));
            let g = share(x);
            assert!(g <= before && g > 0.0, "{x}: {g} after {before}");
            before = g;
        }
        for x in [SMALL, LARGE] {
            let [below, above] = [1.0 - 1e-12, 1.0 + 1e-12].map(|f| share(x * f));
            assert!((below / above - 1.0).abs() < 1e-9, "{x}: {below} {above}");
        }
    }

    #[test]
    fn a_rate_that_does_not_change_is_that_of_the_states() {
        // Three equal steps at V: weight 3/2, offset V/2.
        let v = 3e-6;
        for length in [None, Some(1e-9), Some(1e-5), Some(1.0)] {
            let (speed, _) = Pace::new(1.5, 0.5 * v).unwrap().rate(length, 2.0).at(Speed::from_log(v.ln()));
            assert!((speed.rate / v - 1.0).abs() < 1e-14, "{length:?}: {}", speed.rate);
        }
    }
}
