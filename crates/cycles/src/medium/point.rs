//! A point of a fault with what happens there.

use super::place::Place;

/// A point of a fault with what happens there.
#[derive(Clone, Debug)]
pub struct Point<const D: usize> {
    /// Position.
    pub place: Place<D>,
    /// Slip rate along both tangents, where it is prescribed \[m/s\].
    pub creep: Option<[f64; 2]>,
    /// True if slip and loads change its normal traction.
    pub normal_changes: bool,
    /// True if it opens where nothing presses it.
    pub opens: bool,
}
