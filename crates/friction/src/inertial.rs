//! Friction between two surfaces with mass, for explicit steps in time.
//!
//! Over a step the two masses at a point resist slip like a dashpot: the shear traction is `τ = T - Z V`, with T the traction that brings the
//! point to rest and Z = 1/(Δt' A (1/m⁺ + 1/m⁻)) \[Pa s/m\]. Laws with an elastic domain balance their strength at the next half step
//! (Δt' = Δt; traction at split nodes, Day et al. 2005), so that a point at rest has no slip rate left. Rate laws balance it at the
//! step itself (Δt' = Δt/2). Their states live at half steps: one passes half a step to the balance and another half step after it,
//! at the slip rate found there, which is of second order. Sources: Day, S. M., Dalguer, L. A., Lapusta, N. & Liu, Y. (2005), J. Geophys.
//! Res. 110, B12307; Kaneko, Y., Lapusta, N. & Ampuero, J.-P. (2008), J. Geophys. Res. 113, B09317.

use crate::Failure;
use crate::coulomb::Coulomb;
use crate::evolution::{AT_REST, Evolution};
use crate::law::{Law, Trials};
use crate::rate::RateLaw;
use crate::slider::SliderLaw as _;
use crate::slip_weakening::SlipWeakening;
use crate::static_kinetic::StaticKinetic;
use crate::strength::Form;

/// Drive of a point over a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Push {
    /// f_n ≥ 0 \[Pa\].
    pub normal: f64,
    /// Magnitude of the traction that brings the point to rest, T ≥ 0 \[Pa\].
    pub trial: f64,
    /// Z > 0 \[Pa s/m\].
    pub impedance: f64,
    /// Slip rate near the answer \[m/s\]; 0 if none is known.
    pub near: f64,
    /// Δt \[s\].
    pub dt: f64,
    /// Share of its slip weakening that is imposed on the point, whatever its slip; 0 where none is \[-\].
    pub weakened: f64,
}

/// Answer of a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointBalance {
    /// Shear traction τ, between 0 and T \[Pa\].
    pub traction: f64,
    /// Slip rate V ≥ 0 \[m/s\].
    pub rate: f64,
}

/// Sliding of a point at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sliding {
    /// Slip rate V > 0 \[m/s\].
    pub rate: f64,
    /// Friction coefficient μ \[-\].
    pub friction: f64,
}

/// A law between surfaces with mass.
pub trait Inertial: Law {
    /// Balances a point and advances its states by a step.
    ///
    /// # Errors
    /// [`Failure`] of the point 0.
    fn push(&self, push: &Push, states: &mut [f64]) -> Result<PointBalance, Failure>;

    /// Writes the states at the start; those of a point that slides agree with its friction.
    ///
    /// # Errors
    /// [`Failure`] where no state gives this coefficient.
    fn start(&self, _sliding: Option<Sliding>, states: &mut [f64]) -> Result<(), Failure> {
        self.initial(states);
        Ok(())
    }
}

/// Laws of the points of a fault between bodies with mass.
pub trait InertialFault: Send + Sync + std::fmt::Debug {
    /// Number of points.
    fn points(&self) -> usize;

    /// State variables of a point.
    fn states(&self) -> usize;

    /// True if the laws have an elastic domain.
    fn has_elastic_domain(&self) -> bool;

    /// Writes the states of a point at the start, as [`Inertial::start`].
    ///
    /// # Errors
    /// [`Failure`] with the number of the point.
    fn start(&self, point: usize, sliding: Option<Sliding>, states: &mut [f64]) -> Result<(), Failure>;

    /// Balances a point and advances its states by a step, as [`Inertial::push`].
    ///
    /// # Errors
    /// [`Failure`] with the number of the point.
    fn push(&self, point: usize, push: &Push, states: &mut [f64]) -> Result<PointBalance, Failure>;
}

/// One law for each point, all of one kind.
#[derive(Clone, Debug)]
pub struct InertialPoints<L>(pub Vec<L>);

impl<L: Inertial> InertialFault for InertialPoints<L> {
    fn points(&self) -> usize {
        self.0.len()
    }

    fn states(&self) -> usize {
        self.0.first().map_or(0, Law::states)
    }

    fn has_elastic_domain(&self) -> bool {
        self.0.first().is_some_and(Law::has_elastic_domain)
    }

    fn start(&self, point: usize, sliding: Option<Sliding>, states: &mut [f64]) -> Result<(), Failure> {
        self.0[point].start(sliding, states).map_err(|f| f.at(point))
    }

    fn push(&self, point: usize, push: &Push, states: &mut [f64]) -> Result<PointBalance, Failure> {
        self.0[point].push(push, states).map_err(|f| f.at(point))
    }
}

impl<F: Form, E: Evolution> Inertial for RateLaw<F, E> {
    fn push(&self, push: &Push, states: &mut [f64]) -> Result<PointBalance, Failure> {
        let half = 0.5 * push.dt;
        let trials = Trials {
            points: &[0],
            normal: &[push.normal],
            trial: &[push.trial],
            stiffness: push.impedance / half,
            dt: half,
            damping: 0.0,
            lag: None,
            near: Some(&[push.near]),
        };
        self.balance_twice(&trials, states)
    }

