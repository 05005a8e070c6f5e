//! Tsitouras' method where accuracy limits the step, Runge, Kutta and Chebyshev's where stability does.
//!
//! After an event a fault relaxes over many decades of time: slip rates fall as 1/t, and stability holds the step of a usual
//! explicit method to a share of t that shrinks with the size of cells, although the solution is smooth. A stabilised method takes the
//! longer steps at the price of the root of their length; towards and within events, where accuracy decides, the higher order takes
//! fewer. The spectral radius tells which: the way back is taken where the stabilised method's step would be stable in the usual one.

use super::own::Span;
use super::pair::{Criterion, Pair};
use super::problem::System;
use super::rkc::Rkc2;
use super::tsit5::Tsit5;

/// Stretch h |λ| beyond which stability binds Tsitouras' method, and below which the stabilised one has nothing to gain: its region ends at
/// 3.7 on the negative real axis, and the control keeps steps around there; the spectral radius is a bound, up to twice too large.
const BOUND: f64 = 3.0;
/// Steps in a row that speak for the other method, after which it goes on.
const AGAINST: f64 = 3.0;

/// By the stretch of the steps.
#[derive(Debug)]
pub(super) struct Stretch;

impl Criterion for Stretch {
    type Usual = Tsit5;
    type Stiff = Rkc2;
    const ENOUGH: [f64; 2] = [AGAINST; 2];

    fn against(
        _: (&mut Tsit5, &mut Rkc2),
        stiff: bool,
        before: f64,
        system: &System<'_>,
        span: &Span,
    ) -> f64 {
        let stretch = span.h * system.spectral_radius(span.t, &span.y0);
        let against = if stiff { stretch < BOUND } else { stretch > BOUND };
        if against { before + 1.0 } else { 0.0 }
    }
}

/// The method.
pub(super) type Stabilised = Pair<Stretch>;

impl Stabilised {
    pub fn new(size: usize, stiff: bool) -> Self {
        Self::of(Tsit5::new(size), Rkc2::new(size), stiff)
    }
}
