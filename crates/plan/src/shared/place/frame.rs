//! Geographic position and epoch of the origin of a scene.

use super::map::Map;
use asperity_output::formats::catalogues::Spot;
use jiff::{SignedDuration, Timestamp};
use nalgebra::{Matrix3, Vector3};

/// Geographic position and epoch, as given in the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Origin {
    /// Time zero.
    pub epoch: Timestamp,
    /// Degrees north.
    pub latitude: f64,
    /// Degrees east.
    pub longitude: f64,
    /// Depth of the origin of coordinates \[m\].
    pub depth: f64,
    /// Length out of the plane \[m\]; 1 in 3D.
    pub length: Option<f64>,
}

/// Geographic position, epoch and axes of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Time zero.
    pub epoch: Timestamp,
    /// Degrees north.
    latitude: f64,
    /// Degrees east.
    longitude: f64,
    /// Depth of the origin of coordinates \[m\].
    depth: f64,
    /// Axes of the scene in east, north and up, as columns.
    pub axes: Matrix3<f64>,
    /// Length out of the plane \[m\]; 1 in 3D.
    pub length: Option<f64>,
}

impl Frame {
    /// Frame of a scene. A 2D scene is viewed along the strike: x to the right of it, y up. In 3D, `vertical` holds the directions up and along the
    /// strike.
    #[must_use]
    pub(crate) fn new(origin: &Origin, strike: f64, vertical: Option<[[f64; 3]; 2]>) -> Self {
        let (sine, cosine) = strike.sin_cos();
        let (right, along, up) =
            (Vector3::new(cosine, -sine, 0.0), Vector3::new(sine, cosine, 0.0), Vector3::z());
        let axes = if let Some([vertical, level]) = vertical {
            let (vertical, level) = (Vector3::from(vertical).normalize(), Vector3::from(level).normalize());
            // Components of a vector to the right, along the strike and up.
            let parts = Matrix3::from_columns(&[level.cross(&vertical), level, vertical]);
            Matrix3::from_columns(&[right, along, up]) * parts.transpose()
        } else {
            Matrix3::from_columns(&[right, up, -along])
        };
        let Origin { epoch, latitude, longitude, depth, length } = *origin;
        Self { epoch, latitude, longitude, depth, axes, length }
    }

    /// Time at `seconds` after the epoch, to the microsecond.
    ///
    /// # Errors
    /// If the time lies outside the range of the calendar.
    pub fn time(&self, seconds: f64) -> Result<Timestamp, jiff::Error> {
        let span = SignedDuration::try_from_secs_f64(seconds)?;
        self.epoch.checked_add(span)?.round(jiff::Unit::Microsecond)
    }

    /// Geographic position of a point of the scene.
    pub fn spot(&self, at: &[f64; 3]) -> Spot {
        let offset = self.axes * Vector3::from(*at);
        let (longitude, latitude) = self.map().degrees([offset.x, offset.y]);
        Spot { latitude, longitude, depth: self.depth - offset.z }
    }

    /// Height of a point of the scene above sea level \[m\].
    pub(crate) fn height(&self, at: &[f64; 3]) -> f64 {
        self.axes.row(2).iter().zip(at).map(|(up, x)| up * x).sum::<f64>() - self.depth
    }

    /// Position in the scene of a depth \[m\] below a position east and north of the origin \[m\].
    pub(crate) fn position(&self, [east, north]: [f64; 2], depth: f64) -> [f64; 3] {
        (self.axes.transpose() * Vector3::new(east, north, self.depth - depth)).into()
    }

    /// Directions east and north in the axes of the scene.
    pub fn horizontal(&self) -> [[f64; 3]; 2] {
        [0, 1].map(|row| std::array::from_fn(|c| self.axes[(row, c)]))
    }

    /// Position in the scene at the height of the origin, at these distances east and north of it \[m\].
    pub(crate) fn level(&self, at: [f64; 2]) -> [f64; 3] {
        self.position(at, self.depth)
    }

    /// Projection around the origin.
    pub(crate) fn map(&self) -> Map {
        Map::new(self.longitude, self.latitude)
    }
}
