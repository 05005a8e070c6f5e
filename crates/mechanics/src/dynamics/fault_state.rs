//! State of the faults between two steps.

use asperity_friction::points::{Components, PerPoint};
use serde::{Deserialize, Serialize};

/// State of the faults at a step tⁿ.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FaultState {
    /// Slip \[m\].
    pub slip: Components<Vec<f64>>,
    /// Slip rate \[m/s\]: the mean of the half steps before and after.
    pub rate: Components<Vec<f64>>,
    /// Shear traction \[Pa\].
    pub shear: Components<Vec<f64>>,
    /// Normal traction \[Pa\].
    pub normal: Vec<f64>,
    /// Gap \[m\]; 0 where the sides touch.
    pub gap: Vec<f64>,
    /// State variables half a step later.
    pub states: PerPoint<Vec<f64>>,
    /// Normal traction that friction feels \[Pa\], if it is delayed.
    pub felt: Vec<f64>,
}
