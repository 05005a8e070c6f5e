//! Tsitouras' method where accuracy limits the step, Runge, Kutta and Chebyshev's where stability does.
//!
//! After an event a fault relaxes over many decades of time: slip rates fall as 1/t, and stability holds the step of a usual
//! explicit method to a share of t that shrinks with the size of cells, although the solution is smooth. A stabilised method takes the
//! longer steps at the price of the root of their length; towards and within events, where accuracy decides, the higher order takes
//! fewer. The spectral radius tells which: the way back is taken where the stabilised method's step would be stable in the usual one.

use super::own::{Formula, Span, Trial};
use super::problem::System;
use super::report::Counts;
use super::rkc::Rkc2;
use super::tsit5::Tsit5;

/// Stretch h |λ| beyond which stability binds Tsitouras' method: its region ends at 3.7 on the negative real axis, and the control
/// keeps steps around there; the spectral radius is a bound, up to twice too large.
const BOUND: f64 = 3.0;
/// Stretch below which the stabilised method has nothing to gain.
const FREE: f64 = 3.0;
/// Steps in a row that speak for the other method, after which it goes on.
const AGAINST: u32 = 3;

/// The method.
#[derive(Debug)]
pub(super) struct Stabilised {
    usual: Tsit5,
    long: Rkc2,
    /// Whether the step last tried is of the stabilised method, and whether the next is.
    stiff: bool,
    next_stiff: bool,
    /// Steps that speak for the other method.
    against: u32,
}

impl Stabilised {
    pub fn new(size: usize) -> Self {
        Self { usual: Tsit5::new(size), long: Rkc2::new(size), stiff: false, next_stiff: false, against: 0 }
    }

    fn active(&mut self) -> &mut dyn Formula {
        if self.stiff { &mut self.long } else { &mut self.usual }
    }
}

impl Formula for Stabilised {
    fn order(&self) -> i32 {
        self.usual.order()
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
        let stretch = span.h * system.spectral_radius(span.t, &span.y0);
        let against = if self.stiff { stretch < FREE } else { stretch > BOUND };
        self.against = if against { self.against + 1 } else { 0 };
        self.next_stiff = self.stiff != (self.against >= AGAINST);
    }

    fn again(&mut self) {
        self.next_stiff = self.stiff;
        self.active().again();
    }

    fn forget(&mut self) {
        self.usual.forget();
        self.long.forget();
    }

    fn interpolate(&self, system: &System<'_>, span: &Span, fraction: f64, y: &mut [f64]) {
        if self.stiff {
            self.long.interpolate(system, span, fraction, y);
        } else {
            self.usual.interpolate(system, span, fraction, y);
        }
    }

    fn tally(&self, counts: &mut Counts) {
        self.usual.tally(counts);
        self.long.tally(counts);
    }
}
