//! Resolution of the cohesive zone by the slave points of an interface.

use std::ops::Range;

/// Resolution of the zone in which friction loses its strength.
#[derive(Clone, Debug, PartialEq)]
pub struct ZoneResolution {
    /// Normal traction at which the length of the cohesive zone equals the largest distance between points \[Pa\].
    pub one: f64,
    /// Largest distance between points \[m\].
    pub spacing: f64,
    /// Normal traction above which no point may slide \[Pa\]; `None` if there is no limit.
    pub refused_beyond: Option<f64>,
    /// Description of the resolution and a remedy, for a run that stops because of it.
    pub limit: String,
    /// Byte range of the scene that warnings point at.
    pub place: Range<usize>,
}
