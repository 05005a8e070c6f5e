//! Warnings about a scene whose bodies have been built and whose stages have been resolved.

use super::friction::Friction;
use super::penalty::{self, SofterCells};
use super::{PlannedInterface, StartGap, Stepping, coarse, cohesive, damping, overlaps, start_gaps};
use crate::doubts as shared;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Interface, Scene};
use crate::shared::entry::Entry;
use crate::shared::loading::{Stage, sizes};
use crate::shared::model::{self, Model, locking};
use crate::shared::thresholds;
use asperity_friction::evolution;
use asperity_run::Warning;
use asperity_scene::lengths::show;

/// Largest useful slip error per step, as a fraction of the prescribed motion; a larger one does not limit the steps.
const BOUNDS_NOTHING: f64 = 0.1;

/// Positions of the sides of the interfaces before the first step, and warnings about the scene.
///
/// # Errors
/// [`Diagnostic`] for sides that are certainly wrong.
pub fn gaps_and_warnings<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    (interfaces, frictions): (&[PlannedInterface], &[Option<Friction>]),
    stages: &[Stage],
    stepping: &Stepping,
) -> Result<(Vec<StartGap>, Vec<Warning>), Diagnostic> {
    let (mut starts, mut doubts) = (Vec::new(), sizes::doubts(scene, model, stages));
    doubts.extend(locking::doubts(scene, model)?);
    doubts.extend(tolerance(scene, stages));
    let events = scene.events.as_ref();
    // Stages before the last press bodies.
    let loading = stages.last().map_or(0.0, Stage::largest_rate);
    doubts.extend(events.and_then(|e| shared::thresholds(e, thresholds::from_spec(Some(e)), loading, false)));
    for (planned, friction) in interfaces.iter().zip(frictions) {
        let spec = &scene.interfaces[&planned.name];
        let own = Entry::new(&planned.name, spec);
        let sides = model::sides(model, &spec.slave)?;
        let mut measured = start_gaps::measure(model, stepping, planned, (spec, sides))?;
        if let Some(body) = model.body_of(spec.slave.get_ref()).map(|b| &model.bodies[b]) {
            let h = model.element_size(body, sides);
            let bonded = planned.law.as_ref().is_some_and(|l| l.bonded());
            let facing = model.body_of(spec.master.get_ref()).map_or(body, |b| &model.bodies[b]);
            let softer =
                SofterCells::from_sides(model, (body, sides), (facing, model::sides(model, &spec.master)?));
            doubts.extend(penalty::doubts(&planned.name, &spec.enforcement, &softer));
            measured.0.overlap_traction = overlaps::traction(model, &measured, (spec, planned), &softer);
            let start = &measured.0;
            doubts.extend(start_gaps::doubts(start, (spec, bonded), (stages, scene.inertia().is_some()), h));
            let load = cohesive::pressed(scene, model, stages, own);
            doubts.extend(overlaps::doubt((start, spec, planned), (&softer, h), (stages, load)));
        }
        doubts.extend(coarse::doubts(&model.mesh.nodes, planned, spec));
        doubts.extend(first_order(&planned.name, spec));
        starts.push(measured.0);
        doubts.extend(resolution(scene, model, stages, planned)?);
        let facing = (sides, model::sides(model, &spec.master)?);
        doubts.extend(damping::doubt(scene, model, own, facing)?);
        let pressed = cohesive::pressed(scene, model, stages, own);
        let own = (spec, friction.as_ref());
        doubts.extend(pressed.and_then(|mean| cohesive::nucleation(model, own, (planned, sides), mean)));
    }
    Ok((starts, doubts))
}

/// Warning about an evolution law whose steps are first order, while the error estimate assumes second order.
fn first_order(name: &str, spec: &Interface) -> Option<Warning> {
    let evolution = spec.law.as_ref()?.get_ref().evolution.as_ref()?;
    evolution::definition(evolution.get_ref())?.memory?;
    let message = format!(
        "with the evolution \"{}\" steps of interface `{name}` are of first order in time: friction errs by some twenty times \
         what `friction_tolerance` allows",
        evolution.get_ref()
    );
    let help = "lower `friction_tolerance` in proportion, and compare with a run at half of it";
    Some(Warning::at(evolution.span(), message, help))
}

/// Warning about too few points for friction under the normal traction that follows from the loads, and about a key
/// without effect.
fn resolution<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    stages: &[Stage],
    planned: &PlannedInterface,
) -> Result<Option<Warning>, Diagnostic> {
    let (name, spec) = (planned.name.as_str(), &scene.interfaces[&planned.name]);
    let Some(resolved) = &planned.resolved else {
        return Ok(spec.under_resolved.as_ref().map(|key| {
            let message = format!("`under_resolved` of interface `{name}` decides nothing: its friction does not weaken with slip");
            Warning::at(key.span(), message, "remove it")
        }));
    };
    let known = cohesive::pressed(scene, model, stages, Entry::new(name, spec));
    known.map_or(Ok(None), |mean| cohesive::check(resolved, name, mean))
}

/// Warning about a slip error tolerance as large as the motion.
fn tolerance(scene: &Scene, stages: &[Stage]) -> Option<Warning> {
    let given = scene.time.tolerance.as_ref()?;
    let travel: f64 = stages.iter().map(Stage::travel).sum();
    let bound = given.get_ref().0;
    (travel > 0.0 && bound > BOUNDS_NOTHING * travel && !scene.interfaces.is_empty()).then(|| {
        let message = format!(
            "`tolerance` allows an error of slip of {} in each step, and the conditions move bodies by {} in all",
            show(bound),
            show(travel)
        );
        let help = "a small share of the motion is a bound; left out, 2e-5 of the largest travel of a stage is taken";
        Warning::at(given.span(), message, help)
    })
}
