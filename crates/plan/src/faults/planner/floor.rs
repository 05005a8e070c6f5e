//! Choices for the normal tractions of a fault.

use super::super::normal::NormalChoice;
use super::placed_point::PlacedPoint;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Fault as Spec, Scene, Spanned};
use crate::shared::entry::Entry;
use asperity_mechanics::coordinates;
use asperity_run::Warning;

/// Behaviour of normal tractions on a fault.
pub(super) fn choice(spec: &Spec) -> NormalChoice {
    NormalChoice {
        changes: spec.normal_changes.as_ref().is_none_or(|c| *c.get_ref()),
        floor: spec.normal_floor.as_ref().map(|f| f.get_ref().0),
        opens: spec.opening.as_ref().is_some_and(|o| *o.get_ref()),
    }
}

/// Refuses a fault that nothing presses: all its points are in tension at the start.
///
/// # Errors
/// [`Diagnostic`] at the weight of a body, at an initial stress, or at the fault.
pub(super) fn pressed<const D: usize>(
    Entry { name, spec }: Entry<'_, Spec>,
    scene: &Scene,
    points: &[&PlacedPoint<D>],
) -> Result<(), Diagnostic> {
    let most = points.iter().max_by(|a, b| a.normal.total_cmp(&b.normal));
    let Some(most) = most.filter(|most| most.normal < 0.0) else {
        return Ok(());
    };
    let least = points.iter().map(|p| p.normal).fold(0.0, f64::min);
    let mut bodies = scene.bodies.values();
    let weight = bodies.clone().find_map(|b| b.gravity.as_ref()).map(Spanned::span);
    let stress = bodies.find_map(|b| b.initial_stress.as_ref()).map(Spanned::span);
    let (place, help) = match (&spec.normal, weight, stress) {
        (None, Some(weight), _) => (
            weight,
            "weight points down, such as `gravity = [0, -9.81]`; a fault is pressed by what lies above it",
        ),
        (None, None, Some(stress)) => {
            (stress, "stress is positive in tension: a pressed fault has negative components")
        }
        _ => (spec.span(), "give the fault a `normal` traction, which is positive in compression"),
    };
    Err(Diagnostic::at(
        place,
        format!(
            "fault `{name}` is in tension at the start at all of its {} points, by {:.4} MPa at {} to {:.4} MPa: its sides would part at once",
            points.len(),
            -most.normal / 1e6,
            coordinates::in_words(&most.point.place.at),
            -least / 1e6
        ),
        help,
    ))
}

/// Warning if the floor exceeds the initial normal traction, so that the floor alone determines friction there. Weight does not press a fault at a
/// free surface, so on faults pressed by weight this is allowed at up to half of the points, whose number the plan notes.
pub(super) fn above_start(
    name: &str,
    spec: &Spec,
    weighs: bool,
    normals: impl Iterator<Item = f64>,
) -> Option<Warning> {
    let floor = spec.normal_floor.as_ref()?;
    let (mut below, mut all) = (0, 0);
    for normal in normals {
        all += 1;
        below += usize::from(normal < floor.get_ref().0);
    }
    let allowed = if weighs { all / 2 } else { 0 };
    (below > allowed).then(|| {
        Warning::at(
            floor.span(),
            format!("the floor of fault `{name}` lies above its normal traction at the start at {below} of {all} points"),
            "a floor is for what slip takes away: choose it below the normal tractions at the start",
        )
    })
}
