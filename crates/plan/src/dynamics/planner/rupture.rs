//! Plans the bodies with mass that compute the ruptures of faults through cycles.

use super::doubts::QuietTime;
use super::faults::apart;
use super::{doubts, faults, masses, steps};
use crate::faults::Plan as Cycles;
use crate::faults::planner::{self as of_faults, PlacedPoint, Remarks, in_space};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::law::LawChoice;
use crate::reading::scene::model::Scene;
use crate::shared::model::{self, Model};
use crate::shared::ruptures::{AnyBodies, Bodies, Ruptures};
use crate::shared::{handover, impedance, loading};
use asperity_cycles::Handover;
use asperity_mechanics::dynamics::{Dashpot, Problem};
use asperity_mechanics::{Pace, Spring, Stage};
use asperity_run::Warning;

/// Steps of the stage in which ruptures run; they end by themselves.
const STEPS: f64 = 1e6;

/// Plans the ruptures of a scene whose cycles are planned, and says what is doubtful about them.
///
/// # Errors
/// [`Diagnostic`] with the place in the scene.
pub fn ruptures(scene: &Scene, cycles: &Cycles) -> Result<(Ruptures, Vec<Warning>), Diagnostic> {
    let (bodies, quiet, loading, doubts) = match scene.kinematics.get_ref().dimension() {
        2 => {
            let (bodies, quiet, loading, doubts) = bodies::<2>(scene, cycles)?;
            (AnyBodies::Two(Box::new(bodies)), quiet, loading, doubts)
        }
        _ => {
            let (bodies, quiet, loading, doubts) = bodies::<3>(scene, cycles)?;
            (AnyBodies::Three(Box::new(bodies)), quiet, loading, doubts)
        }
    };
    let handover::Bounds { above, below, kinetic } = handover::bounds(scene, loading)?;
    Ok((Ruptures { handover: Handover { above, below, quiet, kinetic }, bodies }, doubts))
}

/// The bodies, the time in which a shear wave crosses the faults and returns \[s\], the largest rate of the loads \[m/s\], and what is
/// doubtful.
fn bodies<const D: usize>(
    scene: &Scene,
    cycles: &Cycles,
) -> Result<(Bodies<D>, f64, f64, Vec<Warning>), Diagnostic> {
    let model = model::build::<D>(scene)?;
    let density = masses::densities(scene, &model)?;
    let viscosity = steps::viscosity(scene);
    let stable = masses::stable(scene, &model, &density, viscosity)?;
    // The plan of the cycles has the warnings.
    let placed = of_faults::all_points(scene, &model, &mut Remarks::default())?;
    let (creeping, placed) = apart(placed);
    let quiet = 2.0 * extent(&placed) / impedance::slowest(&model, &density);
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
    let fault = faults::assemble(scene, &placed, &creeping)?;
    let absorbing = masses::absorbing(scene, &model, &density)?;
    let mut warnings = doubts::unlike(scene, &placed, false);
    if absorbing.is_empty() {
        // A wave crosses the faults, and then they must be quiet.
        warnings.extend(doubts::returned(
            &model,
            &placed,
            impedance::slowest(&model, &density),
            QuietTime { place: scene.time.stepper.span(), what: "a rupture", duration: 1.5 * quiet },
        ));
    }
    let courant = steps::courant(scene);
    let duration = STEPS * courant * stable.step;
    let stages = loading::stages(scene, &model)?;
    // A stage before the last presses the bodies.
    let quasi_static = &stages[stages.len() - 1];
    let loading = quasi_static.largest_rate().max(of_faults::fastest_plates(scene));
    let stage = stage(quasi_static, &absorbing, (duration, components(&model)));
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
    Ok((Bodies { problem, stable }, quiet, loading, warnings))
}

fn components<const D: usize>(model: &Model<D>) -> usize {
    model.idealisation.components()
}

/// The stage of a rupture: bodies move relative to their state at its start. What the loads prescribe stays as it is, but for
/// absorbing sides.
fn stage(quiet: &Stage, absorbing: &[Dashpot], (duration, components): (f64, usize)) -> Stage {
    let absorbs = |dof: &usize| absorbing.binary_search_by_key(&(dof / components), |d| d.node).is_ok();
    Stage {
        fixed: quiet.fixed.iter().copied().filter(|dof| !absorbs(dof)).collect(),
        springs: quiet.springs.iter().map(|s| Spring { rate: Pace::Steady(0.0), ..s.clone() }).collect(),
        ..Stage::free(&quiet.name, duration)
    }
}

/// Extent of what slides: the diagonal of the box around its points \[m\].
fn extent<const D: usize>(placed: &[PlacedPoint<D>]) -> f64 {
    let places: Vec<[f64; D]> = placed.iter().map(|p| p.point.place.at).collect();
    let (least, most) = model::bounds(&places);
    least.iter().zip(&most).map(|(a, b)| (b - a).powi(2)).sum::<f64>().sqrt()
}

/// Refuses laws whose states remember tractions: steps with mass keep them in another form.
fn without_memory<const D: usize>(scene: &Scene, placed: &[PlacedPoint<D>]) -> Result<(), Diagnostic> {
    for p in placed {
        let LawChoice::RateAndState { evolution, states, .. } = &p.law else { continue };
        let row = asperity_laws::known().evolutions.iter().find(|e| e.name == evolution.name);
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
