//! An event with its geographical position and time.

use super::tensor::{Plane, Tensor};
use jiff::Timestamp;
use schemars::JsonSchema;
use serde::Serialize;

/// A geographical position.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Spot {
    /// Latitude \[degrees north\].
    pub latitude: f64,
    /// Longitude \[degrees east\].
    pub longitude: f64,
    /// Depth \[m\].
    pub depth: f64,
}

/// Seismological parameters of an event.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "Located")]
pub struct SourceParameters {
    /// Time of the onset, UTC.
    pub time: String,
    /// Position of the onset.
    pub hypocentre: Spot,
    /// Mean position of slip.
    pub centroid: Spot,
    /// Moment tensor \[N m\]; per metre of length out of the plane if no length is declared.
    pub tensor: Tensor,
    /// Nodal planes.
    pub planes: [Plane; 2],
    /// Scalar moment \[N m\]; absent if the length out of the plane is unknown.
    pub moment: Option<f64>,
    /// Moment magnitude; absent if the moment is unknown.
    pub magnitude: Option<f64>,
    /// Time of the onset.
    #[serde(skip)]
    pub onset: Timestamp,
    /// Duration from onset to end \[s\].
    #[serde(skip)]
    pub duration: f64,
}

/// Moment magnitude of a moment \[N m\] after IASPEI (2013): Mw = (2/3) (log10 M0 - 9.1).
#[must_use]
pub fn magnitude(moment: f64) -> f64 {
    (moment.log10() - 9.1) / 1.5
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn magnitudes_are_those_of_the_standard() {
        // M0 = 1.1e21 N m is Mw 7.96, and 1.26e9 N m is Mw 0.
        assert!((magnitude(1.1e21) - 7.9609).abs() < 1e-4);
        assert!((magnitude(10f64.powf(9.1))).abs() < 1e-12);
    }
}
