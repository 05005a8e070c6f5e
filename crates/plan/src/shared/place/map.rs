//! Projection of geographic positions to a plane around the origin of a scene.

use proj4rs::Proj;
use proj4rs::transform::transform;

/// Transverse Mercator projection of the ellipsoid WGS84, with scale 1 on the meridian of the origin. Lengths are too large by
/// `(x/R)\u{b2}/2` at a distance x from that meridian: 1e-3 at 285 km.
#[derive(Debug)]
pub(crate) struct Map {
    globe: Proj,
    plane: Proj,
}

impl Map {
    /// Projection around a position \[degrees\].
    ///
    /// # Panics
    /// Never: the scene has been checked for latitudes and longitudes.
    pub fn new(longitude: f64, latitude: f64) -> Self {
        let plane =
            format!("+proj=etmerc +lat_0={latitude} +lon_0={longitude} +k=1 +ellps=WGS84 +units=m +no_defs");
        let known = |text: &str| Proj::from_proj_string(text).expect("a projection of the library");
        Self { globe: known("+proj=longlat +ellps=WGS84 +no_defs"), plane: known(&plane) }
    }

    /// Distances east and north of the origin \[m\]; `None` far from it, where there is no projection.
    pub fn metres(&self, longitude: f64, latitude: f64) -> Option<[f64; 2]> {
        let mut at = (longitude.to_radians(), latitude.to_radians(), 0.0);
        transform(&self.globe, &self.plane, &mut at).ok()?;
        (at.0.is_finite() && at.1.is_finite()).then_some([at.0, at.1])
    }

    /// Longitude from -180 to 180, and latitude \[degrees\]; NaN far from the origin, where there is no projection.
    pub fn degrees(&self, [east, north]: [f64; 2]) -> (f64, f64) {
        let mut at = (east, north, 0.0);
        match transform(&self.plane, &self.globe, &mut at) {
            Ok(()) => ((at.0.to_degrees() + 180.0).rem_euclid(360.0) - 180.0, at.1.to_degrees()),
            Err(_) => (f64::NAN, f64::NAN),
        }
    }
}
