//! Dormand and Prince's explicit method of order 8 where accuracy limits the step, Radau IIA where stability does.
//!
//! A slider that slides through thousands of its lengths L forgets its state once per L, and an explicit method follows each of
//! these e-folds although the solution is smooth. Stability binds where `h |λ|` stays at the end of the stability region, which the
//! last two stages of a step tell (E. Hairer, G. Wanner, "Solving Ordinary Differential Equations II", 2nd ed. (1996), section IV.2).
//! The way back is taken where the step of the implicit method would be stable in the explicit one.

use super::dop853::Dop853;
use super::own::{Formula, Span, Trial};
use super::problem::System;
use super::radau5::Radau5;
use super::report::Counts;

/// End of the stability region of the explicit method on the negative real axis is 6.1; the control of steps keeps `h |λ|` around it.
const BOUNDARY: f64 = 5.0;
/// Steps at the boundary, less those within, after which stability binds.
const BOUND: u32 = 6;
/// Steps in a row that the explicit method could have taken, after which it goes on.
const FREE: u32 = 2;

/// The method.
#[derive(Debug)]
pub(super) struct Switching {
    explicit: Dop853,
    implicit: Radau5,
    /// Whether the step last tried is of the implicit method, and whether the next is.
    stiff: bool,
    next_stiff: bool,
    /// Steps that speak for the other method.
    against: u32,
}

impl Switching {
    pub fn new(size: usize) -> Self {
        Self {
            explicit: Dop853::new(size),
            implicit: Radau5::new(size),
            stiff: false,
            next_stiff: false,
            against: 0,
        }
    }

    fn active(&mut self) -> &mut dyn Formula {
        if self.stiff { &mut self.implicit } else { &mut self.explicit }
    }
}

impl Formula for Switching {
    fn order(&self) -> i32 {
        self.explicit.order()
    }

    fn attempt(&mut self, system: &System<'_>, span: &mut Span) -> Trial {
        if self.stiff != self.next_stiff {
            self.stiff = self.next_stiff;
            self.against = 0;
            self.active().forget();
        }
        self.active().attempt(system, span)
    }

    fn complete(&mut self, system: &System<'_>, span: &mut Span) {
        self.active().complete(system, span);
    }

    fn share(&mut self, h: f64, error: f64, accepted: bool, rejected_before: bool) -> f64 {
        self.active().share(h, error, accepted, rejected_before)
    }

    fn accept(&mut self, system: &System<'_>, span: &Span, error: f64) {
        self.active().accept(system, span, error);
        if self.stiff {
            let stable = span.h * self.implicit.spectral_radius() < BOUNDARY;
            self.against = if stable { self.against + 1 } else { 0 };
            self.next_stiff = self.against < FREE;
        } else {
            let bound = self.explicit.stretch(system, span) > BOUNDARY;
            self.against = if bound { self.against + 1 } else { self.against.saturating_sub(1) };
            self.next_stiff = self.against >= BOUND;
        }
    }

    fn again(&mut self) {
        self.next_stiff = self.stiff;
        self.active().again();
    }

    fn forget(&mut self) {
        // What was learnt of stiffness holds beyond an event; a jump of the forcing shows within a few steps.
        self.explicit.forget();
        self.implicit.forget();
    }

    fn interpolate(&self, system: &System<'_>, span: &Span, fraction: f64, y: &mut [f64]) {
        if self.stiff {
            self.implicit.interpolate(system, span, fraction, y);
        } else {
            self.explicit.interpolate(system, span, fraction, y);
        }
    }

    fn tally(&self, counts: &mut Counts) {
        self.explicit.tally(counts);
        self.implicit.tally(counts);
    }
}
