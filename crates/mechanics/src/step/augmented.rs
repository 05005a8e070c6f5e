//! The outer loop of implicit steps: constraints enforced by multipliers that move between solutions.
//!
//! Each round solves the balance of forces and makes the tractions found the multipliers of the next. What is left of a
//! violation after a round is 1/(1 + E k) of it, E the penalty and k the compliance of the bodies in the contact.

use super::implicit::Implicit;
use super::{Failure, Solved};
use crate::Counts;
use asperity_fem::term::{Augmented, Instant, Linearized};

impl Implicit {
    /// Solves the balance of forces until the terms with multipliers violate nothing beyond their tolerance.
    pub(super) fn augmented(
        &mut self,
        terms: &mut [&mut dyn Linearized],
        u: &mut Vec<f64>,
        at: Instant,
        counts: &mut Counts,
    ) -> Result<Solved, Failure> {
        let (iterations, residual_ratio) = self.iterate(terms, u, at, counts)?;
        let mut solved = Solved { iterations, residual_ratio, augmentations: 0 };
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

/// The term that violates its constraints most, where any does beyond its tolerance.
fn most_violated<'t>(terms: &'t mut [&mut dyn Linearized]) -> Option<&'t mut dyn Augmented> {
    let mut worst: Option<(f64, &mut dyn Augmented)> = None;
    for term in terms.iter_mut().filter_map(|t| t.augmented()) {
        let violation = term.violation();
        // A violation that is no number is one.
        let beyond = violation > 1.0 || violation.is_nan();
        if beyond && worst.as_ref().is_none_or(|(most, _)| violation.is_nan() || violation > *most) {
            worst = Some((violation, term));
        }
    }
    worst.map(|(_, term)| term)
}
