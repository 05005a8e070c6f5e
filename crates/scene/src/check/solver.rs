//! Solution of the linear systems.

use super::Checker;
use crate::model::{Method, Path};
use std::ops::RangeInclusive;

/// Tolerances of the iterative method. Rounding leaves about 1e-14; above 1e-2 no step would converge.
const TOLERANCES: RangeInclusive<f64> = 1e-14..=1e-2;

impl Checker<'_> {
    pub(super) fn solver(&mut self) {
        let solver = &self.scene.solver;
        if let Some(memory) = solver.memory.as_ref().filter(|m| m.get_ref().0 < 1.0) {
            self.error(memory.span(), "`memory` must be positive", "such as `memory = \"8 GiB\"`");
        }
        if let Some(tolerance) = solver.tolerance.as_ref().filter(|t| !TOLERANCES.contains(t.get_ref())) {
            self.error(
                tolerance.span(),
                format!("`tolerance` is {}: the residual of a solution over its load", tolerance.get_ref()),
                format!("from {:e} to {:e}", TOLERANCES.start(), TOLERANCES.end()),
            );
        }
        if let Some(most) = solver.most_iterations.as_ref().filter(|m| *m.get_ref() == 0) {
            self.error(
                most.span(),
                "`most_iterations` must be at least 1",
                "such as `most_iterations = 500`",
            );
        }
        let Some(method) = &solver.method else { return };
        if *method.get_ref() == Method::Iterative && self.scene.time.path == Path::Condensed {
            self.conflict(
                &method.span(),
                "the iterative method does not condense, but the path is \"condensed\"",
                "use `path = \"full\"`, or `method = \"direct\"`",
                (&self.scene.time.stepper.span(), "in the table with the path"),
            );
        }
    }
}
