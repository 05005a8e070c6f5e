//! A line through vertices, divided into cells without a mesh around it.

use super::curve::{Curve, Departure};
use super::spec::Interpolation;
use super::{FaultMeshError, Spacing, check};
use crate::mesh::spacing;

/// A line divided into cells.
#[derive(Clone, Debug, PartialEq)]
pub struct DividedLine {
    /// Ends of the cells in the order of the vertices, one more than there are cells \[m\].
    pub places: Vec<[f64; 2]>,
    /// Their distances from the first vertex, along the line \[m\].
    pub along: Vec<f64>,
    /// Largest distance of a smooth curve from straight lines between the vertices.
    pub departure: Option<Departure>,
}

/// Divides the line through some vertices into cells of these sizes.
///
/// # Errors
/// If there are fewer than two vertices, a coordinate is not finite, two neighbours coincide, or the line cannot be divided.
pub fn divided(
    trace: &[[f64; 2]],
    interpolation: Interpolation,
    sizes: &Spacing,
) -> Result<DividedLine, FaultMeshError> {
    let bad = trace.iter().flatten().filter(|x| !x.is_finite()).count();
    if trace.len() < 2 || bad > 0 {
        return Err(FaultMeshError::Trace { vertices: trace.len(), bad });
    }
    check::distinct(trace)?;
    sizes.check()?;
    let curve = if interpolation == Interpolation::Polyline { None } else { Curve::through(trace) };
    let Some(curve) = curve else {
        let along = spacing::along(&check::distances(trace), sizes)?;
        return Ok(DividedLine { places: check::places(trace, &along), along, departure: None });
    };
    let along = spacing::along(curve.lengths(), sizes)?;
    let departure = Some(curve.departure());
    Ok(DividedLine { places: curve.places(&along), along, departure })
}
