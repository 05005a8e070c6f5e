//! A point of a fault and its conditions.

use super::place::Place;
use serde::{Deserialize, Serialize};

/// A point of a fault and its conditions.
#[derive(Clone, Debug)]
pub struct Point<const D: usize> {
    /// Position.
    pub place: Place<D>,
    /// Slip rate along both tangents \[m/s\], where it is prescribed.
    pub creep: Option<[f64; 2]>,
    /// True if slip and loads change its normal traction.
    pub normal_changes: bool,
    /// True if it may open where its normal traction falls to zero.
    pub opens: bool,
}

/// Tractions on points before any of them slips by friction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Initial {
    /// Shear tractions, component by component \[Pa\].
    pub shear: Vec<f64>,
    /// Normal tractions, compression positive \[Pa\]; 0 where supports hold both sides of a point across the fault.
    pub normal: Vec<f64>,
}
