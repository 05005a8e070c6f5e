//! Files of the platform of a community benchmark.

use crate::spanned::Spanned;
use schemars::JsonSchema;
use serde::Deserialize;

/// Contents of the heads of the files.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlatformSpec {
    /// Name of the benchmark, such as `"SEAS Benchmark BP5-QD"`.
    pub problem: Spanned<String>,
    /// Name of the person who submits the results.
    pub modeler: Spanned<String>,
    /// Date of the run, such as `"2026/11/26"`; absent: no date.
    pub date: Option<Spanned<String>>,
}
