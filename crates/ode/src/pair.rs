//! Two methods of which one takes the steps: a usual one where accuracy limits them, a stiff one where stability does. A
//! [`Criterion`] chooses between them; a method that takes over restarts.

use super::one_step::{Formula, Span, Trial};
use super::problem::System;
use super::report::Counts;

/// Choice between two methods for the next step.
pub(super) trait Criterion {
    /// Method for steps limited by accuracy.
    type NonstiffMethod: Formula;
    /// Method for steps limited by stability.
    type StiffMethod: Formula;
    /// Counts against the usual and against the stiff method at which the other takes over.
    const ENOUGH: [f64; 2];

    /// Updated count against the active method after the step just accepted, where it was `before`; `stiff` is true for the
    /// stiff method.
    fn against(
        methods: (&mut Self::NonstiffMethod, &mut Self::StiffMethod),
        stiff: bool,
        before: f64,
        system: &System<'_>,
        span: &Span,
    ) -> f64;
}

/// See the module.
#[derive(Debug)]
pub(super) struct Pair<C: Criterion> {
    usual: C::NonstiffMethod,
    other: C::StiffMethod,
    /// True if the step last tried is of the stiff method; then the same for the next step.
    stiff: bool,
    next_stiff: bool,
    /// Count against the active method.
    against: f64,
}

impl<C: Criterion> Pair<C> {
    /// A pair that begins with the stiff method or with the usual one.
    pub fn from_methods(usual: C::NonstiffMethod, other: C::StiffMethod, stiff: bool) -> Self {
        Self { usual, other, stiff, next_stiff: stiff, against: 0.0 }
    }

    fn active(&mut self) -> &mut dyn Formula {
        if self.stiff { &mut self.other } else { &mut self.usual }
    }
}

impl<C: Criterion> Formula for Pair<C> {
    fn order(&self) -> i32 {
        self.usual.order()
    }

    fn attempt(&mut self, system: &System<'_>, span: &mut Span) -> Trial {
        if self.stiff != self.next_stiff {
            self.stiff = self.next_stiff;
            self.against = 0.0;
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
        let methods = (&mut self.usual, &mut self.other);
        self.against = C::against(methods, self.stiff, self.against, system, span);
        self.next_stiff = self.stiff != (self.against >= C::ENOUGH[usize::from(self.stiff)]);
    }

    fn again(&mut self) {
        self.next_stiff = self.stiff;
        self.active().again();
    }

    fn forget(&mut self) {
        // Stiffness found so far remains valid beyond an event; a jump of the forcing shows within a few steps.
        self.usual.forget();
        self.other.forget();
    }

    fn next_stiff(&self) -> bool {
        self.next_stiff
    }

    fn interpolate(&self, system: &System<'_>, span: &Span, fraction: f64, y: &mut [f64]) {
        if self.stiff {
            self.other.interpolate(system, span, fraction, y);
        } else {
            self.usual.interpolate(system, span, fraction, y);
        }
    }

    fn tally(&self, counts: &mut Counts) {
        self.usual.tally(counts);
        self.other.tally(counts);
    }
}
