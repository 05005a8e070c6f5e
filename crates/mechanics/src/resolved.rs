//! Resolution, by the slave points of an interface, of the zone in which friction loses its strength.

use std::ops::Range;

/// See the module.
#[derive(Clone, Debug, PartialEq)]
pub struct Resolved {
    /// Normal traction under which the cohesive zone is as long as the largest distance between points \[Pa\].
    pub one: f64,
    /// Largest distance between points \[m\].
    pub spacing: f64,
    /// Normal traction under which no point may slide \[Pa\]; none where any may.
    pub refused_beyond: Option<f64>,
    /// Resolution in words with a remedy, for a run that stops because of it.
    pub limit: String,
    /// Bytes of the description that warnings point at.
    pub place: Range<usize>,
}
