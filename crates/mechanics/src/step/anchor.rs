//! A weak spring on every free degree of freedom, in the tangent only.

use asperity_fem::term::{Instant, Linearized, Pattern, Refusal, Term};

/// Stiffness of the springs over the largest entry of the system's matrix. That is a penalty, some hundred times the stiffness
/// of the bodies, so that the springs of a body's some hundred nodes together resist like the body itself: softer ones throw a
/// free body far, stiffer ones slow what is held.
const STIFFNESS: f64 = 1e-4;

/// The springs. Their forces are absent from the residual: what they hold back is put right by the next iterations, and a
/// solution found with them is one without.
#[derive(Debug)]
pub(super) struct Anchor {
    pattern: Pattern,
    stiffness: f64,
}

impl Anchor {
    /// Springs on the degrees of freedom `free`, for a matrix whose largest entry is `largest`.
    pub(super) fn new(free: &[usize], largest: f64) -> Self {
        let pattern = Pattern::of_blocks(free.chunks(1));
        Self { pattern, stiffness: STIFFNESS * largest }
    }
}

impl Term for Anchor {
    fn name(&self) -> &'static str {
        "springs of a singular tangent"
    }

    fn residual(&mut self, _u: &[f64], _at: Instant, _r: &mut [f64]) -> Result<(), Refusal> {
        Ok(())
    }

    fn accept(&mut self) {}

    fn reject(&mut self) {}
}

impl Linearized for Anchor {
    fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    fn tangent(&mut self, values: &mut [f64]) {
        values.fill(self.stiffness);
    }
}
