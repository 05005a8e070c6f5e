//! Simulated events as values for catalogues of real ones, for scenes that say where and when they lie.

use super::catalogue::Event;
use super::equations::size;
use super::plan::Plan;
use crate::scene::model::Place;
use asperity_output::located::{Located, Spot, Tensor, magnitude};
use jiff::{SignedDuration, Timestamp};
use nalgebra::{Matrix3, Vector3};
use std::ops::Range;

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
    axes: Matrix3<f64>,
    /// Length out of the plane \[m\]; 1 in space.
    length: Option<f64>,
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
    fn spot(&self, at: &[f64; 3]) -> Spot {
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

/// An event of a plan, or of what it was on these points of one of its faults.
///
/// # Errors
/// Where the calendar does not reach the event.
pub fn locate(
    plan: &Plan,
    frame: &Frame,
    event: &Event,
    points: &Range<usize>,
) -> Result<Located, jiff::Error> {
    let length = frame.length.unwrap_or(1.0);
    let (mut sum, mut centre, mut weight) = (Matrix3::zeros(), Vector3::zeros(), 0.0);
    for p in points.clone() {
        let point = &plan.points[p];
        let (normal, way) = (Vector3::from(point.normal), Vector3::from(plan.vector(&event.slip, p)));
        let couple = normal * way.transpose();
        let slip = size(&event.slip, plan.points.len(), p);
        sum += (couple + couple.transpose()) * (point.shear_modulus * point.area * length);
        centre += Vector3::from(point.at) * (point.area * slip);
        weight += point.area * slip;
    }
    let tensor = Tensor::of_east_north_up(&(frame.axes * sum * frame.axes.transpose()));
    let moment = frame.length.map(|_| tensor.moment());
    let onset = frame.time(event.onset.seconds())?;
    Ok(Located {
        time: onset.to_string(),
        hypocentre: frame.spot(&plan.points[event.hypocentre].at),
        centroid: frame.spot(&(centre / weight).into()),
        planes: tensor.planes(),
        tensor,
        moment,
        magnitude: moment.map(magnitude),
        onset,
        duration: event.end.since(&event.onset),
    })
}
