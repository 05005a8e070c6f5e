//! Where and when the origin of a scene lies.

use crate::scene::model::Place;
use asperity_output::located::Spot;
use jiff::{SignedDuration, Timestamp};
use nalgebra::{Matrix3, Vector3};

/// Mean radius of the Earth \[m\] (IUGG): places lie on a sphere, which is enough over the extent of a fault.
const EARTH: f64 = 6_371_008.8;

/// Where and when the origin of a scene lies.
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
    /// Axes of the scene in east, north, up, as columns.
    pub(super) axes: Matrix3<f64>,
    /// Length out of the plane \[m\]; 1 in space.
    pub(super) length: Option<f64>,
}

impl Frame {
    /// Of a scene in the plane, seen along the strike: x to the right of it, y up; or in space, with the directions up and along the strike
    /// that the place gives.
    ///
    /// # Errors
    /// What is wrong with the time.
    pub fn new(place: &Place, in_space: bool) -> Result<Self, jiff::Error> {
        let (sine, cosine) = place.strike.get_ref().0.sin_cos();
        let (right, along, up) =
            (Vector3::new(cosine, -sine, 0.0), Vector3::new(sine, cosine, 0.0), Vector3::z());
        let axes = if in_space {
            let (vertical, level) = place.axes();
            let (vertical, level) = (Vector3::from(vertical).normalize(), Vector3::from(level).normalize());
            // What of a vector points to the right, along and up.
            let parts = Matrix3::from_columns(&[level.cross(&vertical), level, vertical]);
            Matrix3::from_columns(&[right, along, up]) * parts.transpose()
        } else {
            Matrix3::from_columns(&[right, up, -along])
        };
        Ok(Self {
            epoch: place.epoch.get_ref().parse()?,
            latitude: place.latitude.get_ref().0.to_degrees(),
            longitude: place.longitude.get_ref().0.to_degrees(),
            depth: place.depth.as_ref().map_or(0.0, |d| d.get_ref().0),
            axes,
            length: if in_space { Some(1.0) } else { place.length.as_ref().map(|l| l.get_ref().0) },
        })
    }

    /// The time of so many seconds after the epoch, to the microsecond.
    ///
    /// # Errors
    /// Where the calendar does not reach so far.
    pub fn time(&self, seconds: f64) -> Result<Timestamp, jiff::Error> {
        let span = SignedDuration::try_from_secs_f64(seconds)?;
        self.epoch.checked_add(span)?.round(jiff::Unit::Microsecond)
    }

    /// A place of the scene.
    pub(super) fn spot(&self, at: &[f64; 3]) -> Spot {
        let offset = self.axes * Vector3::from(*at);
        let latitude = self.latitude + (offset.y / EARTH).to_degrees();
        let shrink = self.latitude.to_radians().cos().max(f64::EPSILON);
        let longitude = self.longitude + (offset.x / (EARTH * shrink)).to_degrees();
        Spot {
            latitude,
            longitude: (longitude + 180.0).rem_euclid(360.0) - 180.0,
            depth: self.depth - offset.z,
        }
    }
}
