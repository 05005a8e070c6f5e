//! States of springs between sets of bodies and load points.

use serde::{Deserialize, Serialize};

/// State of a spring at the start of a stage.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SpringStart {
    /// Force on the set \[N; N/m of thickness in the plane\].
    pub force: f64,
    /// Displacement of the load point since the spring was attached \[m\].
    pub load_point: f64,
    /// Displacement of the set \[m\].
    pub displacement: f64,
}

/// State of a spring.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SpringState {
    /// Force on the set, as a load cell reads it \[N; N/m of thickness in the plane\].
    pub force: f64,
    /// Displacement of the load point since the spring was attached \[m\].
    pub load_point: f64,
    /// Displacement of the set \[m\].
    pub displacement: f64,
    /// Elastic energy \[J; J/m of thickness in the plane\].
    pub energy: f64,
}

impl SpringState {
    /// State of a spring of this stiffness \[N/m\] whose load point has moved by `drawn` since `start`, with its set displaced by
    /// `displacement` \[m\].
    #[must_use]
    pub fn new(start: &SpringStart, stiffness: f64, drawn: f64, displacement: f64) -> Self {
        let force = start.force + stiffness * (drawn - (displacement - start.displacement));
        let energy = 0.5 * force * force / stiffness;
        Self { force, load_point: start.load_point + drawn, displacement, energy }
    }
}
