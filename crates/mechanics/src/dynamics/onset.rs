//! Faults that slip already when a run begins.

use asperity_friction::points::{Components, PerPoint};

/// Friction of faults that slip at the start. The tractions that load them are in balance with what moves them, and waves
/// begin to take the difference from friction at once.
#[derive(Clone, Debug, PartialEq)]
pub struct Onset {
    /// Friction \[Pa\].
    pub friction: Components<Vec<f64>>,
    /// State variables.
    pub states: PerPoint<Vec<f64>>,
    /// Rates of the tractions that load the points \[Pa/s\].
    pub loading_rate: Components<Vec<f64>>,
}
