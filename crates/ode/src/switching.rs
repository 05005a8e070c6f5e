//! Dormand and Prince's explicit method of order 8 where accuracy limits the step, Radau IIA where stability does.
//!
//! A slider that slides through thousands of its lengths L forgets its state once per L. An explicit method follows each of these
//! e-folds, although the solution is smooth. Stability limits the step where `h |λ|` stays at the boundary of the stability region,
//! which is estimated from the last two stages of a step (E. Hairer, G. Wanner, "Solving Ordinary Differential Equations II", 2nd ed.
//! (1996), section IV.2). The explicit method resumes where the step of the implicit one would be stable in it.

use super::dop853::Dop853;
use super::one_step::Span;
use super::pair::{Criterion, Pair};
use super::problem::System;
use super::radau5::Radau5;

/// Mean of `h |λ|` over some steps of the explicit method above which stability limits them. The region ends at 6.1 on the
/// negative real axis. At this limit the step control alternates between longer and shorter steps, and their mean is 5 to 6.
const BINDING: f64 = 4.0;
/// Steps over which that mean is taken, with fading weight of older ones.
const MEMORY: f64 = 8.0;
/// Factor on `h |λ|` where the tolerance is below the rounding of the states, over that rounding in units of the tolerance. Each stage
/// rounds the states anew, and the rates amplify this: the error estimate is then about 5 `h |λ|` times the rounding. It bounds the
/// step below the boundary of the stability region, so that a stiff problem would never reach it: with `mu/a` of 60 and a tolerance
/// of 1e-13 at 2.3. This factor finds the steps stiff at half of what rounding allows.
const ROUNDED: f64 = 40.0;
/// Largest contribution of one step: a quotient of differences may be any number.
const MOST: f64 = 10.0;
/// `h |λ|` of a step of the implicit method below which the explicit one could have taken it.
const STABLE: f64 = 5.0;
/// Consecutive steps of this kind after which the explicit method resumes. The first ones are as short as those of the explicit
/// method were, and grow if stability limited those.
const FREE: f64 = 6.0;

/// Criterion by the last stages of the explicit method, and by the Jacobian of the implicit one.
#[derive(Debug)]
pub(super) struct Boundary;

impl Criterion for Boundary {
    type NonstiffMethod = Dop853;
    type StiffMethod = Radau5;
    const ENOUGH: [f64; 2] = [BINDING, FREE];

    fn against(
        (explicit, implicit): (&mut Dop853, &mut Radau5),
        stiff: bool,
        before: f64,
        system: &System<'_>,
        span: &Span,
    ) -> f64 {
        let rounded = (ROUNDED * system.rounding(&span.y0, &span.y1)).max(1.0);
        if stiff {
            let stable = implicit.slower_than(STABLE / (rounded * span.h));
            return if stable { before + 1.0 } else { 0.0 };
        }
        before + ((rounded * explicit.stretch(system, span)).min(MOST) - before) / MEMORY
    }
}

/// The method.
pub(super) type SwitchingMethod = Pair<Boundary>;

impl SwitchingMethod {
    pub fn new(size: usize, stiff: bool) -> Self {
        Self::from_methods(Dop853::new(size), Radau5::new(size), stiff)
    }
}
