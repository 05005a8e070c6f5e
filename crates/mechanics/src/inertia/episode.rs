//! Passages from states of equilibrium to motion with inertia and back.

use serde::{Deserialize, Serialize};

/// Slip rates between which bodies gain and lose their inertia.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Handover {
    /// Largest slip rate above which they have inertia \[m/s\].
    pub above: f64,
    /// Largest slip rate below which they return to equilibrium \[m/s\].
    pub below: f64,
    /// Largest kinetic energy with which they return, over the largest since they left \[-\].
    pub kinetic: f64,
    /// Time for which the slip rate must have stayed below \[s\].
    pub wait: f64,
}

/// One passage with inertia, and what the hand-overs at both ends leave out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Episode {
    /// Time at which inertia began to act \[s\].
    pub begin: f64,
    /// Time at which it ceased \[s\]; `None` while it acts.
    pub end: Option<f64>,
    /// Accepted steps.
    pub steps: usize,
    /// Forces of inertia in the last state of equilibrium, which it leaves out, over its largest force \[-\].
    pub left_out: f64,
    /// Largest kinetic energy \[J\].
    pub largest: f64,
    /// Energy lost in the return: the kinetic energy, and what forces out of balance do until the first state of equilibrium \[J\].
    pub lost: f64,
}

/// Present motion of bodies with mass.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Regime {
    /// With inertia, since the problem knows no other motion.
    Always,
    /// Through states of equilibrium.
    Equilibrium,
    /// With inertia for the time being; the time since when slip is slow \[s\].
    Inertia {
        /// `None` while slip is fast.
        slow: Option<f64>,
    },
}

impl Regime {
    /// Regime at the start of a run.
    #[must_use]
    pub fn first(handover: Option<&Handover>) -> Self {
        if handover.is_some() { Self::Equilibrium } else { Self::Always }
    }

    /// Regime after a step that ended at `time` with this largest slip rate and this share of the largest kinetic energy.
    #[must_use]
    pub fn next(self, rule: &Handover, time: f64, rate: f64, kinetic: f64) -> Self {
        match self {
            Self::Equilibrium if rate > rule.above => Self::Inertia { slow: None },
            Self::Inertia { .. } if rate >= rule.below => Self::Inertia { slow: None },
            Self::Inertia { slow } => {
                let since = slow.unwrap_or(time);
                let over = time - since >= rule.wait && kinetic <= rule.kinetic;
                if over { Self::Equilibrium } else { Self::Inertia { slow: Some(since) } }
            }
            other => other,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inertia_ceases_when_slip_has_been_slow_for_the_whole_wait() {
        let rule = Handover { above: 1e-3, below: 1e-4, kinetic: 0.1, wait: 2.0 };
        let slow = |since| Regime::Inertia { slow: Some(since) };
        let fast = Regime::Inertia { slow: None };
        let start = Regime::first(Some(&rule));
        assert_eq!(start.next(&rule, 1.0, 9e-4, 0.0), Regime::Equilibrium);
        assert_eq!(start.next(&rule, 1.0, 2e-3, 0.0), fast);
        assert_eq!(fast.next(&rule, 2.0, 5e-5, 0.5), slow(2.0));
        assert_eq!(slow(2.0).next(&rule, 3.0, 2e-4, 0.0), fast);
        assert_eq!(slow(2.0).next(&rule, 3.9, 5e-5, 0.0), slow(2.0));
        assert_eq!(slow(2.0).next(&rule, 4.1, 5e-5, 0.2), slow(2.0));
        assert_eq!(slow(2.0).next(&rule, 4.1, 5e-5, 0.05), Regime::Equilibrium);
        assert_eq!(Regime::first(None).next(&rule, 1.0, 1.0, 0.0), Regime::Always);
    }
}
