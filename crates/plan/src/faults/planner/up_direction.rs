//! Doubts about the direction up of a scene with a place on Earth.

use super::placed_point::{PlacedPoint, in_space};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Scene, Spanned};
use crate::shared::model::Model;
use crate::shared::place;
use asperity_fem::surface;
use asperity_run::Warning;
use std::ops::Range;

/// Height above which there is no ground on Earth, rounded up \[m\].
const HIGHEST: f64 = 9e3;
/// Cosine of the angle between the mean normal of a side and the direction up, above which the side lies on top: 25 degrees, steeper than ground
/// and less than the dip of most faults.
const ON_TOP: f64 = 0.9;

const UP: &str = "`up` in `[place]` is the direction that points up in the axes of the scene; `depth` is that of their origin";

fn place(scene: &Scene) -> Option<Range<usize>> {
    let place = scene.place.as_ref()?;
    Some(place.up.as_ref().map_or(place.strike.span(), Spanned::span))
}

/// Warning about a fault above any ground.
///
/// # Errors
/// [`Diagnostic`] at the epoch.
pub(super) fn above_ground<const D: usize>(
    scene: &Scene,
    placed: &[PlacedPoint<D>],
) -> Result<Option<Warning>, Diagnostic> {
    let (Some(span), Some(frame)) = (place(scene), place::frame(scene, D == 3)?) else { return Ok(None) };
    let height = |p: &PlacedPoint<D>| frame.height(&in_space(&p.point.place.at));
    let highest = placed.iter().map(|p| (height(p), p.fault)).reduce(|a, b| if b.0 > a.0 { b } else { a });
    let found = highest.filter(|(height, _)| *height > HIGHEST);
    let name = |fault: usize| scene.faults.keys().nth(fault).map_or("", String::as_str);
    Ok(found.map(|(height, fault)| {
        let at = name(fault);
        let message =
            format!("fault `{at}` reaches {:.1} km above sea level, higher than any ground", height / 1e3);
        Warning::at(span, message, UP)
    }))
}

/// Warning about bodies that are held from above and free below.
pub(super) fn held_above<const D: usize>(scene: &Scene, model: &Model<D>) -> Option<Warning> {
    let span = place(scene).filter(|_| D == 3 && scene.lift().is_none())?;
    let axes = scene.axes();
    let size = surface::length(&axes.up);
    let conditions = scene.stages.iter().flat_map(|stage| &stage.conditions).map(Spanned::get_ref);
    // Tractions act on free sides, too.
    let held =
        conditions.filter(|c| c.traction.is_none() && c.pressure.is_none()).filter_map(|c| c.set.as_ref());
    let rises: Vec<(&String, f64)> = held
        .filter_map(|set| {
            let normal = surface::mean_normal(&model.mesh, model.mesh.side_sets.get(set.get_ref())?)?;
            let dot: f64 = normal.iter().zip(&axes.up).map(|(n, u)| n * u).sum();
            Some((set.get_ref(), dot / size))
        })
        .collect();
    let (above, _) = rises.iter().find(|(_, cosine)| *cosine > ON_TOP)?;
    let below = rises.iter().any(|(_, cosine)| *cosine < -ON_TOP);
    (!below).then(|| {
        let message = format!("side `{above}`, which lies on top with this `[place]`, is held, and no side below is: its free surface points down");
        Warning::at(span, message, UP)
    })
}
