//! Inertia of a system between its steps.

use super::AssembledProblem;
use crate::inertia::{Episode, InertialSystem};

impl<const D: usize> AssembledProblem<'_, D> {
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
