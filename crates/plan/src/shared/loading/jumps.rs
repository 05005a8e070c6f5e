//! Checks that forces and displacements on faults do not jump. Initial tractions of faults are given, and evolve by rates from there.

use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::check::pressing;
use crate::reading::scene::model::{Condition, Loading, Motion, Scene, Spanned, Stage, Stepper};
use std::collections::BTreeMap;

/// Prescriptions by set and axis.
type Prescriptions<T> = BTreeMap<(String, usize), T>;

/// Motions and loads at the end of the previous stage.
#[derive(Clone, Copy)]
pub(super) struct StageStart<'a> {
    pub held: &'a Prescriptions<Motion>,
    /// Values of the loads.
    pub present: &'a Prescriptions<f64>,
}

/// Refuses loads and releases in a stage with faults that change a force abruptly.
///
/// # Errors
/// [`Diagnostic`] at the condition.
pub(super) fn refuse(
    scene: &Scene,
    stage: &Stage,
    StageStart { held, present }: StageStart<'_>,
    loads: &Prescriptions<Loading>,
) -> Result<(), Diagnostic> {
    if scene.faults.is_empty() || *scene.time.stepper.get_ref() == Stepper::Explicit {
        return Ok(());
    }
    let place = |set: &str| {
        let of_set = |c: &&Spanned<Condition>| c.get_ref().set.as_ref().is_some_and(|s| s.get_ref() == set);
        stage.conditions.iter().find(of_set).map(|c| c.span()).unwrap_or_default()
    };
    for (key, loading) in loads {
        let from = present.get(key).copied().unwrap_or(0.0);
        let first = match loading {
            Loading::Fixed(value) => *value,
            Loading::To(_) => from,
            Loading::Table(points) => points.first().map_or(from, |p| p.1),
        };
        if first != from {
            return Err(Diagnostic::at(
                place(&key.0),
                format!(
                    "the load on `{}` jumps from {from:?} to {first:?} Pa in stage `{}`, and faults follow rates",
                    key.0, stage.name
                ),
                "ramp it, such as `{ to = \"10 MPa\" }`, or begin with this value",
            ));
        }
    }
    for condition in &stage.conditions {
        let c = condition.get_ref();
        for motion in [&c.x, &c.y, &c.z].into_iter().flatten() {
            let at_once = match motion.get_ref() {
                Motion::Fixed(value) => *value != 0.0,
                Motion::Table(points) => points.first().is_some_and(|p| p.1 != 0.0),
                _ => false,
            };
            if at_once {
                return Err(Diagnostic::at(
                    motion.span(),
                    "a displacement that is there at once loads the faults, whose tractions at the start are given",
                    "motions of a scene with faults begin at zero: `{ rate = .. }`, `{ to = .. }` or a table",
                ));
            }
        }
        for (axis, motion) in [&c.x, &c.y, &c.z].into_iter().enumerate() {
            let Some(set) = &c.set else { continue };
            let before = held.get(&(set.get_ref().clone(), axis));
            let was_held = before.is_some_and(|m| *m != Motion::Free);
            if let (Some(pressing), Some(motion)) =
                (pressing::stage(scene), motion.as_ref().filter(|m| begins_at_zero(m.get_ref(), before)))
            {
                return Err(Diagnostic::at(
                    motion.span(),
                    format!(
                        "`{set}` is not held at zero along {} in stage `{}`, and would have to return there at once",
                        ["x", "y", "z"][axis],
                        pressing.name
                    ),
                    "`\"hold\"` keeps it where it is; `{ to = .. }` and `{ rate = .. }` move it from there",
                ));
            }
            if let Some(motion) = motion.as_ref().filter(|m| *m.get_ref() == Motion::Free && was_held) {
                return Err(Diagnostic::at(
                    motion.span(),
                    format!(
                        "`{set}` is released with the force that held it, which vanishes at once, and faults follow rates"
                    ),
                    "leave it held",
                ));
            }
        }
    }
    Ok(())
}

/// True for a motion that begins at zero, of a set that the stage before has not held there.
fn begins_at_zero(motion: &Motion, before: Option<&Motion>) -> bool {
    matches!(motion, Motion::Fixed(_) | Motion::Table(_)) && before != Some(&Motion::Fixed(0.0))
}