    fn start(&self, sliding: Option<Sliding>, states: &mut [f64]) -> Result<(), Failure> {
        self.initial(states);
        match sliding {
            Some(Sliding { rate, friction }) if !states.is_empty() => self.states_for(rate, friction, states),
            _ => Ok(()),
        }
    }
}

impl<F: Form, E: Evolution> RateLaw<F, E> {
    /// Balances a point at the end of a step and passes another step at the slip rate found.
    fn balance_twice(&self, trials: &Trials<'_>, states: &mut [f64]) -> Result<PointBalance, Failure> {
        let mut solver = self.solver();
        let (traction, rate, mu) = self.balanced(trials, states, &mut solver)?;
        let mut there = [0.0; MOST];
        let there = &mut there[..states.len()];
        solver.keep(states, mu, there);
        let log_rate = if rate > 0.0 { rate.ln() } else { AT_REST };
        solver.set_pace(None);
        let after = solver.after(there, trials.normal[0], trials.dt, log_rate);
        solver.keep(there, if rate > 0.0 { after.mu } else { 0.0 }, states);
        Ok(PointBalance { traction, rate })
    }
}

/// Largest number of state variables of a law, as for sliders.
const MOST: usize = 15;

impl Inertial for Coulomb {
    fn push(&self, push: &Push, _states: &mut [f64]) -> Result<PointBalance, Failure> {
        finite(push)?;
        Ok(held(push, pressed(push, self.strength(push.normal).value)))
    }
}

impl Inertial for StaticKinetic {
    fn push(&self, push: &Push, states: &mut [f64]) -> Result<PointBalance, Failure> {
        finite(push)?;
        let (held_by, sliding) = self.strengths(states[0], push.normal);
        let answer = if push.trial <= held_by { held(push, held_by) } else { held(push, sliding) };
        states[0] = Self::state_at(answer.rate > 0.0);
        Ok(answer)
    }
}

impl Inertial for SlipWeakening {
    /// The strength is that of the slip reached, or of the slip that is imposed; the slip of the step weakens the next.
    fn push(&self, push: &Push, states: &mut [f64]) -> Result<PointBalance, Failure> {
        finite(push)?;
        let imposed = self.imposed(push.weakened);
        let answer = held(push, pressed(push, self.strength_at(states[0].max(imposed), push.normal)));
        states[0] += answer.rate * push.dt;
        Ok(answer)
    }
}

/// The strength of a point whose sides press on each other, otherwise none: cohesion does not hold sides that part \[Pa\].
fn pressed(push: &Push, strength: f64) -> f64 {
    if push.normal > 0.0 { strength } else { 0.0 }
}

/// The answer of a point that carries at most `strength` \[Pa\].
fn held(push: &Push, strength: f64) -> PointBalance {
    let traction = push.trial.min(strength);
    PointBalance { traction, rate: (push.trial - traction) / push.impedance }
}

/// Refuses a point with inputs that are not finite.
fn finite(push: &Push) -> Result<(), Failure> {
    let Push { normal, trial, .. } = *push;
    if normal.is_finite() && trial.is_finite() {
        Ok(())
    } else {
        Err(Failure::NonFinite { point: 0, normal, trial })
    }
}

#[cfg(test)]
mod tests {
    use super::{Inertial as _, InertialFault as _, InertialPoints, PointBalance, Push, Sliding};
    use crate::coulomb::Coulomb;
    use crate::evolution::ageing::Ageing;
    use crate::law::Law as _;
    use crate::rate::RateLaw;
    use crate::slip_weakening::SlipWeakening;
    use crate::static_kinetic::StaticKinetic;
    use crate::strength::{Parameters, regularised::Regularised};

    fn ageing() -> RateLaw<Regularised, Ageing> {
        let form = Regularised(Parameters::new(0.6, 0.008, 1e-6).unwrap());
        RateLaw::new(form, Ageing::new(0.012, 0.02, 1e-6).unwrap(), 1e-3, None).unwrap()
    }

    /// Drives a point with masses by a traction that grows steadily, in `n` steps; returns slip rate and state at the end.
    fn driven(n: usize) -> (f64, f64) {
        let (law, duration, impedance) = (ageing(), 2.0, 8e6);
        let dt = duration / n as f64;
        let mut states = [0.0];
        law.start(None, &mut states).unwrap();
        // The states pass the first half step at the rate of the start.
        let first = Push { normal: 120e6, trial: 0.0, impedance, near: 0.0, dt: 0.5 * dt, weakened: 0.0 };
        let trial = |t: f64| 72.5e6 + 8e6 * t;
        law.push(&Push { trial: trial(0.0), ..first }, &mut states).unwrap();
        let mut answer = PointBalance { traction: 0.0, rate: 0.0 };
        for k in 1..=n {
            let push = Push { trial: trial(k as f64 * dt), near: answer.rate, dt, ..first };
            answer = law.push(&push, &mut states).unwrap();
        }
        (answer.rate, states[0])
    }

