//! Speeds of sides that follow displacements, held to those of waves in any rock: without units, displacements of linear bodies
//! may be of any size.

use super::course::Course;
use super::{AXES, Checker};
use crate::lengths::show;
use crate::model::{Motion, Stage};
use crate::plausibility::ANY_ROCK;
use std::ops::Range;

impl Course {
    /// Largest speed \[m/s\] with the displacements between which it is reached, if displacements are known.
    fn fastest(&self) -> Option<(f64, f64, f64)> {
        let Self::Known(points) = self else { return None };
        let pieces = points.windows(2).filter(|w| w[1].0 > w[0].0);
        pieces
            .map(|w| ((w[1].1 - w[0].1).abs() / (w[1].0 - w[0].0), w[0].1, w[1].1))
            .max_by(|a, b| a.0.total_cmp(&b.0))
    }
}

impl Checker<'_> {
    /// Refuses a ramp or a table of displacements along which bodies with mass would move at the speed of shear waves, and warns
    /// of one in equilibrium, where rates alone depend on it. Rates are judged as values.
    pub(super) fn speed(
        &mut self,
        stage: &Stage,
        (set, axis): (&str, usize),
        motion: &Motion,
        place: &Range<usize>,
        present: Option<f64>,
    ) {
        if !matches!(motion, Motion::To(_) | Motion::Table(_)) {
            return;
        }
        let course = Course::new(motion, present, stage.duration.get_ref().0);
        let Some((speed, from, to)) = course.fastest().filter(|f| f.0.is_finite() && f.0 >= ANY_ROCK) else {
            return;
        };
        let message = format!(
            "`{set}` moves along {} from {} to {} at {speed:.4e} m/s: sides reach the speed of shear waves, {ANY_ROCK:.4e} m/s, in no rock",
            AXES[axis],
            show(from),
            show(to)
        );
        let help =
            "are the units of the displacement and of the time right? A longer `duration` makes it slower";
        if self.scene.inertia().is_some() || self.has_waves() {
            self.error(place.clone(), message, help);
        } else {
            self.warn(
                place.clone(),
                message,
                format!("{help}; what depends on no rate, in equilibrium, stays the same"),
            );
        }
    }
}
