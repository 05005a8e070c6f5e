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

/// End of the stability region of the explicit method on the negative real axis is 6.1; the control of steps keeps `h |λ|` around it.
const BOUNDARY: f64 = 5.0;
/// Steps at the boundary, less those within, after which stability binds.
const BOUND: u32 = 6;
/// Steps in a row that the explicit method could have taken, after which it goes on.
const FREE: u32 = 2;

/// By where the explicit method's stages end up, and by the Jacobian of the implicit one.
#[derive(Debug)]
pub(super) struct Boundary;

impl Criterion for Boundary {
    type Usual = Dop853;
    type Stiff = Radau5;
    const ENOUGH: [u32; 2] = [BOUND, FREE];

    fn against(
        (explicit, implicit): (&mut Dop853, &mut Radau5),
        stiff: bool,
        before: u32,
        system: &System<'_>,
        span: &Span,
    ) -> u32 {
        if stiff {
            let stable = span.h * implicit.spectral_radius() < BOUNDARY;
            return if stable { before + 1 } else { 0 };
        }
        let bound = explicit.stretch(system, span) > BOUNDARY;
        if bound { before + 1 } else { before.saturating_sub(1) }
    }
}

/// The method.
pub(super) type Switching = Pair<Boundary>;

impl Switching {
    pub fn new(size: usize) -> Self {
        Self::of(Dop853::new(size), Radau5::new(size))
    }
}
