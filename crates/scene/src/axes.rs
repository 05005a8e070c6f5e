//! Directions of a scene in space: up, and the horizontal one whose azimuth is `strike`.

use crate::model::{Scene, Spanned};

/// Directions up and along strike, of any length.
pub struct Axes {
    /// Direction that points up.
    pub up: [f64; 3],
    /// Horizontal direction with the azimuth `strike`.
    pub along: [f64; 3],
}

impl Scene {
    /// Directions of a scene in space: those of its `[place]`, with defaults for what it leaves out. Up is against the gravity
    /// of the bodies, and y without gravity, as in the plane. x lies to the right of the strike, as in the plane.
    #[must_use]
    pub fn axes(&self) -> Axes {
        let of = |given: Option<&Spanned<[f64; 3]>>| given.map(|v| *v.get_ref());
        let place = self.place.as_ref();
        let up = of(place.and_then(|p| p.up.as_ref())).or_else(|| self.lift()).unwrap_or([0.0, 1.0, 0.0]);
        let along = of(place.and_then(|p| p.along.as_ref())).unwrap_or_else(|| level(&up));
        Axes { up, along }
    }

    /// Direction against the gravity of bodies in space, if they have any.
    #[must_use]
    pub fn lift(&self) -> Option<[f64; 3]> {
        let given = self.bodies.values().filter_map(|body| body.gravity.as_ref());
        let vectors = given.filter_map(|g| <[f64; 3]>::try_from(g.get_ref().as_slice()).ok());
        vectors.filter(|g| g.iter().any(|c| *c != 0.0)).map(|g| g.map(|c| 0.0 - c)).next()
    }
}

/// Horizontal direction that has x to its right; y if up is x.
fn level(up: &[f64; 3]) -> [f64; 3] {
    let right = if up[1] == 0.0 && up[2] == 0.0 { [0.0, 1.0, 0.0] } else { [1.0, 0.0, 0.0] };
    cross(up, &right)
}

/// Cross product.
pub(crate) fn cross(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    std::array::from_fn(|c| {
        let (i, j) = ((c + 1) % 3, (c + 2) % 3);
        a[i] * b[j] - a[j] * b[i]
    })
}

/// Length of a vector.
pub(crate) fn size(v: &[f64; 3]) -> f64 {
    v.iter().map(|c| c * c).sum::<f64>().sqrt()
}
