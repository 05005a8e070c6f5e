//! Values at points, forces on sets and springs at the end of a stage.

use asperity_output::bodies::view::{ForceMark, PointMark, PointValues, SpringMark, SpringValues};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Values at a point of a body at the end of a stage.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PointResult {
    /// Point.
    #[serde(flatten)]
    pub point: PointMark,
    /// Stage.
    pub stage: String,
    /// Values.
    #[serde(flatten)]
    pub values: PointValues,
}

/// Force on a set at the end of a stage.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ForceResult {
    /// Set.
    #[serde(flatten)]
    pub force: ForceMark,
    /// Stage.
    pub stage: String,
    /// Force acting on the body through the nodes of the set.
    pub value: [f64; 3],
    /// Unit of the force: N, or N/m of thickness.
    pub unit: String,
}

/// State of a spring at the end of a stage.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SpringResult {
    /// Spring.
    #[serde(flatten)]
    pub spring: SpringMark,
    /// Stage.
    pub stage: String,
    /// Values.
    #[serde(flatten)]
    pub values: SpringValues,
    /// Unit of the force: N, or N/m of thickness.
    pub unit: String,
}
