//! Positions in homogeneous rock whose motion is written.

use super::super::super::receivers::{Receiver, Receivers};
use super::super::placed_point::{PlacedPoint, in_space, slides};
use super::dislocations::{Dislocations, LaggingFaults};
use super::sites::{self, ReceiverPosition};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Fault as Spec, Scene};
use crate::reading::scene::units::Length;
use crate::shared::idealisation;

/// Difference of unit normals beyond which a fault is not plane: rounding of the directions of its cells.
const PLANE: f64 = 1e-9;

/// Distance from the plane of a fault, relative to the distance from its first point, below which a position lies on it:
/// rounding.
const ON_PLANE: f64 = 1e-9;

/// Receivers of a scene, with the rates of the plates at all points.
///
/// # Errors
/// [`Diagnostic`] at a receiver that has no motion, or at a site that is not on the map.
pub(super) fn plan<const D: usize>(
    scene: &Scene,
    Dislocations { patches, rock }: Dislocations<'_>,
    LaggingFaults { placed, plates: lag }: LaggingFaults<'_, D>,
    notes: &mut Vec<String>,
) -> Result<Receivers, Diagnostic> {
    let given = scene.output.receivers.iter().map(|(name, spec)| {
        let at: [f64; 3] = std::array::from_fn(|c| spec.get_ref().get(c).map_or(0.0, |x: &Length| x.0));
        (name.clone(), spec.span(), at)
    });
    let all: Vec<ReceiverPosition> = given.chain(sites::positions(scene, D == 3)?).collect();
    let relative = bent(scene, placed);
    if let Some(why) = relative.as_ref().filter(|_| !all.is_empty()) {
        notes.push(relative_to_plates("receivers move", why));
    }
    let mut receivers = Receivers { all: Vec::new(), rates: lag.rates.clone(), axes: axes(scene) };
    for (name, span, at) in all {
        let per_slip: Vec<[f64; 3]> =
            (0..lag.tangents).flat_map(|component| patches.displacements(&at, component, rock)).collect();
        if !per_slip.iter().flatten().all(|u| u.is_finite()) {
            return Err(Diagnostic::at(
                span,
                format!(
                    "receiver `{name}` lies on the edge of a cell of a fault, where displacements are not defined"
                ),
                "a position beside the fault",
            ));
        }
        let plates = if relative.is_some() { Ok([0.0; 3]) } else { plates(scene, placed, &at) };
        let plates = plates.map_err(|FaultPlane(fault)| {
            let message =
                format!("receiver `{name}` lies on the plane of fault `{fault}`, whose sides move apart");
            Diagnostic::at(span, message, "a position on one of its sides")
        })?;
        receivers.all.push(Receiver { name, at, per_slip, plates, loads: Vec::new() });
    }
    Ok(receivers)
}

/// Axes along which points move.
pub(super) fn axes(scene: &Scene) -> Vec<usize> {
    match idealisation::from_kinematics(*scene.kinematics.get_ref()).components() {
        1 => vec![2],
        components => (0..components).collect(),
    }
}

/// A fault on whose plane a position lies.
pub(super) struct FaultPlane<'a>(&'a str);

/// Reason why the plates of a scene do not move as rigid blocks: a fault with creep that is not plane, or two that are not parallel. Slip at the
/// rate of creep on all of them then deforms the blocks, and motion of receivers is that of slip less the creep.
pub(super) fn bent<const D: usize>(scene: &Scene, placed: &[PlacedPoint<D>]) -> Option<String> {
    let mut first: Option<(&String, [f64; 3])> = None;
    for (fault, (name, _)) in scene.faults.iter().enumerate().filter(|(_, (_, spec))| spec.creep.is_some()) {
        let normals = placed.iter().filter(|p| p.fault == fault).map(|p| in_space(&p.point.place.normal));
        let normals: Vec<[f64; 3]> = normals.collect();
        let Some(own) = normals.first() else { continue };
        if normals.iter().any(|n| 1.0 - dot(n, own) > PLANE) {
            return Some(format!("fault `{name}`, which creeps beyond its ends, is not plane"));
        }
        match first {
            Some((other, normal)) if 1.0 - dot(own, &normal).abs() > PLANE => {
                return Some(format!(
                    "faults `{other}` and `{name}`, which creep beyond their ends, are not parallel"
                ));
            }
            Some(_) => {}
            None => first = Some((name, *own)),
        }
    }
    None
}

/// Note on motion without that of the plates.
pub(super) fn relative_to_plates(what: &str, why: &str) -> String {
    format!("{what} relative to the plates below: {why}, so that plates do not move as rigid blocks")
}

fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Velocity of a position if all faults with creep, which are parallel planes, slipped at its rate everywhere \[m/s\].
///
/// # Errors
/// At a position on the plane of a fault.
pub(super) fn plates<'a, const D: usize>(
    scene: &'a Scene,
    placed: &[PlacedPoint<D>],
    at: &[f64; 3],
) -> Result<[f64; 3], FaultPlane<'a>> {
    let mut plates = [0.0; 3];
    for (fault, entry) in scene.faults.iter().enumerate() {
        let own: Vec<&PlacedPoint<D>> = placed.iter().filter(|p| p.fault == fault).collect();
        let moved = beside(at, entry, &own)?;
        plates.iter_mut().zip(moved).for_each(|(sum, v)| *sum += v);
    }
    Ok(plates)
}

/// Velocity of a position beside a fault that creeps everywhere: half of the rate, on either side of its plane.
fn beside<'a, const D: usize>(
    at: &[f64; 3],
    (fault, spec): (&'a String, &'a Spec),
    own: &[&PlacedPoint<D>],
) -> Result<[f64; 3], FaultPlane<'a>> {
    let Some(creep) = spec.creep.as_ref() else { return Ok([0.0; 3]) };
    let Some(first) = own.first() else { return Ok([0.0; 3]) };
    let normal: [f64; 3] = in_space(&first.point.place.normal);
    let from: [f64; 3] = in_space(&first.point.place.at);
    let apart: [f64; 3] = std::array::from_fn(|c| at[c] - from[c]);
    let distance = dot(&apart, &normal);
    if distance.abs() <= ON_PLANE * dot(&apart, &apart).sqrt() {
        return Err(FaultPlane(fault));
    }
    // Creep in space has a direction of its own.
    let along = if D == 3 { in_space(&first.point.place.creeps) } else { slides(first) };
    let half = 0.5 * distance.signum() * creep.rate.get_ref().0;
    Ok(along.map(|e| half * e))
}
