//! Consistency of the motion of the sides of the bodies with the creep of a fault.
//!
//! If plane faults cut right through the bodies, creep and the motion of the sides prescribe the same slip twice: plates that slip everywhere at the
//! creep rate move rigidly and without strain. Let F_w be the force along slip caused by the sides, F_c that caused by creep, and F_s that which slip
//! of all other points at the creep rate would cause. Consistent plates have `F_w + F_c + F_s = 0`. Otherwise the sides move past each other at
//! `-F_w/(F_c + F_s)` times the creep rate.

use super::condensed::CondensedBodies;
use super::loaded_bodies::LoadedBodies;
use super::placed_point::{FaultPoints, PlacedPoint, slides};
use crate::reading::scene::model::{Creep, Fault as Spec, Scene};
use crate::shared::entry::Entry;
use crate::shared::model::Model;
use asperity_run::Warning;

/// Relative difference between the motion of the sides and creep that causes no warning: a hundred times the usual precision of given rates.
const AGREES: f64 = 0.01;
/// Fraction of the force of slip below which sides and creep count as exerting none: free sides.
const NOTHING: f64 = 1e-6;
/// Largest deviation from 1 of the product of parallel unit vectors: rounding of coordinates.
const PARALLEL: f64 = 1e-9;

/// Warning about sides that move against the slip of a fault, or not at its creep rate.
pub(super) fn check<const D: usize>(
    scene: &Scene,
    bodies: LoadedBodies<'_, D>,
    points: FaultPoints<'_, D>,
    condensed: &CondensedBodies,
) -> Option<Warning> {
    let (stage, placed) = (bodies.stage, points.sliding);
    let creep = condensed.creep.as_ref()?;
    let total = condensed.loading.mean(stage.end, placed.len());
    let sides: Vec<f64> = total.iter().zip(creep).map(|(all, creep)| all - creep).collect();
    if !stage.has_loads() && judged(scene, bodies.model, points) {
        return plate_warning(scene, placed, (&sides, creep), &condensed.with_plates);
    }
    let faults = Entry::all(&scene.faults);
    faults.iter().enumerate().filter_map(|(k, fault)| against(*fault, k, placed, (&sides, creep))).next()
}

/// True if the faults are plane and parallel, slip in one direction, creep, and cut right through the bodies.
fn judged<const D: usize>(scene: &Scene, model: &Model<D>, points: FaultPoints<'_, D>) -> bool {
    let all = || points.sliding.iter().chain(points.creeping);
    let Some(first) = all().next() else { return false };
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>().abs();
    let along = slides(first);
    let parallel = |p: &PlacedPoint<D>| {
        dot(&p.point.place.normal, &first.point.place.normal) > 1.0 - PARALLEL
            && dot(&slides(p), &along) > 1.0 - PARALLEL
    };
    let part = |node: usize| {
        let of = |parts: &Vec<Vec<usize>>| parts.iter().position(|p| p.binary_search(&node).is_ok());
        let body = model.bodies.iter().position(|b| b.nodes.contains(&node));
        body.map(|b| (b, of(&model.bodies[b].parts)))
    };
    let cut = |p: &PlacedPoint<D>| part(p.point.place.minus) != part(p.point.place.plus);
    let one_way = |p: &PlacedPoint<D>| p.point.creep.is_none_or(|c| c[0] != 0.0 && c[1] == 0.0);
    let drags = |f: &Spec| f.creep.as_ref().is_some_and(|c| !c.is_backslip());
    scene.faults.values().all(drags) && all().all(|p| parallel(p) && one_way(p) && cut(p))
}

/// Integral over the areas of the points of the traction along slip.
fn force<const D: usize>(placed: &[PlacedPoint<D>], tractions: &[f64]) -> f64 {
    placed.iter().zip(tractions).map(|(p, t)| p.point.place.area * t).sum()
}

/// Warning about sides that do not move at the creep rate of the faults between them.
fn plate_warning<const D: usize>(
    scene: &Scene,
    placed: &[PlacedPoint<D>],
    (sides, creep): (&[f64], &[f64]),
    exerted: &[f64],
) -> Option<Warning> {
    let faults = Entry::all(&scene.faults);
    let (by_sides, by_slip) = (force(placed, sides), force(placed, exerted));
    let by_creep = force(placed, creep) + by_slip;
    let most = by_sides.abs().max(by_creep.abs());
    if most <= NOTHING * by_slip.abs() || (by_sides + by_creep).abs() <= AGREES * most {
        return None;
    }
    let Entry { name, spec } = faults[placed.first()?.fault];
    let Creep { rate, .. } = spec.creep.as_ref()?;
    let creeps = rate.get_ref().0;
    let moves = -by_sides / by_creep * creeps;
    let what = if moves.abs() <= AGREES * creeps.abs() {
        "do not move past each other".to_string()
    } else {
        format!("move past each other at {moves:.4e} m/s")
    };
    Some(Warning::at(
        rate.span(),
        format!(
            "fault `{name}` creeps at {creeps:.4e} m/s, and the sides of the bodies {what} along its slip: the difference strains the bodies for as long as the run lasts"
        ),
        format!(
            "sides that move with the plates differ by the creep, such as {:e} and {:e} m/s along the slip",
            -0.5 * creeps,
            0.5 * creeps
        ),
    ))
}

/// Warning about a fault that the sides of the bodies drive against `rate` while creep drives it more strongly along
/// `rate`.
fn against<const D: usize>(
    Entry { name, spec }: Entry<'_, Spec>,
    fault: usize,
    placed: &[PlacedPoint<D>],
    (sides, creep): (&[f64], &[f64]),
) -> Option<Warning> {
    let own = |tractions: &[f64]| -> [f64; 2] {
        let of = placed.iter().zip(tractions).filter(|(p, _)| p.fault == fault);
        of.fold([0.0; 2], |[sum, size], (p, t)| {
            let force = p.point.place.area * t;
            [sum + force, size + force.abs()]
        })
    };
    let sense = spec.rate.get_ref().0.signum();
    let ([by_sides, size], [by_creep, _]) = (own(sides), own(creep));
    let opposed = by_sides * sense < -AGREES * size && by_creep * sense > 0.0;
    // If the sides prevail, the loads as a whole drive it against `rate`; another warning covers this.
    (opposed && (by_sides + by_creep) * sense > 0.0).then(|| {
        Warning::at(
            spec.rate.span(),
            format!(
                "the sides of the bodies drive fault `{name}` against `rate`, with {:.3} of the force with which its creep drives it along",
                (by_sides / by_creep).abs()
            ),
            "turn the sign of the motions of the sides, or those of `rate`, `shear` and creep",
        )
    })
}
