//! Inertia of a system between its steps.

use super::{AssembledProblem, springs, terms};
use crate::inertia::{Energy, Episode, InertialSystem, View};
use crate::step::{Balance, Failure};
use asperity_fem::term::Instant;
use asperity_run::Operations;

/// Length of the step in which the forces at the start of a stage are evaluated, over that of its first step. Bodies relax and
/// surfaces slip by this share of what they do in the first step, which is far below the error of the step.
const INSTANT: f64 = 1e-6;

impl<const D: usize> AssembledProblem<'_, D> {
    /// Prepares bodies with mass for a step of length `dt`. Before the first step of a stage this finds their accelerations from
    /// the forces under the conditions of the stage.
    pub(super) fn start_moving(&mut self, dt: f64, counts: &mut Operations) -> Result<(), Failure> {
        let Some(moving) = &mut self.moving else { return Ok(()) };
        let pulled = springs::now(self.springs.as_ref(), &self.state);
        moving.note(&self.interfaces, pulled.clone());
        if moving.has_begun() {
            return Ok(());
        }
        let (u, time) = (&self.state.u, self.state.time);
        let mut others = terms(self.bodies.as_mut(), &mut self.springs, &mut self.interfaces, None);
        let mut balance = Balance::default();
        let evaluated = balance.evaluate(&mut others, u, Instant { time, dt: INSTANT * dt }, counts);
        others.iter_mut().for_each(|term| term.reject());
        evaluated?;
        let (planned, interfaces) = (self.problem.interfaces.as_slice(), self.interfaces.as_slice());
        let at = View { blocks: self.bodies.blocks(), planned, interfaces, springs: &pulled, u, time };
        moving.start(balance.r, &at).map_err(|error| Failure::Unsolved { error, always: true })
    }

    /// Adds an accepted step of length `dt` to the energy budget.
    pub(super) fn settle(&mut self, dt: f64) {
        let (Some(moving), Some(stepper)) = (&mut self.moving, &self.stepper) else { return };
        let springs = springs::now(self.springs.as_ref(), &self.state);
        let (planned, interfaces) = (self.problem.interfaces.as_slice(), self.interfaces.as_slice());
        let (u, time) = (self.state.u.as_slice(), self.state.time);
        let at = View { blocks: self.bodies.blocks(), planned, interfaces, springs: &springs, u, time };
        moving.settle(stepper.residual(), dt, &at);
    }

    /// Gives bodies inertia where slip has become fast, and takes it from them where it has become slow.
    pub(super) fn hand_over(&mut self) {
        if self.problem.mass.as_ref().is_none_or(|mass| mass.handover.is_none()) {
            return;
        }
        let rate = self.slip_rates().into_iter().fold(0.0, |most: f64, v| most.max(v.abs()));
        let changed = self.moving.as_mut().is_some_and(|moving| moving.hand_over(self.state.time, rate));
        if let Some(stepper) = self.stepper.as_mut().filter(|_| changed) {
            stepper.forget();
        }
    }

    /// Passages with inertia so far.
    #[must_use]
    pub fn episodes(&self) -> &[Episode] {
        self.moving.as_ref().map_or(&[], InertialSystem::episodes)
    }

    /// Energy budget of bodies with mass.
    #[must_use]
    pub fn energy(&self) -> Option<Energy> {
        Some(self.moving.as_ref()?.energy())
    }

    /// Velocity of all degrees of freedom of bodies with mass \[m/s\].
    #[must_use]
    pub fn velocity(&self) -> Option<&[f64]> {
        Some(self.moving.as_ref()?.velocity())
    }

    /// Estimated error of displacement in the last step of bodies with mass, over its bound \[-\]; 0 without mass.
    #[must_use]
    pub fn inertia_error(&self) -> f64 {
        let moving = self.moving.as_ref().zip(self.problem.mass.as_ref());
        moving.map_or(0.0, |(moving, mass)| moving.error() / mass.tolerance)
    }

    /// Accepts steps of bodies with mass up to this multiple of the bound of their error.
    pub fn set_inertia_bound(&mut self, most: f64) {
        if let (Some(moving), Some(mass)) = (&mut self.moving, &self.problem.mass) {
            moving.set_bound(most * mass.tolerance);
        }
    }
}
