//! Dormand and Prince's explicit method of order 8 where accuracy limits the step, Radau IIA where stability does.
//!
//! A slider that slides through thousands of its lengths L forgets its state once per L, and an explicit method follows each of
//! these e-folds although the solution is smooth. Stability binds where `h |λ|` stays at the end of the stability region, which the
//! last two stages of a step tell (E. Hairer, G. Wanner, "Solving Ordinary Differential Equations II", 2nd ed. (1996), section IV.2).
//! The way back is taken where the step of the implicit method would be stable in the explicit one.

use super::dop853::Dop853;
use super::own::Span;
use super::pair::{Criterion, Pair};
use super::problem::System;
use super::radau5::Radau5;

/// Mean of `h |λ|` over some steps of the explicit method above which stability binds. Its region ends at 6.1 on the negative real
/// axis. Where it binds, the control of steps tries longer ones and shorter ones around that in turn, and their mean is 5 to 6.
const BINDING: f64 = 4.0;
/// Steps over which that mean is taken; the older ones fade.
const MEMORY: f64 = 8.0;
/// One step tells no more than this: a quotient of differences may be any number.
const MOST: f64 = 10.0;
/// `h |λ|` of a step of the implicit method below which the explicit one could have taken it.
const STABLE: f64 = 5.0;
/// Such steps in a row after which the explicit method goes on: the first ones are as short as those of the explicit method were, and
/// grow where it is stability that bound them.
const FREE: f64 = 6.0;

/// By where the explicit method's stages end up, and by the Jacobian of the implicit one.
#[derive(Debug)]
pub(super) struct Boundary;

impl Criterion for Boundary {
    type Usual = Dop853;
    type Stiff = Radau5;
    const ENOUGH: [f64; 2] = [BINDING, FREE];

    fn against(
        (explicit, implicit): (&mut Dop853, &mut Radau5),
        stiff: bool,
        before: f64,
        system: &System<'_>,
        span: &Span,
    ) -> f64 {
        if stiff {
            let stable = implicit.slower_than(STABLE / span.h);
            return if stable { before + 1.0 } else { 0.0 };
        }
        before + (explicit.stretch(system, span).min(MOST) - before) / MEMORY
    }
}

/// The method.
pub(super) type Switching = Pair<Boundary>;

impl Switching {
    pub fn new(size: usize, stiff: bool) -> Self {
        Self::of(Dop853::new(size), Radau5::new(size), stiff)
    }
}
