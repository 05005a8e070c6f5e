//! Starts of stages: tables carry on from where the stage before has ended, and bodies with mass do not jump.

use super::{AXES, Checker, pressing};
use crate::lengths::show;
use crate::model::{Condition, Loading, Motion, Spanned, Stage, Stepper};
use std::collections::BTreeMap;
use std::ops::Range;

/// Admissible difference of two values relative to the larger one: rounding of decimal input.
const ROUNDING: f64 = 1e-9;

/// Loads at the end of the stage before, by set and component; a pressure has the last.
pub(super) type PresentLoads = BTreeMap<(String, usize), f64>;

/// Component of a pressure.
const PRESSURE: usize = 3;

/// Loads of a condition with their components and names.
fn loads(c: &Condition) -> impl Iterator<Item = (usize, &'static str, &Loading, Range<usize>)> {
    let tractions = c.traction.iter().flat_map(|t| t.get_ref().iter().map(|load| (load, t.span())));
    let tractions = tractions.enumerate().map(|(axis, (load, place))| (axis, "traction", load, place));
    tractions.chain(c.pressure.iter().map(|p| (PRESSURE, "pressure", p.get_ref(), p.span())))
}

/// True if two values differ by more than rounding, where the largest of their kind has this size.
fn differ(a: f64, b: f64, size: f64) -> bool {
    (a - b).abs() > ROUNDING * size.max(a.abs()).max(b.abs())
}

fn largest(points: &[(f64, f64)]) -> f64 {
    points.iter().fold(0.0, |largest, p| p.1.abs().max(largest))
}

impl Checker<'_> {
    /// True if all bodies have mass from the start of the run.
    fn has_mass(&self) -> bool {
        let stepper = *self.scene.time.stepper.get_ref();
        stepper == Stepper::Explicit || stepper == Stepper::Implicit && self.scene.inertia().is_some()
    }

    /// True if faults follow the rates of a stage, which has checks of its own.
    fn drives_faults(&self, stage: &Stage) -> bool {
        let cycles = !self.scene.faults.is_empty() && !self.has_waves();
        cycles && pressing::stage(self.scene).is_none_or(|pressing| pressing.name != stage.name)
    }

    /// Checks that a motion begins at `present`, the displacement of its set at the start of a stage, if that is known \[m\].
    pub(super) fn begins(
        &mut self,
        stage: &Stage,
        set: &str,
        axis: usize,
        motion: &Motion,
        place: &Range<usize>,
        present: Option<f64>,
    ) {
        if self.drives_faults(stage) {
            return;
        }
        let (axis, name) = (AXES[axis], &stage.name);
        match (motion, present) {
            (Motion::Table(points), Some(present)) => {
                let Some(&(time, first)) = points.first() else { return };
                if differ(first, present, largest(points)) {
                    let (first, present) = (show(first), show(present));
                    let late = if time > 0.0 { format!(" at {time:?} s") } else { String::new() };
                    self.error(
                        place.clone(),
                        format!("the table of {axis} begins{late} with {first}, but `{set}` is at {present} when stage `{name}` begins, and would jump there"),
                        match points.file() {
                            Some(_) => "`tare = true` counts from the first value of the column, and `from` from a time of it".to_string(),
                            None => format!("begin it with `[\"0 s\", \"{present}\"]`: it then moves in a straight line to its next entry"),
                        },
                    );
                }
            }
            (Motion::Table(points), None) => {
                let first = show(points.first().map_or(0.0, |p| p.1));
                self.warn(
                    place.clone(),
                    format!("where `{set}` is along {axis} when stage `{name}` begins follows from the run, and its table begins with {first}: what they differ by acts at once"),
                    "`{ rate = { table = .. } }` moves it from where it is",
                );
            }
            (Motion::Fixed(value), Some(present)) if self.has_mass() && differ(*value, present, 0.0) => {
                self.error(
                    place.clone(),
                    format!(
                        "`{set}` has mass and would jump along {axis} from {} to {} when stage `{name}` begins: what follows would depend on the step",
                        show(present),
                        show(*value)
                    ),
                    "`{ to = .. }`, `{ rate = .. }` or a table gives the jump a duration",
                );
            }
            _ => {}
        }
    }

    /// Checks that tables of loads begin with the loads at the end of the stage before, and takes up those at the end of this one.
    pub(super) fn loads_begin(&mut self, stage: &Stage, present: &mut PresentLoads) {
        // A force that acts at once on bodies with mass has an impulse, and starts waves.
        let jumps = self.has_mass() || self.drives_faults(stage);
        for c in stage.conditions.iter().map(Spanned::get_ref) {
            let Some(set) = &c.set else { continue };
            for (component, what, load, place) in loads(c) {
                let key = (set.get_ref().clone(), component);
                let before = present.get(&key).copied().unwrap_or(0.0);
                let end = match load {
                    Loading::Fixed(value) | Loading::To(value) => *value,
                    Loading::Table(points) => points.last().map_or(before, |p| p.1),
                };
                if let Loading::Table(points) = load
                    && let Some(&(time, first)) = points.first()
                    && !jumps
                    && differ(first, before, largest(points))
                {
                    let late = if time > 0.0 { format!(" at {time:?} s") } else { String::new() };
                    self.error(
                        place,
                        format!("the table of `{what}` begins{late} with {first:?} Pa, but it is {before:?} Pa on `{}` when stage `{}` begins, and would jump there", set.get_ref(), stage.name),
                        match points.file() {
                            Some(_) => "`tare = true` counts from the first value of the column, and `from` from a time of it".to_string(),
                            None => format!("begin it with `[\"0 s\", \"{before:?} Pa\"]`: it then changes in a straight line to its next entry"),
                        },
                    );
                }
                present.insert(key, end);
            }
        }
    }
}
