//! Checks that forces and displacements on faults do not jump. Initial tractions of faults are given, and evolve by rates from there.

use crate::diagnostic::Diagnostic;
use crate::scene::check::pressing;
use crate::scene::model::{Condition, Loading, Motion, Scene, Spanned, Stage, Stepper};
use std::collections::BTreeMap;

/// Prescriptions by set and axis.
type Of<T> = BTreeMap<(String, usize), T>;

/// Refuses loads and releases in a stage with faults that change a force abruptly. `held` and `present` are the motions and load values at the end of
/// the previous stage.
///
/// # Errors
/// [`Diagnostic`] at the condition.
pub(super) fn of_stage(
    scene: &Scene,
    stage: &Stage,
    (held, present): (&Of<Motion>, &Of<f64>),
    loads: &Of<Loading>,
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
            let was_held = held.get(&(set.get_ref().clone(), axis)).is_some_and(|m| *m != Motion::Free);
            let pressing = pressing::stage(scene);
            let placed = |m: &&Spanned<Motion>| {
                matches!(m.get_ref(), Motion::Fixed(_) | Motion::To(_) | Motion::Table(_))
            };
            if let (Some(motion), Some(pressing)) =
                (motion.as_ref().filter(|m| placed(m) && !was_held), pressing)
            {
                return Err(Diagnostic::at(
                    motion.span(),
                    format!(
                        "`{set}` is free along {} in stage `{}`, which moves it away from zero",
                        ["x", "y", "z"][axis],
                        pressing.name
                    ),
                    "hold it in that stage as well, or hold it where it then is: `\"hold\"`",
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
