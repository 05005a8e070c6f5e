//! Weak springs on all free degrees of freedom, in the tangent only.

use asperity_fem::term::{Instant, Linearized, Pattern, Refusal, Term};

/// Stiffness of the springs over the largest entry of the system's matrix. That entry is a penalty, some hundred times the
/// stiffness of the bodies. The springs on the hundred or so nodes of a body thus resist together as much as the body itself.
/// Softer springs let a free body move far; stiffer ones slow down bodies that are held.
const STIFFNESS: f64 = 1e-4;

/// Springs without forces in the residual. The next iterations correct the motion they hold back, so a solution found with them
/// is also one without them.
#[derive(Debug)]
pub(super) struct Anchor {
    pattern: Pattern,
    stiffness: f64,
}

impl Anchor {
    /// Places springs on the degrees of freedom `free`, for a matrix whose largest entry is `largest`.
    pub(super) fn new(free: &[usize], largest: f64) -> Self {
        let pattern = Pattern::from_blocks(free.chunks(1));
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
