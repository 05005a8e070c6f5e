//! Check that faults in homogeneous rock keep a distance from each other, and the triangles of a fault, too.

use super::super::placed::{Placed, in_space};
use crate::diagnostic::Diagnostic;
use crate::scene::model::{Fault as Spec, Scene};
use asperity_mechanics::coordinates;

/// Distance of the centres of two cells of different faults, relative to the mean of their widths, below which the faults
/// cross, branch, or lie so close that slip that is uniform over cells does not resolve the stress between them. Cells of
/// faults that meet end to end are one width apart.
const CLOSEST: f64 = 0.9;
/// The same for two cells of one fault, which may have a common side at a bend: a third of a right angle there is sharper
/// than a fault can be.
const FOLDED: f64 = 0.25;

/// Refuses faults that cross, touch from the side or lie closer than their cells are wide, and triangles of a fault that lie
/// on each other. `widths` are the distances of equal cells side by side \[m\].
///
/// # Errors
/// [`Diagnostic`] at the second of two faults, or at the fault.
pub(super) fn check<const D: usize>(
    scene: &Scene,
    placed: &[Placed<D>],
    widths: &[f64],
) -> Result<(), Diagnostic> {
    let faults: Vec<(&String, &Spec)> = scene.faults.iter().collect();
    let own = |fault: usize| faults[fault].1.triangles.is_some();
    if faults.len() < 2 && !own(0) {
        return Ok(());
    }
    let at = |k: usize| in_space(&placed[k].point.place.at);
    let along = longest(placed);
    let mut sorted: Vec<usize> = (0..placed.len()).collect();
    sorted.sort_by(|&a, &b| at(a)[along].total_cmp(&at(b)[along]));
    let widest = widths.iter().copied().fold(0.0, f64::max);
    for (k, &first) in sorted.iter().enumerate() {
        let reach = at(first)[along] + CLOSEST * widest;
        for &second in sorted[k + 1..].iter().take_while(|&&p| at(p)[along] <= reach) {
            let [one, other] = [first, second].map(|p| placed[p].fault);
            if one == other && !own(one) {
                continue;
            }
            let closest = if one == other { FOLDED } else { CLOSEST };
            let distance = at(first).iter().zip(at(second)).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
            if distance >= closest * 0.5 * (widths[first] + widths[second]) {
                continue;
            }
            let place = coordinates::in_words(&placed[first].point.place.at);
            let (low, high) = (one.min(other), one.max(other));
            return Err(if low == high {
                on_itself(faults[low], &place)
            } else {
                too_close([faults[low], faults[high]], &place, distance)
            });
        }
    }
    Ok(())
}

/// Axis along which the points extend farthest.
fn longest<const D: usize>(placed: &[Placed<D>]) -> usize {
    let extent = |axis: usize| {
        let all = || placed.iter().map(|p| p.point.place.at[axis]);
        all().fold(f64::NEG_INFINITY, f64::max) - all().fold(f64::INFINITY, f64::min)
    };
    (0..D).fold(0, |best, axis| if extent(axis) > extent(best) { axis } else { best })
}

fn too_close([a, b]: [(&String, &Spec); 2], place: &str, distance: f64) -> Diagnostic {
    Diagnostic::at(
        b.1.span(),
        format!(
            "faults `{}` and `{}` cross, branch or lie too close at {place}: centres of their cells are {distance:.4} m apart there",
            a.0, b.0
        ),
        "in a medium, faults keep the length of a cell away from each other; they may meet end to end",
    )
}

fn on_itself((name, spec): (&String, &Spec), place: &str) -> Diagnostic {
    Diagnostic::at(
        spec.span(),
        format!("triangles of fault `{name}` lie on each other at {place}"),
        "mesh each surface once; a fault has no second layer, and does not cross itself",
    )
}
