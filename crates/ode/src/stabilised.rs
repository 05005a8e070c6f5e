//! Tsitouras' method where accuracy limits the step, Runge, Kutta and Chebyshev's where stability does.
//!
//! After an event a fault relaxes over many decades of time: slip rates fall as 1/t. Stability limits the step of a usual explicit
//! method to a fraction of t that shrinks with the cell size, although the solution is smooth. The work of a stabilised method for a
//! longer step grows only with the square root of its length. Towards and within events, where accuracy decides, the higher order
//! takes fewer steps. The spectral radius decides: the usual method resumes where the step of the stabilised one would be stable in
//! it.

use super::one_step::Span;
use super::pair::{Criterion, Pair};
use super::problem::System;
use super::rkc::Rkc2;
use super::tsit5::Tsit5;

/// Stretch h |λ| beyond which stability limits Tsitouras' method, and below which the stabilised one has no advantage. Its region ends at
/// 3.7 on the negative real axis, and the control keeps steps near there; the spectral radius is a bound, up to twice too large.
const BOUND: f64 = 3.0;
/// Consecutive steps in favour of the other method after which it takes over.
const AGAINST: f64 = 3.0;

/// Criterion by the stretch of the steps.
#[derive(Debug)]
pub(super) struct Stretch;

impl Criterion for Stretch {
    type NonstiffMethod = Tsit5;
    type StiffMethod = Rkc2;
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
pub(super) type StabilisedMethod = Pair<Stretch>;

impl StabilisedMethod {
    pub fn new(size: usize, stiff: bool) -> Self {
        Self::from_methods(Tsit5::new(size), Rkc2::new(size), stiff)
    }
}
