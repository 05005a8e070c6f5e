//! Faults that slip already when a run begins.

/// Friction of faults that slip at the start. The tractions that load them are in balance with what moves them, and waves
/// begin to take the difference from friction at once. Slices of several components hold the first component of all points,
/// then the second.
#[derive(Clone, Debug, PartialEq)]
pub struct Onset {
    /// Friction \[Pa\].
    pub friction: Vec<f64>,
    /// State variables, point-major.
    pub states: Vec<f64>,
    /// Rates of the tractions that load the points \[Pa/s\].
    pub loading_rate: Vec<f64>,
}
