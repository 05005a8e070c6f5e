//! Energy budget of a system, with inertia or without.

use super::{AssembledProblem, springs, terms};
use crate::energy::{Jump, View, body_energy};
use crate::step::{Balance, Failure};
use crate::{InterfaceEnergy, SpringState};
use asperity_fem::term::Instant;
use asperity_run::{Energies, Operations};

/// Length of the step in which the forces at the start of a stage are evaluated, over that of its first step. Bodies relax and
/// surfaces slip by this share of what they do in the first step, which is far below the error of the step.
const INSTANT: f64 = 1e-6;

impl<const D: usize> AssembledProblem<'_, D> {
    /// Prepares the budget, and bodies with mass, for a step of length `dt`. Before the first step of a stage this finds the forces
    /// under its conditions, from which follow the accelerations of bodies with mass.
    pub(super) fn start_moving(&mut self, dt: f64, counts: &mut Operations) -> Result<(), Failure> {
        let pulled = springs::now(self.springs.as_ref(), &self.state);
        let Some(moving) = &mut self.moving else {
            self.start_budget(dt, pulled);
            return Ok(());
        };
        moving.note(&self.interfaces, pulled.clone());
        if moving.has_begun() {
            return Ok(());
        }
        let r = self.forces_at_start(dt, counts)?;
        let Some(moving) = &mut self.moving else { return Ok(()) };
        let (u, time) = (&self.state.u, self.state.time);
        let (planned, interfaces) = (self.problem.interfaces.as_slice(), self.interfaces.as_slice());
        let bodies = body_energy(self.bodies.blocks(), u);
        let at = View { bodies, planned, interfaces, springs: &pulled, u, time };
        moving.start(r, &at).map_err(|error| Failure::Unsolved { error, always: true })
    }

    /// Prepares the budget of bodies without mass for a step of length `dt`.
    fn start_budget(&mut self, dt: f64, pulled: Vec<SpringState>) {
        self.budget.note(&self.state.u, &self.interfaces, pulled.clone());
        if self.budget.has_begun() {
            return;
        }
        // Where the forces cannot be evaluated the step will tell.
        let unknown = vec![0.0; self.state.u.len()];
        let mut r = self.forces_at_start(dt, &mut Operations::default()).unwrap_or(unknown);
        r.truncate(self.numbering.dofs);
        let (u, time) = (&self.state.u, self.state.time);
        let (planned, interfaces) = (self.problem.interfaces.as_slice(), self.interfaces.as_slice());
        let blocks = self.bodies.blocks();
        let at =
            View { bodies: body_energy(blocks, &self.begin), planned, interfaces, springs: &pulled, u, time };
        let to = self.bodies.displacement(u, time);
        let jump = Jump { blocks, constraints: &self.conditions, from: &self.begin, to: &to };
        self.budget.start(r, &jump, &at);
    }

    /// Forces of all terms but inertia at the start of a stage, under its conditions.
    fn forces_at_start(&mut self, dt: f64, counts: &mut Operations) -> Result<Vec<f64>, Failure> {
        let at = Instant { time: self.state.time, dt: INSTANT * dt };
        let mut others = terms(self.bodies.as_mut(), &mut self.springs, &mut self.interfaces, None);
        let mut balance = Balance::default();
        let evaluated = balance.evaluate(&mut others, &self.state.u, at, counts);
        others.iter_mut().for_each(|term| term.reject());
        evaluated?;
        Ok(balance.r)
    }

    /// Adds an accepted step of length `dt` to the energy budget.
    pub(super) fn settle(&mut self, dt: f64) {
        let Some(stepper) = &self.stepper else { return };
        let springs = springs::now(self.springs.as_ref(), &self.state);
        let (planned, interfaces) = (self.problem.interfaces.as_slice(), self.interfaces.as_slice());
        let (u, time) = (self.state.u.as_slice(), self.state.time);
        let bodies = self.bodies.energies(u, time);
        let at = View { bodies, planned, interfaces, springs: &springs, u, time };
        match &mut self.moving {
            Some(moving) => moving.settle(stepper.residual(), dt, &at),
            None => {
                let works = self.bodies.works((self.budget.before(), time - dt), (u, time));
                self.budget.settle(stepper.residual(), works, dt, &at);
            }
        }
    }

    /// Energy budget.
    #[must_use]
    pub fn energies(&self) -> Energies {
        match &self.moving {
            Some(moving) => moving.energy().energies(true),
            None => self.budget.energy().energies(false),
        }
    }

    /// Energies of each interface; empty before the first step.
    #[must_use]
    pub fn interface_energies(&self) -> &[InterfaceEnergy] {
        self.moving.as_ref().map_or_else(|| self.budget.interfaces(), |moving| moving.interfaces())
    }
}
