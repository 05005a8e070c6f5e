//! Sides of a fault move as friction and the other side let them: conditions there are refused, in every kind of run with faults.
//!
//! Sides of a fault that creeps or is locked may be held: that is how slip at depth is driven. A set that meets the fault in
//! an edge or a node alone belongs to another side of a body.

use super::placed_point::PlacedPoint;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Condition, Motion, Scene, Spanned};
use crate::shared::model::{self, Model};
use asperity_fem::mesh::{Side, face_nodes};
use std::collections::BTreeSet;
use std::ops::Range;

/// Refuses conditions on faces of the faults that have a sliding point.
///
/// # Errors
/// [`Diagnostic`] at the condition.
pub(super) fn check<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    placed: &[PlacedPoint<D>],
) -> Result<(), Diagnostic> {
    let sliding = placed.iter().filter(|p| p.point.creep.is_none());
    let sliding: BTreeSet<usize> = sliding.flat_map(|p| [p.point.place.minus, p.point.place.plus]).collect();
    for (name, fault) in &scene.faults {
        let (minus, plus) = (model::sides(model, &fault.minus)?, model::sides(model, &fault.plus)?);
        let slides = |side: &&Side| face_nodes(&model.mesh, side).iter().any(|n| sliding.contains(n));
        let faces: BTreeSet<_> = minus.iter().chain(plus).filter(slides).collect();
        for condition in scene.stages.iter().flat_map(|s| &s.conditions).map(Spanned::get_ref) {
            let (Some(set), Some((what, place, help))) = (&condition.set, acts(condition)) else { continue };
            if model::sides(model, set)?.iter().any(|side| faces.contains(side)) {
                let message = format!(
                    "`{}`: {what} on a side of fault `{name}`, which moves as friction and the other side let it",
                    set.get_ref()
                );
                return Err(Diagnostic::at(place, message, help).and(fault.span(), "the fault"));
            }
        }
    }
    Ok(())
}

/// Words for what a condition does, its place, and what would be right; `None` for one that leaves all components free.
fn acts(condition: &Condition) -> Option<(&'static str, Range<usize>, &'static str)> {
    const HELD: &str = "leave it out, or prescribe motions on outer sides of the bodies; `creep` with `rate = 0` locks a part of a fault";
    const LOADED: &str = "leave it out: `normal` and `shear` of the fault load it, `pulses` too where bodies have mass, and `injection` where it slides through cycles";
    let on = |flag: &Option<Spanned<bool>>| flag.as_ref().filter(|f| *f.get_ref()).map(Spanned::span);
    let motions = [&condition.x, &condition.y, &condition.z].into_iter().flatten();
    let mut motions = motions.filter(|m| !matches!(m.get_ref(), Motion::Free));
    let absorbing = on(&condition.absorbing).map(|place| {
        (
            "`absorbing`",
            place,
            "leave it out: waves leave through outer sides of the bodies, and cross a fault",
        )
    });
    absorbing
        .or_else(|| on(&condition.symmetry).map(|place| ("`symmetry`", place, HELD)))
        .or_else(|| condition.rotate.as_ref().map(|r| ("a rotation", r.span(), HELD)))
        .or_else(|| motions.next().map(|m| ("a motion", m.span(), HELD)))
        .or_else(|| condition.pressure.as_ref().map(|p| ("a pressure", p.span(), LOADED)))
        .or_else(|| condition.traction.as_ref().map(|t| ("a traction", t.span(), LOADED)))
}
