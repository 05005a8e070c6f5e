//! Turns a scene into a plan. All decisions about the model and the method are made here; later code does not refer to
//! the scene.

use super::friction::Friction;
use super::{
    AnyPlan, Plan, checks, doubts, events, inertia, interfaces, linear_solver, path, restraint,
    start_balance, stepping, stress_level, summary,
};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::Scene;
use crate::shared::entry::Entry;
use crate::shared::initial_stress;
use crate::shared::loading::{self, Stage, courses, sizes};
use crate::shared::model::{self, cuts, forecast, meshes, samples};
use asperity_mechanics::{Mass, Problem};
use asperity_scene::defaults;

/// Plans a scene of bodies and interfaces.
///
/// # Errors
/// [`Diagnostic`] with the position in the scene.
pub fn plan(scene: &Scene) -> Result<AnyPlan, Diagnostic> {
    Ok(match scene.kinematics.get_ref().dimension() {
        2 => AnyPlan::Two(Box::new(plan_in::<2>(scene)?)),
        _ => AnyPlan::Three(Box::new(plan_in::<3>(scene)?)),
    })
}

fn plan_in<const D: usize>(scene: &Scene) -> Result<Plan<D>, Diagnostic> {
    let model = model::build::<D>(scene)?;
    stress_level::check(scene, &model)?;
    let stages = loading::stages(scene, &model)?;
    let stepping = stepping::choose(scene)?;
    let loading = stages.iter().map(Stage::largest_rate).fold(0.0, f64::max);
    let planned =
        scene.interfaces.iter().map(|i| interfaces::plan(scene, &model, Entry::new(i.0, i.1), loading));
    let (interfaces, frictions): (Vec<_>, Vec<_>) =
        planned.collect::<Result<Vec<_>, _>>()?.into_iter().unzip();
    let path = path::choose(scene, &model, (&interfaces, &stages))?;
    let control = stepping::control(scene, &stages);
    let mass = inertia::mass(scene, &model, loading)?;
    let mut remarks = match mass {
        None => restraint::check(scene, &model, &stages, &interfaces)?,
        // Without inertia for the time being, bodies must be held.
        Some(Mass { handover: Some(_), .. }) => restraint::check(scene, &model, &stages, &interfaces)?,
        // Mass alone resists the motion of bodies that nothing holds.
        Some(_) => Vec::new(),
    };
    remarks.extend(sizes::file_extents(scene, &model));
    let (followed, passed_over) = courses::remarks_and_warnings(scene);
    remarks.extend(followed);
    remarks.extend(cuts::notes(scene, &model.mesh));
    remarks.extend(meshes::left_out(&model));
    remarks.extend(frictions.iter().flatten().flat_map(|f| f.notes.iter().cloned()));
    let (start_gaps, doubts) =
        doubts::gaps_and_warnings(scene, &model, (&interfaces, &frictions), &stages, &stepping)?;
    let (balance, unbalanced) =
        start_balance::remarks_and_warning(scene, &model, (&interfaces, &stages), &stepping)?;
    remarks.extend(balance);
    let solver = linear_solver::choose(scene, &model, &interfaces, &stages, path, &stepping)?;
    let mut summary =
        summary::summarise(scene, &model, (&interfaces, &stages), path, &stepping, &solver, remarks);
    forecast::fits(scene, summary.memory_bytes)?;
    summary.start_gaps = start_gaps;
    if let Some(mass) = &mass {
        summary.add_inertia(mass);
    }
    let of_files = frictions.iter().flatten().flat_map(|f| f.warnings.iter().cloned());
    let doubts = doubts.into_iter().chain(unbalanced).chain(of_files).chain(passed_over);
    crate::doubts::add(&mut summary.warnings, doubts);
    let initial_stress = model.bodies.iter().map(|b| initial_stress::body_field(scene, &b.name)).collect();
    let samples = samples::find(scene, &model)?;
    let checks =
        checks::collect(scene, &model, (&interfaces, &frictions), &stages, (summary.memory_bytes, &solver))?;
    let events = events::plan(scene, &model, &interfaces)?;
    let thetas = frictions.iter().map(|f| f.as_ref().map_or_else(Vec::new, Friction::thetas)).collect();
    Ok(Plan {
        title: scene.title.clone(),
        problem: Problem {
            model,
            initial_stress,
            interfaces,
            stages,
            path,
            solver,
            stepping,
            control,
            mass,
            samples,
        },
        field_outputs: scene.output.fields.as_ref().map_or(defaults::FIELDS, |f| *f.get_ref()),
        profile_outputs: scene.output.profiles.as_ref().map_or(defaults::PROFILES, |f| *f.get_ref()),
        events,
        thetas,
        summary,
        checks,
    })
}
