//! Multipliers that are updated between solutions.

use super::Interface;
use crate::enforce::Multipliers;
use crate::shear::Shear;
use crate::vector::{norm, sub};
use asperity_fem::term::{Augmented, Refusal};

/// Constraint that the present solution violates most.
#[derive(Clone, Copy)]
struct WorstViolation {
    /// Violation \[m\].
    value: f64,
    point: usize,
    tangential: bool,
}

impl<const D: usize> Interface<D> {
    /// Sets the multipliers to the committed tractions.
    pub(crate) fn renew_multipliers(&mut self) {
        let Some(multipliers) = &mut self.multipliers else { return };
        for (l, c) in multipliers.normal.iter_mut().zip(&self.contact.committed) {
            *l = c.traction;
        }
        follow(&mut multipliers.shear, self.shear.as_ref(), |s| &s.committed.traction);
    }

    /// Largest change of the tractions from the multipliers in the last residual, as a length. It covers penetration, the gap
    /// over which a separating point is pulled, and the elastic part of a tangential increment. NaN counts as the largest.
    fn worst(&self, multipliers: &Multipliers) -> WorstViolation {
        let mut worst = WorstViolation { value: 0.0, point: 0, tangential: false };
        let mut take = |value: f64, point: usize, tangential: bool| {
            if value > worst.value || value.is_nan() {
                worst = WorstViolation { value, point, tangential };
            }
        };
        for (p, (c, l)) in self.contact.trial.iter().zip(&multipliers.normal).enumerate() {
            take((c.traction - l).abs() / self.penalty.stiffness, p, false);
        }
        if let Some(shear) = &self.shear {
            for (p, (t, l)) in shear.trial.traction.iter().zip(&multipliers.shear).enumerate() {
                take(norm(&sub(t, l)) / self.tangential_penalty, p, true);
            }
        }
        worst
    }
}

/// Copies the tractions of the law, if there is one.
fn follow(to: &mut Vec<[f64; 2]>, shear: Option<&Shear>, of: impl Fn(&Shear) -> &Vec<[f64; 2]>) {
    to.clear();
    if let Some(shear) = shear {
        to.extend_from_slice(of(shear));
    }
}

impl<const D: usize> Augmented for Interface<D> {
    fn violation(&self) -> f64 {
        let violation = |m: &Multipliers| m.moved.map(|(tolerance, _)| self.worst(m).value / tolerance);
        self.multipliers.as_ref().and_then(violation).unwrap_or(0.0)
    }

    fn most(&self) -> usize {
        self.multipliers.as_ref().and_then(|m| m.moved).map_or(0, |(_, most)| most)
    }

    fn augment(&mut self) {
        let Some(multipliers) = &mut self.multipliers else { return };
        self.work.augmentations += 1;
        for (l, c) in multipliers.normal.iter_mut().zip(&self.contact.trial) {
            *l = c.traction;
        }
        follow(&mut multipliers.shear, self.shear.as_ref(), |s| &s.trial.traction);
    }

    fn violated(&self) -> Refusal {
        let moved = self.multipliers.as_ref().and_then(|m| Some((m, m.moved?)));
        let Some((multipliers, (tolerance, most))) = moved else {
            return self.refuse("nothing is augmented".into());
        };
        let worst = self.worst(multipliers);
        let what = if worst.tangential { "tangential motion without slip" } else { "gap" };
        self.refuse(format!(
            "the {what} at node {} is {:.2e} m after {} augmentations, above the tolerance {:.2e} m",
            self.label(worst.point),
            worst.value,
            most,
            tolerance
        ))
    }
}
