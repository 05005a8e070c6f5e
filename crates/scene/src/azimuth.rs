//! Directions of slip that are given by their azimuth on the map.

use crate::axes::{Axes, cross, size};
use crate::model::{Kinematics, Scene, Spanned};

/// Sets the rakes of faults whose `azimuth` is given: the horizontal direction with this azimuth in the axes of the scene.
pub(crate) fn rakes(scene: &mut Scene) {
    let in_space = *scene.kinematics.get_ref() == Kinematics::ThreeD;
    let axes = scene.axes();
    let Some(place) = scene.place.as_ref().filter(|_| in_space) else { return };
    for fault in scene.faults.values_mut().filter(|fault| fault.rake.is_none()) {
        if let Some(azimuth) = &fault.azimuth {
            let angle = azimuth.get_ref().0 - place.strike.get_ref().0;
            fault.rake = Some(Spanned::new(azimuth.span(), direction(&axes, angle)));
        }
    }
}

/// Horizontal unit vector at an angle to the right of `along`.
fn direction(axes: &Axes, angle: f64) -> [f64; 3] {
    let unit = |v: [f64; 3]| {
        let size = size(&v);
        v.map(|c| c / size)
    };
    let (up, along) = (unit(axes.up), unit(axes.along));
    let right = cross(&along, &up);
    let (sine, cosine) = angle.sin_cos();
    std::array::from_fn(|c| cosine * along[c] + sine * right[c])
}
