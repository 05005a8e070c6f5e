//! Loads and supports of the bodies around a fault.

use super::machine::Spring;
use asperity_fem::dof::Constraints;

/// Loads and supports of the bodies.
#[derive(Clone, Debug)]
pub struct Loads {
    /// Prescribed motions and loads.
    pub constraints: Constraints,
    /// Boundaries that a spring moves as one.
    pub springs: Vec<Spring>,
    /// Nodal forces of the weight of the bodies, which acts before the start.
    pub weight: Vec<(usize, f64)>,
    /// End of the run \[s\].
    pub end: f64,
}
