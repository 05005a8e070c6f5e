//! Plans the bodies with mass that compute the ruptures of faults through cycles.

use super::{faults, masses, steps};
use crate::diagnostic::Diagnostic;
use crate::fault::Plan as Cycles;
use crate::fault::planner::{self as of_faults, Placed, in_space};
use crate::loading;
use crate::model::{self, Model};
use crate::plan::{ABOVE, BELOW};
use crate::ruptures::{AnyBodies, Bodies, Ruptures};
use crate::scene::law::LawChoice;
use crate::scene::model::{HandoverSpec, Scene};
use asperity_cycles::Handover;
use asperity_mechanics::dynamics::{Dashpot, Problem, Tie};
use asperity_mechanics::{Spring, Stage};

/// Steps of the stage in which ruptures run; they end by themselves.
const STEPS: f64 = 1e6;

/// Plans the ruptures of a scene whose cycles are planned.
///
/// # Errors
/// [`Diagnostic`] with the place in the scene.
pub fn ruptures(scene: &Scene, cycles: &Cycles) -> Result<Ruptures, Diagnostic> {
    Ok(match scene.kinematics.get_ref().dimension() {
        2 => {
            let (bodies, quiet) = bodies::<2>(scene, cycles)?;
            Ruptures { handover: handover(scene, quiet), bodies: AnyBodies::Two(Box::new(bodies)) }
        }
        _ => {
            let (bodies, quiet) = bodies::<3>(scene, cycles)?;
            Ruptures { handover: handover(scene, quiet), bodies: AnyBodies::Three(Box::new(bodies)) }
        }
    })
}

fn handover(scene: &Scene, quiet: f64) -> Handover {
    let spec = scene.time.handover.as_ref().map_or_else(HandoverSpec::default, |h| h.get_ref().clone());
    let above = spec.above.map_or(ABOVE, |v| v.get_ref().0);
    let below = spec.below.map_or(BELOW * above, |v| v.get_ref().0);
    Handover { above, below, quiet, kinetic: spec.kinetic.map_or(1.0, |k| *k.get_ref()) }
}

/// The bodies, and the time in which a shear wave crosses the faults and returns \[s\].
fn bodies<const D: usize>(scene: &Scene, cycles: &Cycles) -> Result<(Bodies<D>, f64), Diagnostic> {
    let model = model::build::<D>(scene)?;
    let density = masses::densities(scene, &model)?;
    let viscosity = steps::viscosity(scene);
    let stable = masses::stable(scene, &model, &density, viscosity)?;
    // The plan of the cycles has the warnings.
    let (placed, _) = of_faults::all_points(scene, &model, &mut Vec::new())?;
    let (creeping, placed): (Vec<_>, Vec<_>) = placed.into_iter().partition(|p| p.point.creep.is_some());
    let quiet = 2.0 * extent(&placed) / slowest(&model, &density);
    without_memory(scene, &placed)?;
    let same = placed.len() == cycles.points.len()
        && placed.iter().zip(&cycles.points).all(|(p, view)| in_space(&p.point.place.at) == view.at);
    if !same {
        return Err(Diagnostic::at(
            scene.time.stepper.span(),
            "the points of cycles and of ruptures differ",
            "report this with the scene",
        ));
    }
    let mut fault = faults::of(scene, &placed)?;
    if let Some(fault) = &mut fault {
        let tie = |p: &Placed<D>| Tie { minus: p.point.place.minus, plus: p.point.place.plus };
        fault.ties = creeping.iter().map(tie).collect();
    }
    let absorbing = masses::absorbing(scene, &model, &density)?;
    let courant = steps::courant(scene);
    let duration = STEPS * courant * stable.step;
    let stage = stage(&loading::stages(scene, &model)?[0], &absorbing, (duration, components(&model)));
    let problem = Problem {
        model,
        density,
        courant,
        viscosity,
        fault,
        absorbing,
        stages: vec![stage],
        velocity: Vec::new(),
    };
    Ok((Bodies { problem, stable }, quiet))
}

fn components<const D: usize>(model: &Model<D>) -> usize {
    model.idealisation.components()
}

/// The stage of a rupture: bodies move relative to their state at its start. What the loads prescribe stays as it is, but for
/// sides that absorb waves.
fn stage(quiet: &Stage, absorbing: &[Dashpot], (duration, components): (f64, usize)) -> Stage {
    let absorbs = |dof: &usize| absorbing.binary_search_by_key(&(dof / components), |d| d.node).is_ok();
    Stage {
        name: quiet.name.clone(),
        start: 0.0,
        end: duration,
        steps: None,
        frictionless: Vec::new(),
        motions: Vec::new(),
        turning: Vec::new(),
        loads: Vec::new(),
        fixed: quiet.fixed.iter().copied().filter(|dof| !absorbs(dof)).collect(),
        springs: quiet.springs.iter().map(|s| Spring { rate: 0.0, ..s.clone() }).collect(),
        weight: Vec::new(),
    }
}

/// Extent of what slides: the diagonal of the box around its points \[m\].
fn extent<const D: usize>(placed: &[Placed<D>]) -> f64 {
    let places: Vec<[f64; D]> = placed.iter().map(|p| p.point.place.at).collect();
    let (least, most) = model::bounds(&places);
    least.iter().zip(&most).map(|(a, b)| (b - a).powi(2)).sum::<f64>().sqrt()
}

/// Smallest speed of shear waves \[m/s\].
fn slowest<const D: usize>(model: &Model<D>, density: &[f64]) -> f64 {
    let of = |body: &asperity_mechanics::Body<D>| {
        let blocks = body.blocks.clone().zip(&body.elastic);
        blocks.map(|(block, elastic)| (elastic.shear() / density[block]).sqrt()).fold(f64::INFINITY, f64::min)
    };
    model.bodies.iter().map(of).fold(f64::INFINITY, f64::min)
}

/// Refuses laws whose states remember tractions: steps with mass keep them in another form.
fn without_memory<const D: usize>(scene: &Scene, placed: &[Placed<D>]) -> Result<(), Diagnostic> {
    for p in placed {
        let LawChoice::RateAndState { evolution, states, .. } = &p.law else { continue };
        let row = crate::laws::known().evolutions.iter().find(|e| e.name == evolution.name);
        let memory = row.and_then(|e| e.memory).and_then(|k| evolution.own.get(k).copied().flatten());
        let shear = memory.is_some_and(|c| c != 0.0);
        if !shear && states.iter().all(|s| s.alpha == 0.0) {
            continue;
        }
        let (key, help) = if shear {
            ("a memory of shear traction", "another `evolution`, such as \"ageing\" or \"slip\"")
        } else {
            ("a memory of normal traction", "leave `alpha` out")
        };
        let spec = scene.faults.values().nth(p.fault);
        return Err(Diagnostic::at(
            spec.map_or_else(|| scene.time.stepper.span(), |f| f.law.span()),
            format!("the law of a fault whose ruptures have mass has {key}"),
            help,
        ));
    }
    Ok(())
}
