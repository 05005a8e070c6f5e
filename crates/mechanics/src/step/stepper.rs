//! Common interface of the steppers.

use super::implicit::Implicit;
use super::static_explicit::StaticExplicit;
use super::{AcceptedStep, Failure, State, StepLengths, StepperState};
use asperity_fem::assembly::{Symmetry, System};
use asperity_fem::dof::Constraints;
use asperity_fem::term::{ForwardTerm, Linearized};
use asperity_run::{Interrupt, Operations};

/// A stepper of either kind.
pub trait Stepper {
    /// Begins another stage with this symmetry of its tangents. `linear` is true if all bodies are linear.
    fn begin_stage(&mut self, symmetry: Symmetry, linear: bool);

    /// Forgets the rate of the last step, which no longer holds.
    fn forget(&mut self);

    /// Tries a step of the wanted length. A forward step may be shorter, but for accuracy no shorter than the least.
    ///
    /// # Errors
    /// [`Failure`]; the terms have discarded the trial.
    fn step(
        &mut self,
        terms: &mut [&mut dyn ForwardTerm],
        constraints: &Constraints,
        state: &mut State,
        length: StepLengths,
        counts: &mut Operations,
    ) -> Result<AcceptedStep, Failure>;

    /// Sets the largest error of friction coefficients with which a step is accepted \[-\].
    fn set_bound(&mut self, bound: f64);

    /// Sets what steps of several iterations ask between these.
    fn set_interrupt(&mut self, interrupt: Interrupt);

    /// Linear system, for its counts.
    fn system(&self) -> &System;

    /// Residual of the state evaluated last; after an accepted step, at its end \[N\].
    fn residual(&self) -> &[f64];

    /// Values kept between steps for these terms.
    fn save(&self, terms: &[&mut dyn Linearized]) -> StepperState;

    /// Restores the values kept by a stepper of the same terms. Returns true if they fit.
    fn restore(&mut self, saved: &StepperState, terms: &mut [&mut dyn Linearized]) -> bool;
}

impl Stepper for Implicit {
    fn begin_stage(&mut self, symmetry: Symmetry, linear: bool) {
        // Bodies with a history do not continue at the previous rate when their loads reverse. A prediction at the rate of the
        // previous stage would start far from the solution.
        Implicit::begin_stage(self, symmetry, linear);
    }

    fn forget(&mut self) {
        Implicit::forget(self);
    }

    fn step(
        &mut self,
        terms: &mut [&mut dyn ForwardTerm],
        constraints: &Constraints,
        state: &mut State,
        length: StepLengths,
        counts: &mut Operations,
    ) -> Result<AcceptedStep, Failure> {
        let mut terms: Vec<&mut dyn Linearized> =
            terms.iter_mut().map(|term| &mut **term as &mut dyn Linearized).collect();
        Implicit::step(self, &mut terms, constraints, state, length.wanted, counts)
    }

    fn set_bound(&mut self, bound: f64) {
        Implicit::set_bound(self, bound);
    }

    fn set_interrupt(&mut self, interrupt: Interrupt) {
        Implicit::set_interrupt(self, interrupt);
    }

    fn system(&self) -> &System {
        Implicit::system(self)
    }

    fn residual(&self) -> &[f64] {
        Implicit::residual(self)
    }

    fn save(&self, terms: &[&mut dyn Linearized]) -> StepperState {
        Implicit::save(self, terms)
    }

    fn restore(&mut self, saved: &StepperState, terms: &mut [&mut dyn Linearized]) -> bool {
        Implicit::restore(self, saved, terms)
    }
}

impl Stepper for StaticExplicit {
    fn begin_stage(&mut self, symmetry: Symmetry, _linear: bool) {
        StaticExplicit::begin_stage(self, symmetry);
    }

    // Bodies with mass take no forward steps.
    fn forget(&mut self) {}

    fn step(
        &mut self,
        terms: &mut [&mut dyn ForwardTerm],
        constraints: &Constraints,
        state: &mut State,
        length: StepLengths,
        counts: &mut Operations,
    ) -> Result<AcceptedStep, Failure> {
        StaticExplicit::step(self, terms, constraints, state, length, counts)
    }

    fn set_bound(&mut self, bound: f64) {
        StaticExplicit::set_bound(self, bound);
    }

    // A forward step is one solution of a system or two, and its correction seldom more.
    fn set_interrupt(&mut self, _interrupt: Interrupt) {}

    fn system(&self) -> &System {
        StaticExplicit::system(self)
    }

    fn residual(&self) -> &[f64] {
        StaticExplicit::residual(self)
    }

    fn save(&self, terms: &[&mut dyn Linearized]) -> StepperState {
        StaticExplicit::save(self, terms)
    }

    fn restore(&mut self, saved: &StepperState, terms: &mut [&mut dyn Linearized]) -> bool {
        StaticExplicit::restore(self, saved, terms)
    }
}
