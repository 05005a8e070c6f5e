//! Positions in homogeneous rock whose motion is written.

use super::super::super::receivers::{Receiver, Receivers};
use super::super::placed::{Placed, in_space, slides};
use crate::diagnostic::Diagnostic;
use crate::idealisation;
use crate::scene::model::{Creep, Fault as Spec, Scene, Spanned};
use crate::scene::units::Length;
use asperity_cycles::medium::patches::Patches;
use asperity_fem::material::elastic::Elastic;

/// Difference of unit normals beyond which a fault is not plane: rounding of the directions of its cells.
const PLANE: f64 = 1e-9;

/// Distance from the plane of a fault, relative to the distance from its first point, below which a position lies on it:
/// rounding.
const ON_PLANE: f64 = 1e-9;

/// Receivers of a scene, with the rates of the plates at all points, component by component.
///
/// # Errors
/// [`Diagnostic`] at a receiver that has no motion, or at a fault whose plates cannot be followed.
pub(super) fn of<const D: usize>(
    scene: &Scene,
    (patches, rock): (&Patches, &Elastic),
    placed: &[Placed<D>],
    (rates, tangents): (Vec<f64>, usize),
) -> Result<Receivers, Diagnostic> {
    let axes = axes(scene);
    let mut receivers = Receivers { all: Vec::new(), rates, axes };
    for (name, spec) in &scene.output.receivers {
        let at = std::array::from_fn(|c| spec.get_ref().get(c).map_or(0.0, |x: &Length| x.0));
        let per_slip: Vec<[f64; 3]> =
            (0..tangents).flat_map(|component| patches.displacements(&at, component, rock)).collect();
        if !per_slip.iter().flatten().all(|u| u.is_finite()) {
            return Err(Diagnostic::at(
                spec.span(),
                format!(
                    "receiver `{name}` lies on the edge of a cell of a fault, where displacements are not defined"
                ),
                "a position beside the fault",
            ));
        }
        let plates = plates(scene, placed, &at).map_err(|why| refused((name, spec), &why))?;
        receivers.all.push(Receiver { name: name.clone(), at, per_slip, plates, loads: Vec::new() });
    }
    Ok(receivers)
}

/// Axes along which points move.
pub(super) fn axes(scene: &Scene) -> Vec<usize> {
    match idealisation::of(*scene.kinematics.get_ref()).components() {
        1 => vec![2],
        components => (0..components).collect(),
    }
}

/// Reason why a position cannot be moved with the plates.
pub(super) enum Unmoved<'a> {
    /// A fault that creeps beyond its ends is not plane.
    Bent(&'a str, &'a Creep),
    /// The position lies on the plane of a fault.
    Between(&'a str),
}

/// Velocity of a position if all faults with creep slipped at its rate everywhere \[m/s\].
///
/// # Errors
/// At a position or a fault for which it is not defined.
pub(super) fn plates<'a, const D: usize>(
    scene: &'a Scene,
    placed: &[Placed<D>],
    at: &[f64; 3],
) -> Result<[f64; 3], Unmoved<'a>> {
    let mut plates = [0.0; 3];
    for (fault, entry) in scene.faults.iter().enumerate() {
        let own: Vec<&Placed<D>> = placed.iter().filter(|p| p.fault == fault).collect();
        let moved = beside(at, entry, &own)?;
        plates.iter_mut().zip(moved).for_each(|(sum, v)| *sum += v);
    }
    Ok(plates)
}

/// Error at a receiver that has no motion with the plates.
fn refused((name, receiver): (&str, &Spanned<Vec<Length>>), why: &Unmoved<'_>) -> Diagnostic {
    match why {
        Unmoved::Bent(fault, creep) => Diagnostic::at(
            creep.rate.span(),
            format!(
                "receiver `{name}` moves with the plates, and fault `{fault}`, which creeps beyond its ends, is not plane"
            ),
            "receivers need plane faults, or faults without `creep`",
        ),
        Unmoved::Between(fault) => Diagnostic::at(
            receiver.span(),
            format!("receiver `{name}` lies on the plane of fault `{fault}`, whose sides move apart"),
            "a position on one of its sides",
        ),
    }
}

/// Velocity of a position beside a fault that creeps everywhere: half of the rate, on either side of its plane.
fn beside<'a, const D: usize>(
    at: &[f64; 3],
    (fault, spec): (&'a String, &'a Spec),
    own: &[&Placed<D>],
) -> Result<[f64; 3], Unmoved<'a>> {
    let Some(creep) = spec.creep.as_ref() else { return Ok([0.0; 3]) };
    let Some(first) = own.first() else { return Ok([0.0; 3]) };
    let normal: [f64; 3] = in_space(&first.point.place.normal);
    let dot = |a: &[f64; 3], b: &[f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let turned = |p: &&&Placed<D>| 1.0 - dot(&in_space(&p.point.place.normal), &normal) > PLANE;
    if own.iter().any(|p| turned(&p)) {
        return Err(Unmoved::Bent(fault, creep));
    }
    let from: [f64; 3] = in_space(&first.point.place.at);
    let apart: [f64; 3] = std::array::from_fn(|c| at[c] - from[c]);
    let distance = dot(&apart, &normal);
    if distance.abs() <= ON_PLANE * dot(&apart, &apart).sqrt() {
        return Err(Unmoved::Between(fault));
    }
    // Creep in space has a direction of its own.
    let along = if D == 3 { in_space(&first.point.place.creeps) } else { slides(first) };
    let half = 0.5 * distance.signum() * creep.rate.get_ref().0;
    Ok(along.map(|e| half * e))
}
