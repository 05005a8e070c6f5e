//! Geographic frame of a scene.

mod frame;
mod map;

pub use frame::Frame;
pub(crate) use frame::Origin;
pub(crate) use map::Map;

use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{MediumKind, Scene};
use asperity_scene::axes::Axes;
use jiff::Timestamp;

/// Frame of a scene, if it has a `[place]`.
///
/// # Errors
/// [`Diagnostic`] at the epoch.
pub(crate) fn frame(scene: &Scene, in_space: bool) -> Result<Option<Frame>, Diagnostic> {
    let Some(place) = &scene.place else { return Ok(None) };
    let wrong = |e: jiff::Error| {
        Diagnostic::at(place.epoch.span(), e.to_string(), "such as \"2000-01-01T00:00:00Z\"")
    };
    let origin = Origin {
        epoch: place.epoch.get_ref().parse::<Timestamp>().map_err(wrong)?,
        latitude: place.latitude.get_ref().0.to_degrees(),
        longitude: place.longitude.get_ref().0.to_degrees(),
        depth: place.depth.as_ref().map_or(0.0, |d| d.get_ref().0),
        length: if in_space { Some(1.0) } else { place.length.as_ref().map(|l| l.get_ref().0) },
    };
    let Axes { up, along } = scene.axes();
    let vertical = in_space.then_some([up, along]);
    Ok(Some(Frame::new(&origin, place.strike.get_ref().0, vertical)))
}

/// Direction up, where the scene has one: that of its `[place]`, or out of the surface of a half-space.
pub(crate) fn up(scene: &Scene) -> Option<[f64; 3]> {
    let half = || scene.medium.as_ref().is_some_and(|m| *m.kind.get_ref() == MediumKind::HalfSpace);
    (scene.place.is_some() || half()).then(|| scene.axes().up)
}
