//! Start gaps that a scene sets in place of those of the meshes.
//!
//! Slave points are moved along their normals without strain. In the equations a constant is subtracted from the gap of each
//! point, the gap of the meshes less the wanted one. A point that does not face the master yet, but may slide over it later, takes the
//! constant of the closest one that does.

use super::PlannedInterface;
use super::assembly::Assembly;
use super::start_gaps::{self, MeasuredGaps};
use super::surfaces::FacingSurfaces;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::Interface as Spec;
use crate::reading::scene::model::Spanned;
use crate::shared::entry::Entry;
use asperity_mechanics::coordinates;
use asperity_scene::lengths::brief;
use std::ops::Range;

/// Largest adjustment over the size of the slave cells. Facets of a curve leave it by less than an eighth of their size, and a larger gap
/// belongs to the shape of the bodies.
const LARGEST: f64 = 0.5;

/// Wanted start gap \[m\], and the place of its key.
fn wanted(spec: &Spec) -> Option<(f64, Range<usize>)> {
    let clearance = spec.clearance.as_ref().map(|gap| (gap.get_ref().0, gap.span()));
    clearance.or_else(|| spec.adjust.as_ref().map(Spanned::span).map(|place| (0.0, place)))
}

/// Sets the start gaps of all interfaces as the scene wishes.
///
/// # Errors
/// [`Diagnostic`] at the key for a point that lies far from the wanted gap, and for sides that cannot touch.
pub fn apply<const D: usize>(assembly: &mut Assembly<'_, D>) -> Result<(), Diagnostic> {
    let shifts: Result<Vec<_>, _> =
        assembly.interfaces.iter().map(|planned| shift(assembly, planned)).collect();
    for (planned, shift) in assembly.interfaces.iter_mut().zip(shifts?) {
        planned.shift = shift;
    }
    Ok(())
}

/// Lengths by which the gaps of the points of an interface are less than those of the meshes; `None` if they start as meshed.
fn shift<const D: usize>(
    assembly: &Assembly<'_, D>,
    planned: &PlannedInterface,
) -> Result<Option<Vec<f64>>, Diagnostic> {
    let own = assembly.entry(planned);
    let Some((gap, place)) = wanted(own.spec) else { return Ok(None) };
    let surfaces = FacingSurfaces::find(&assembly.model, own)?;
    let measured = start_gaps::measure(assembly, planned, surfaces.slave.sides)?;
    let size = surfaces.slave.cell_size(&assembly.model);
    let farthest = measured.facing.iter().max_by(|a, b| (a.gap - gap).abs().total_cmp(&(b.gap - gap).abs()));
    match farthest {
        Some(point) if (point.gap - gap).abs() > LARGEST * size => {
            let node = assembly.model.mesh.nodes[planned.slave[point.point].0];
            Err(too_far(own, place, [gap, point.gap, size], &coordinates::in_words(&node)))
        }
        _ => Ok(Some(every_shift(assembly, planned, &measured, gap))),
    }
}

/// Error for a point that lies far from the wanted gap.
fn too_far(
    own: Entry<'_, Spec>,
    place: Range<usize>,
    [wanted, gap, size]: [f64; 3],
    node: &str,
) -> Diagnostic {
    let Entry { name, spec } = own;
    let what = if gap < 0.0 { "overlaps the master by" } else { "lies before the master by" };
    let wish = if spec.clearance.is_some() {
        format!("`clearance` would start it at {}", brief(wanted))
    } else {
        "`adjust` would start it in contact".into()
    };
    Diagnostic::at(
        place,
        format!(
            "the slave node at {node} of interface `{name}` {what} {}, and {wish}: by more than half of the element size {}",
            brief(gap.abs()),
            brief(size)
        ),
        "this closes what meshes leave between surfaces that touch: declare as sides only what does, move the bodies, or leave the \
         key out where the gap belongs to their shape",
    )
}

/// Shifts of the points that face the master, and of the others that of the closest one.
fn every_shift<const D: usize>(
    Assembly { model, .. }: &Assembly<'_, D>,
    planned: &PlannedInterface,
    measured: &MeasuredGaps,
    gap: f64,
) -> Vec<f64> {
    let mut shifts = vec![None; planned.slave.len()];
    measured.facing.iter().for_each(|p| shifts[p.point] = Some(p.gap - gap));
    let position = |point: usize| &model.mesh.nodes[planned.slave[point].0];
    let distance = |a: usize, b: usize| -> f64 {
        position(a).iter().zip(position(b)).map(|(a, b)| (a - b).powi(2)).sum()
    };
    let closest = |point: usize| {
        let by = |other: usize| distance(point, other);
        let near = measured.facing.iter().min_by(|a, b| by(a.point).total_cmp(&by(b.point)));
        near.map_or(0.0, |p| p.gap - gap)
    };
    shifts.iter().enumerate().map(|(p, shift)| shift.unwrap_or_else(|| closest(p))).collect()
}