    #[test]
    fn balances_of_rate_laws_are_of_second_order() {
        let fine = driven(51_200).0;
        let errors: Vec<f64> = [800, 1600, 3200, 6400].map(|n| (driven(n).0 / fine - 1.0).abs()).to_vec();
        for w in errors.windows(2) {
            let order = (w[0] / w[1]).log2();
            assert!((order - 2.0).abs() < 0.15, "{errors:?}");
        }
    }

    #[test]
    fn tractions_of_rate_laws_are_friction_plus_the_share_of_the_masses() {
        let law = ageing();
        let mut states = [0.0];
        law.start(Some(Sliding { rate: 1e-12, friction: 75.0 / 120.0 }), &mut states).unwrap();
        let push = Push { normal: 120e6, trial: 75e6, impedance: 4e6, near: 0.0, dt: 1e-2, weakened: 0.0 };
        let answer = law.push(&push, &mut states.clone()).unwrap();
        assert!((answer.rate / 1e-12 - 1.0).abs() < 1e-6, "{answer:?}");
        assert!((answer.traction + push.impedance * answer.rate - 75e6).abs() < 1e-6);
        let mut mu = [0.0];
        let balance = law.push(&Push { trial: 100e6, ..push }, &mut states).unwrap();
        law.coefficient(&[120e6], &[balance.rate], &states, &mut mu).unwrap();
        // The states have passed another half step since.
        assert!((balance.traction / (120e6 * mu[0]) - 1.0).abs() < 0.01, "{balance:?} {mu:?}");
    }

    #[test]
    fn slip_weakens_the_next_step_and_points_below_their_strength_rest() {
        let law = InertialPoints(vec![SlipWeakening::new(0.677, 0.525, 0.4, None).unwrap(); 2]);
        let push = |trial| Push { normal: 120e6, trial, impedance: 4e6, near: 0.0, dt: 0.01, weakened: 0.0 };
        let (mut at_rest, mut sliding) = ([0.0], [0.2]);
        let held = law.push(0, &push(81e6), &mut at_rest).unwrap();
        assert_eq!(held, PointBalance { traction: 81e6, rate: 0.0 });
        let answer = law.push(1, &push(81e6), &mut sliding).unwrap();
        let strength = 120e6 * 0.601;
        assert!((answer.traction / strength - 1.0).abs() < 1e-14);
        assert!((sliding[0] - 0.2 - (81e6 - strength) / 4e6 * 0.01).abs() < 1e-14);
    }

    #[test]
    fn imposed_weakening_lowers_friction_as_slip_would_and_does_not_raise_it() {
        let law = SlipWeakening::cohesive(0.6, 0.4, 0.5, 1e6, None).unwrap();
        let push =
            |weakened| Push { normal: 10e6, trial: 9e6, impedance: 4e6, near: 0.0, dt: 0.01, weakened };
        for (slip, weakened, mu) in [(0.0, 0.0, 0.6), (0.0, 0.25, 0.55), (0.0, 1.0, 0.4), (0.4, 0.25, 0.44)] {
            let mut states = [slip];
            let answer = law.push(&push(weakened), &mut states).unwrap();
            assert!((answer.traction / (1e6 + mu * 10e6) - 1.0).abs() < 1e-14, "{answer:?}");
            // Slip is that of the point: what is imposed leaves no trace in it.
            assert_eq!(states[0], slip + answer.rate * 0.01);
        }
    }

    #[test]
    fn cohesion_resists_slip_of_sides_that_press_alone() {
        let push = |normal| Push { normal, trial: 5e6, impedance: 4e6, near: 0.0, dt: 0.01, weakened: 0.0 };
        let coulomb = Coulomb::cohesive(0.5, 2e6, None).unwrap();
        let weakening = SlipWeakening::cohesive(0.5, 0.3, 1.0, 2e6, None).unwrap();
        for law in [&coulomb as &dyn super::Inertial, &weakening] {
            let traction = |normal| law.push(&push(normal), &mut [0.0]).unwrap().traction;
            assert_eq!(traction(1e6), 2.5e6);
            assert_eq!(traction(0.0), 0.0);
        }
    }

    #[test]
    fn static_kinetic_points_drop_once_they_slip_and_heal_at_rest() {
        let law = StaticKinetic::new(0.6, 0.5, None).unwrap();
        let push = |trial| Push { normal: 1.0, trial, impedance: 1.0, near: 0.0, dt: 1.0, weakened: 0.0 };
        let mut states = [0.0];
        assert_eq!(law.push(&push(0.59), &mut states).unwrap().rate, 0.0);
        assert!((law.push(&push(0.61), &mut states).unwrap().traction - 0.5).abs() < 1e-15);
        assert!((law.push(&push(0.59), &mut states).unwrap().traction - 0.5).abs() < 1e-15);
        assert_eq!(law.push(&push(0.4), &mut states).unwrap().rate, 0.0);
        assert_eq!(law.push(&push(0.59), &mut states).unwrap().rate, 0.0);
    }
}
