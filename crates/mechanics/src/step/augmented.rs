//! Outer loop of implicit steps for constraints enforced by multipliers that are updated between solutions.
//!
//! Each round solves the balance of forces and uses the resulting tractions as multipliers of the next. A round reduces a
//! violation to 1/(1 + E k) of its size, with E the penalty and k the compliance of the bodies at the contact.

use super::implicit::Implicit;
use super::{Failure, SolutionFigures};
use asperity_fem::term::{Augmented, Instant, Linearized};
use asperity_run::Operations;

impl Implicit {
    /// Solves the balance of forces until the violations of all terms with multipliers are within tolerance.
    pub(super) fn augmented(
        &mut self,
        terms: &mut [&mut dyn Linearized],
        u: &mut Vec<f64>,
        at: Instant,
        counts: &mut Operations,
    ) -> Result<SolutionFigures, Failure> {
        let (iterations, residual_ratio) = self.iterate(terms, u, at, counts)?;
        let mut solved = SolutionFigures { iterations, residual_ratio, augmentations: 0 };
        while let Some(worst) = most_violated(terms) {
            if solved.augmentations >= worst.most() {
                return Err(Failure::Violated(worst.violated().to_string()));
            }
            terms.iter_mut().filter_map(|t| t.augmented()).for_each(Augmented::augment);
            solved.augmentations += 1;
            counts.augmentations += 1;
            let (more, ratio) = self.iterate(terms, u, at, counts)?;
            solved.iterations += more;
            solved.residual_ratio = ratio;
        }
        Ok(solved)
    }
}

/// Term that violates its constraints most, if any exceeds its tolerance.
fn most_violated<'t>(terms: &'t mut [&mut dyn Linearized]) -> Option<&'t mut dyn Augmented> {
    let mut worst: Option<(f64, &mut dyn Augmented)> = None;
    for term in terms.iter_mut().filter_map(|t| t.augmented()) {
        let violation = term.violation();
        // A NaN violation counts as exceeding the tolerance.
        let beyond = violation > 1.0 || violation.is_nan();
        if beyond && worst.as_ref().is_none_or(|(most, _)| violation.is_nan() || violation > *most) {
            worst = Some((violation, term));
        }
    }
    worst.map(|(_, term)| term)
}
