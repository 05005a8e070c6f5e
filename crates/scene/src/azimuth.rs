//! Directions of slip that are given by their azimuth on the map.

use crate::model::{Kinematics, Place, Scene, Spanned};
use crate::units::Angle;

/// Sets the rakes of faults whose `azimuth` is given: the horizontal direction with this azimuth in the axes of the scene.
pub(crate) fn rakes(scene: &mut Scene) {
    let in_space = *scene.kinematics.get_ref() == Kinematics::ThreeD;
    let Some(place) = scene.place.as_ref().filter(|_| in_space) else { return };
    for fault in scene.faults.values_mut().filter(|fault| fault.rake.is_none()) {
        if let Some(azimuth) = &fault.azimuth {
            fault.rake = Some(Spanned::new(azimuth.span(), direction(place, azimuth.get_ref())));
        }
    }
}

/// Horizontal unit vector with an azimuth. `along` has the azimuth `strike`, and the direction to its right is along times up.
fn direction(place: &Place, azimuth: &Angle) -> [f64; 3] {
    let (up, along) = place.axes();
    let unit = |v: [f64; 3]| {
        let size = v.iter().map(|c| c * c).sum::<f64>().sqrt();
        v.map(|c| c / size)
    };
    let (up, along) = (unit(up), unit(along));
    let right = [
        along[1] * up[2] - along[2] * up[1],
        along[2] * up[0] - along[0] * up[2],
        along[0] * up[1] - along[1] * up[0],
    ];
    let (sine, cosine) = (azimuth.0 - place.strike.get_ref().0).sin_cos();
    std::array::from_fn(|c| cosine * along[c] + sine * right[c])
}
