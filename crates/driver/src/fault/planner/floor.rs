//! Choices for the normal tractions of a fault.

use super::super::normal::NormalChoice;
use crate::scene::model::Fault as Spec;
use crate::warning::Warning;

/// Behaviour of normal tractions on a fault.
pub(super) fn choice(spec: &Spec) -> NormalChoice {
    NormalChoice {
        changes: spec.normal_changes.as_ref().is_none_or(|c| *c.get_ref()),
        floor: spec.normal_floor.as_ref().map(|f| f.get_ref().0),
        opens: spec.opening.as_ref().is_some_and(|o| *o.get_ref()),
    }
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
