//! Bonded points: no slip whatever the tractions, no state, and normal tension is carried as well.

use crate::Failure;
use crate::kind::{Kind, TableLaw, values};
use crate::law::{Increments, Law, Limit, PresentStates, RateBounds, Rates, Regime, Responses, Trials};
use crate::yielding::all_finite;

/// See the module.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tied;

impl TableLaw for Tied {
    const KIND: Kind = Kind {
        name: "tied",
        meaning: "a bond: the points neither slip nor separate, and carry tension",
        parameters: &[],
        capped: false,
        order: None,
    };

    fn build(own: &[f64], cap: Option<f64>) -> Result<Self, Failure> {
        let [] = values(own)?;
        match cap {
            None => Ok(Self),
            Some(value) => Err(Failure::Parameter {
                name: "f_limit",
                value,
                admissible: "none: a bond holds any traction",
            }),
        }
    }
}

impl Law for Tied {
    fn name(&self) -> &'static str {
        "tied"
    }

    fn states(&self) -> usize {
        0
    }

    fn has_elastic_domain(&self) -> bool {
        true
    }

    fn bonded(&self) -> bool {
        true
    }

    fn initial(&self, _states: &mut [f64]) {}

    /// Writes 0: there is no friction.
    fn coefficient(
        &self,
        _normal: &[f64],
        _rate: &[f64],
        _states: &[f64],
        mu: &mut [f64],
    ) -> Result<(), Failure> {
        mu.fill(0.0);
        Ok(())
    }

    fn respond(&self, t: Trials<'_>, _old: &[f64], out: Responses<'_>) -> Result<(), Failure> {
        for k in 0..t.trial.len() {
            all_finite(k, t.normal[k], t.trial[k], &[])?;
        }
        out.traction.copy_from_slice(t.trial);
        out.slip.fill(0.0);
        out.rate.fill(0.0);
        out.regime.fill(Regime::Stick);
        out.d_trial.fill(1.0);
        out.d_normal.fill(0.0);
        Ok(())
    }

    fn rates(&self, _present: PresentStates<'_>, out: Rates<'_>) -> Result<(), Failure> {
        out.along.fill(1.0);
        out.coupling.fill(0.0);
        out.constant.fill(0.0);
        Ok(())
    }

    fn limit(
        &self,
        _present: PresentStates<'_>,
        _step: Increments<'_>,
        _bounds: RateBounds,
    ) -> Option<Limit> {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_whole_trial_is_carried_under_tension_too() {
        let (normal, trial) = ([-5.0, 0.0, 7.0], [3.0, 4.0, 1e9]);
        let trials = Trials {
            points: &[0, 1, 2],
            normal: &normal,
            trial: &trial,
            stiffness: 10.0,
            dt: 0.1,
            damping: 0.0,
            lag: None,
            near: None,
        };
        let mut numbers = [[f64::NAN; 3]; 5];
        let [traction, slip, rate, d_trial, d_normal] = &mut numbers;
        let mut regime = [Regime::Slip; 3];
        let regime = &mut regime;
        let out = Responses { traction, slip, rate, regime, d_trial, d_normal, states: &mut [] };
        Tied.respond(trials, &[], out).unwrap();
        assert_eq!(numbers, [trial, [0.0; 3], [0.0; 3], [1.0; 3], [0.0; 3]]);
        assert_eq!(*regime, [Regime::Stick; 3]);
    }

    #[test]
    fn a_trial_that_is_no_number_is_refused() {
        let mut numbers = [[0.0; 1]; 5];
        let [traction, slip, rate, d_trial, d_normal] = &mut numbers;
        let trials = Trials {
            points: &[0],
            normal: &[f64::NAN],
            trial: &[1.0],
            stiffness: 1.0,
            dt: 0.1,
            damping: 0.0,
            lag: None,
            near: None,
        };
        let regime = &mut [Regime::Slip];
        let out = Responses { traction, slip, rate, regime, d_trial, d_normal, states: &mut [] };
        assert!(Tied.respond(trials, &[], out).is_err());
    }
}
