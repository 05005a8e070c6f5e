//! Turns a scene into a plan. All decisions about the model and the method are made here; later code does not refer to
//! the scene.

use super::assembly::Assembly;
use super::friction::Friction;
use super::{
    AnyPlan, Plan, StartGap, adjustment, checks, doubts, events, force_notes, inertia, linear_solver,
    mirrors, path, restraint, start_balance, stepping, summary,
};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::Scene;
use crate::shared::initial_stress;
use crate::shared::loading::{courses, sizes};
use crate::shared::model::{cuts, forecast, meshes, samples};
use asperity_mechanics::{Mass, Problem};
use asperity_run::Warning;
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
    let mut assembly = Assembly::<D>::read(scene)?;
    mirrors::apply(&mut assembly);
    adjustment::apply(&mut assembly)?;
    let path = path::choose(&assembly)?;
    let mass = inertia::mass(scene, &assembly.model, assembly.largest_rate())?;
    let Findings { remarks, start_gaps, doubts } = Findings::new(&assembly, mass.as_ref())?;
    let (path, solver) = linear_solver::choose(&assembly, path)?;
    let mut summary = summary::summarise(&assembly, path, &solver, remarks);
    forecast::fits(scene, summary.memory_bytes)?;
    summary.start_gaps = start_gaps;
    if let Some(mass) = &mass {
        summary.add_inertia(mass);
    }
    crate::doubts::add(&mut summary.warnings, doubts);
    let samples = samples::find(scene, &assembly.model)?;
    let checks = checks::collect(&assembly, summary.memory_bytes, &solver)?;
    let events = events::plan(scene, &assembly.model, &assembly.interfaces)?;
    stepping::resolvable(scene, assembly.model.scale)?;
    let control = stepping::control(scene, &assembly.stages);
    let Assembly { model, stages, stepping, interfaces, frictions, .. } = assembly;
    let thetas = frictions.iter().map(|f| f.as_ref().map_or_else(Vec::new, Friction::thetas)).collect();
    let initial_stress = model.bodies.iter().map(|b| initial_stress::body_field(scene, &b.name)).collect();
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

/// Findings about bodies before the first step.
struct Findings {
    remarks: Vec<String>,
    /// Positions of the sides of the interfaces.
    start_gaps: Vec<StartGap>,
    doubts: Vec<Warning>,
}

impl Findings {
    fn new<const D: usize>(assembly: &Assembly<'_, D>, mass: Option<&Mass>) -> Result<Self, Diagnostic> {
        let Assembly { scene, model, stages, interfaces, .. } = assembly;
        let mut remarks = match mass {
            // Mass alone resists the motion of bodies that nothing holds.
            Some(Mass { handover: None, .. }) => Vec::new(),
            // Without inertia, be it for the time being, bodies must be held.
            _ => restraint::check(scene, model, stages, interfaces)?,
        };
        remarks.extend(sizes::file_extents(scene, model));
        let (followed, passed_over) = courses::remarks_and_warnings(scene);
        remarks.extend(followed);
        remarks.extend(cuts::notes(scene, &model.mesh));
        remarks.extend(meshes::left_out(model));
        remarks.extend(force_notes::notes(scene, model, interfaces));
        remarks.extend(assembly.laws().flat_map(|f| f.notes.iter().cloned()));
        let (start_gaps, mut doubts) = doubts::gaps_and_warnings(assembly)?;
        let (balance, unbalanced) = start_balance::remarks_and_warning(assembly)?;
        remarks.extend(balance);
        doubts.extend(unbalanced);
        doubts.extend(assembly.laws().flat_map(|f| f.warnings.iter().cloned()));
        doubts.extend(passed_over);
        Ok(Self { remarks, start_gaps, doubts })
    }
}
