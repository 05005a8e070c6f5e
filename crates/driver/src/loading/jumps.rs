//! Forces that jump, which the steppers that follow rates cannot take up.
//!
//! Its steps follow rates: a force that is there at once has none, and a part of it, as the R-minimum rule would want, is not
//! meant. Displacements that jump are prescribed and
//! matter to faults only, whose tractions are given at the start.

use crate::plan::PlanError;
use crate::scene::model::{Condition, Loading, Motion, Scene, Spanned, Stage, Stepper};
use std::collections::BTreeMap;

/// What a set does along an axis.
type Of<T> = BTreeMap<(String, usize), T>;

/// The stepper that refuses forces that jump, where it is one that does.
fn follower(scene: &Scene) -> Option<&'static str> {
    match scene.time.stepper.get_ref() {
        Stepper::Implicit => None,
        Stepper::StaticExplicit => Some("static-explicit"),
        Stepper::FaultOde => Some("fault-ode"),
    }
}

/// Refuses weight and initial stress, which act from the start.
///
/// # Errors
/// [`PlanError`] pointing at them.
pub(super) fn of_bodies(scene: &Scene) -> Result<(), PlanError> {
    // What they exert on faults is there before the start.
    let Some(stepper) = follower(scene).filter(|_| scene.faults.is_empty()) else { return Ok(()) };
    for (name, body) in &scene.bodies {
        let gravity = body.gravity.as_ref().map(|g| ("gravity", g.span()));
        let stress = body.initial_stress.as_ref().map(|s| ("initial_stress", s.span()));
        if let Some((key, place)) = gravity.or(stress) {
            return Err(PlanError::at(
                place,
                format!(
                    "`{key}` of body `{name}` acts at once, and the stepper \"{stepper}\" follows rates only"
                ),
                "use `stepper = \"implicit\"`, or ramped tractions".into(),
            ));
        }
    }
    Ok(())
}

/// Refuses loads and releases of a stage that change a force at once; `before` are the motions and the values of the loads at the
/// end of the stage before.
///
/// # Errors
/// [`PlanError`] pointing at the condition.
pub(super) fn of_stage(
    scene: &Scene,
    stage: &Stage,
    (held, present): (&Of<Motion>, &Of<f64>),
    loads: &Of<Loading>,
) -> Result<(), PlanError> {
    let Some(stepper) = follower(scene) else { return Ok(()) };
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
            return Err(PlanError::at(
                place(&key.0),
                format!(
                    "the load on `{}` jumps from {from:?} to {first:?} Pa in stage `{}`, and the stepper \"{stepper}\" follows \
                     rates only",
                    key.0, stage.name
                ),
                "ramp it, such as `{ to = \"10 MPa\" }`, or use `stepper = \"implicit\"`".into(),
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
            if at_once && *scene.time.stepper.get_ref() == Stepper::FaultOde {
                return Err(PlanError::at(
                    motion.span(),
                    "a displacement that is there at once loads the faults, whose tractions at the start are given".into(),
                    "motions of a scene with faults begin at zero: `{ rate = .. }`, `{ to = .. }` or a table".into(),
                ));
            }
        }
        for (axis, motion) in [&c.x, &c.y, &c.z].into_iter().enumerate() {
            let Some(set) = &c.set else { continue };
            let was_held = held.get(&(set.get_ref().clone(), axis)).is_some_and(|m| *m != Motion::Free);
            if let Some(motion) = motion.as_ref().filter(|m| *m.get_ref() == Motion::Free && was_held) {
                return Err(PlanError::at(
                    motion.span(),
                    format!(
                        "`{set}` is released with the force that held it, which vanishes at once, and the stepper \"{stepper}\" \
                         follows rates only"
                    ),
                    "use `stepper = \"implicit\"`".into(),
                ));
            }
        }
    }
    Ok(())
}
