//! Exit of a shear traction that changes linearly over a step from the region admitted by its strength.

use crate::law::BAND;

/// A quantity that changes linearly over a step \[Pa\].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line {
    /// Value at the start.
    pub at: f64,
    /// Change over the whole step.
    pub change: f64,
}

impl Line {
    /// First fraction in (0, 1) at which the magnitude of the traction exceeds `cone` or the constant `cap`. A traction that is
    /// already on the surface does not limit the step.
    pub fn exit(self, cone: Self, cap: Option<f64>) -> Option<f64> {
        let cap = cap.filter(|c| c.is_finite()).map(|at| Self { at, change: 0.0 });
        let mut first: Option<f64> = None;
        for sign in [1.0, -1.0] {
            for surface in [Some(cone), cap].into_iter().flatten() {
                let (distance, approach) = (surface.at - sign * self.at, sign * self.change - surface.change);
                // Only a traction that grows towards the surface crosses it outwards.
                if approach > 0.0 && distance > BAND * surface.at.abs() && distance < approach {
                    let fraction = distance / approach;
                    // A cone that has shrunk to zero belongs to a point that opens.
                    if surface.at + fraction * surface.change > 0.0 {
                        first = Some(first.map_or(fraction, |f| f.min(fraction)));
                    }
                }
            }
        }
        first
    }
}
