//! Simulated events in the form of catalogue entries, for scenes with a geographic frame.

use asperity_cycles::Rupture;
use asperity_output::formats::catalogues::{SourceParameters, Tensor, magnitude};
use asperity_plan::faults::Plan;
use asperity_plan::shared::place::Frame;
use asperity_run::Event;
use nalgebra::{Matrix3, Vector3};
use std::ops::Range;

/// Catalogue entry of an event, or of its part on these points of one fault.
///
/// # Errors
/// If the event lies outside the range of the calendar.
pub fn locate(
    plan: &Plan,
    frame: &Frame,
    event: &Event<Rupture>,
    points: &Range<usize>,
) -> Result<SourceParameters, jiff::Error> {
    let length = frame.length.unwrap_or(1.0);
    let (mut sum, mut centre, mut weight) = (Matrix3::zeros(), Vector3::zeros(), 0.0);
    for p in points.clone() {
        let point = &plan.points[p];
        let (normal, way) = (Vector3::from(point.normal), Vector3::from(plan.vector(&event.details.slip, p)));
        let couple = normal * way.transpose();
        let slip = event.details.slip.size(p);
        sum += (couple + couple.transpose()) * (point.shear_modulus * point.area * length);
        centre += Vector3::from(point.at) * (point.area * slip);
        weight += point.area * slip;
    }
    let tensor = Tensor::from_east_north_up(&(frame.axes * sum * frame.axes.transpose()));
    let moment = frame.length.map(|_| tensor.moment());
    let onset = frame.time(event.onset.seconds())?;
    Ok(SourceParameters {
        time: onset.to_string(),
        hypocentre: frame.spot(&plan.points[event.details.hypocentre].at),
        centroid: frame.spot(&(centre / weight).into()),
        planes: tensor.planes(),
        tensor,
        moment,
        magnitude: moment.map(magnitude),
        onset,
        duration: event.duration().unwrap_or(f64::NAN),
    })
}
