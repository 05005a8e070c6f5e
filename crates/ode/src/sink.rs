//! Reports of an integration while it runs.

use super::clock::Clock;
use super::problem::System;
use super::report::{Control, Occurrence};
use super::stepper::Stepper;

/// Receiver of the solution as it is computed.
pub trait Sink {
    /// Called for each accepted step. A step in which an event occurs ends there.
    fn accepted(&mut self, step: &Step<'_>) -> Control;

    /// Called for an event at the end of the last step. All events of one time are reported, in the order of their numbers.
    fn occurred(&mut self, occurrence: &Occurrence) -> Control;
}

/// An accepted step.
pub struct Step<'a> {
    /// Time of its beginning.
    pub start: Clock,
    /// Time of its end.
    pub end: Clock,
    /// The unknowns at its end.
    pub state: &'a [f64],
    /// The rates at its end, where the method has them without a further evaluation.
    pub rates: Option<&'a [f64]>,
    pub(super) stepper: &'a dyn Stepper,
    pub(super) system: &'a System<'a>,
    /// Fraction of the stepper's step that this one covers.
    pub(super) share: f64,
}

impl Step<'_> {
    /// Length \[s\].
    #[must_use]
    pub fn length(&self) -> f64 {
        self.end.since(&self.start)
    }

    /// The unknowns at its start.
    #[must_use]
    pub fn start_state(&self) -> &[f64] {
        self.stepper.start()
    }

    /// The rates at its start, where the method has them.
    #[must_use]
    pub fn start_rates(&self) -> Option<&[f64]> {
        self.stepper.rates().map(|(start, _)| start)
    }

    /// Length the method would take next \[s\], where it is useful after a restart.
    #[must_use]
    pub fn next_length(&self) -> Option<f64> {
        self.stepper.next_length()
    }

    /// True where a pair of methods would take the next step with the one for stiff equations. An integration that restarts here begins
    /// with it ([`Options::begin_stiff`](crate::Options::begin_stiff)): where a mass comes to rest, finding that out again takes
    /// thousands of steps.
    #[must_use]
    pub fn next_stiff(&self) -> bool {
        self.stepper.next_stiff()
    }

    /// Writes the unknowns at `fraction` of the step, from 0 to 1, into `y`.
    ///
    /// The polynomial is that of the method. Dop853: degree 7; the first call in a step evaluates the rates three times. Tsit5
    /// and tsit45: degree 4. Radau5: the collocation polynomial of degree 3. Bdf: the current order, 1 to 5. Esdirk34 and, of
    /// degree 2, tr-bdf2: the continuous extension of diffsol. The error of a polynomial of degree p scales with the power p +
    /// 1 of the step.
    pub fn at(&self, fraction: f64, y: &mut [f64]) {
        self.stepper.interpolate(self.system, fraction * self.share, y);
    }
}
