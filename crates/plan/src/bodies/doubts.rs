//! Warnings about a scene whose bodies have been built and whose stages have been resolved.

use super::assembly::Assembly;
use super::friction::Friction;
use super::penalty::{self, SofterCells};
use super::start_gaps::{self, MeasuredGaps, StartContact};
use super::surfaces::FacingSurfaces;
use super::{PlannedInterface, StartGap, coarse, cohesive, damping, overlaps, rim, shared_nodes};
use crate::doubts as shared;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Interface, Scene};
use crate::shared::checks::meetings;
use crate::shared::entry::Entry;
use crate::shared::loading::{Stage, sizes};
use crate::shared::model::locking;
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
    assembly: &Assembly<'_, D>,
) -> Result<(Vec<StartGap>, Vec<Warning>), Diagnostic> {
    let Assembly { scene, model, stages, interfaces, frictions, .. } = assembly;
    let (mut starts, mut doubts) = (Vec::new(), sizes::doubts(scene, model, stages));
    doubts.extend(locking::doubts(scene, model)?);
    doubts.extend(meetings::doubts(scene, model));
    doubts.extend(tolerance(scene, stages));
    let events = scene.events.as_ref();
    // Stages before the last press bodies.
    let loading = stages.last().map_or(0.0, Stage::largest_rate);
    doubts.extend(events.and_then(|e| shared::thresholds(e, thresholds::from_spec(Some(e)), loading, false)));
    for (planned, friction) in interfaces.iter().zip(frictions) {
        starts.push(examine(assembly, planned, friction.as_ref(), &mut doubts)?);
    }
    doubts.extend(shared_nodes::doubts(assembly, &starts)?);
    Ok((starts.into_iter().map(|measured| measured.start).collect(), doubts))
}

/// Position of the sides of an interface before the first step. Adds warnings about it.
fn examine<const D: usize>(
    assembly: &Assembly<'_, D>,
    planned: &PlannedInterface,
    friction: Option<&Friction>,
    doubts: &mut Vec<Warning>,
) -> Result<MeasuredGaps, Diagnostic> {
    let Assembly { scene, model, stages, .. } = assembly;
    let own = assembly.entry(planned);
    let Entry { name, spec } = own;
    let surfaces = FacingSurfaces::find(model, own)?;
    let mut measured = start_gaps::measure(assembly, planned, surfaces.slave.sides)?;
    let softer = SofterCells::from_sides(model, &surfaces);
    doubts.extend(penalty::doubts(name, &spec.enforcement, &softer));
    doubts.extend(rim::doubt(planned, spec, &measured));
    measured.start.overlap_traction = overlaps::traction(model, &measured, planned, &softer);
    let size = surfaces.slave.cell_size(model);
    let contact = StartContact { spec, planned, start: &measured.start, size };
    doubts.extend(start_gaps::doubts(&contact, stages, scene.inertia().is_some()));
    let load = cohesive::pressed(scene, model, stages, own);
    doubts.extend(overlaps::doubt(&contact, &softer, stages, load));
    doubts.extend(coarse::doubts(model, planned, &surfaces, spec));
    doubts.extend(first_order(name, spec));
    doubts.extend(resolution(own, planned, load)?);
    doubts.extend(damping::doubt(scene, model, own, &surfaces)?);
    if let Some(mean) = load.filter(|mean| *mean > 0.0) {
        let nodes: Vec<usize> = planned.slave.iter().map(|point| point.0).collect();
        let shortest = cohesive::shortest(model, &surfaces, &nodes, friction);
        doubts.extend(shortest.and_then(|[_, nucleation]| {
            cohesive::nucleation(model, planned, spec, nucleation.length / mean)
        }));
    }
    Ok(measured)
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

/// Warning about too few points for friction under the normal traction that follows from the loads, if it is known \[Pa\], and about
/// a key without effect.
fn resolution(
    Entry { name, spec }: Entry<'_, Interface>,
    planned: &PlannedInterface,
    known: Option<f64>,
) -> Result<Option<Warning>, Diagnostic> {
    let Some(resolved) = &planned.resolved else {
        return Ok(spec.under_resolved.as_ref().map(|key| {
            let message = format!("`under_resolved` of interface `{name}` decides nothing: its friction does not weaken with slip");
            Warning::at(key.span(), message, "remove it")
        }));
    };
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
