//! Shear tractions imposed on a fault for a while.

use crate::spanned::Spanned;
use crate::units::{Length, Pressure, Time};
use schemars::JsonSchema;
use serde::Deserialize;

/// A shear traction that grows smoothly within a radius and stays: that of the community's benchmarks of nucleation.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Pulse {
    /// Shear traction at the centre in the end, added to that of the fault along its direction of slip, the sign of `rate` \[Pa\].
    pub traction: Spanned<Pressure>,
    /// Centre \[m\].
    pub centre: Spanned<Vec<Length>>,
    /// Radius beyond which nothing is added \[m\].
    pub radius: Spanned<Length>,
    /// Duration of the growth \[s\].
    pub duration: Spanned<Time>,
}
