//! Flux of a well over time.

use super::TimeSeries;

/// Flux of a well \[m/s\].
#[derive(Clone, Debug, PartialEq)]
pub enum Flux {
    /// Constant.
    Constant(f64),
    /// Times from which the flux has a value; constant in between.
    Steps(TimeSeries),
}
