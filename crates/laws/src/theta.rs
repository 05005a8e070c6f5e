//! The state θ of friction laws with one state variable.

use asperity_friction::evolution;
use asperity_scene::law::LawChoice;
use std::f64::consts::LN_10;

/// Relation of the state variable s of a law to θ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Theta {
    /// θ where s is 0 \[s\].
    time: f64,
    /// d ln θ/ds.
    per: f64,
    /// Steady θ times the slip rate: L, and 2 L with the PRZ law \[m\].
    reach: f64,
}

impl Theta {
    /// θ of a law, if it has one.
    #[must_use]
    pub fn from_law(law: &LawChoice) -> Option<Self> {
        let LawChoice::RateAndState { strength, evolution, states, .. } = law else { return None };
        let [state] = states.as_slice() else { return None };
        let variable = evolution::definition(evolution.name)?.variable;
        let (time, per) = variable.theta(state.b, state.l, strength.v_ref)?;
        Some(Self { time, per, reach: time * strength.v_ref })
    }

    /// log10 of θ over 1 s.
    #[must_use]
    pub fn log10(&self, state: f64) -> f64 {
        let (at_zero, slope) = self.linear();
        at_zero + slope * state
    }

    /// State variable of a θ \[s\].
    #[must_use]
    pub fn variable(&self, theta: f64) -> f64 {
        (theta / self.time).ln() / self.per
    }

    /// log10 of θ where the state variable is 0, and per state variable.
    #[must_use]
    pub fn linear(&self) -> (f64, f64) {
        (self.time.log10(), self.per / LN_10)
    }

    /// log10 of θ in steady state at 1 m/s.
    #[must_use]
    pub fn steady(&self) -> f64 {
        self.reach.log10()
    }
}
