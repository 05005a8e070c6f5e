//! Ruptures that are forced to begin.

use crate::spanned::Spanned;
use crate::units::{Length, Time, Velocity};
use schemars::JsonSchema;
use serde::Deserialize;

/// A front that runs from a position and weakens friction where it arrives, as in the benchmarks TPV22 to TPV36.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ForcedRupture {
    /// Position from which it runs \[m\].
    pub centre: Spanned<Vec<Length>>,
    /// Distance at which it stops \[m\].
    pub radius: Spanned<Length>,
    /// Its speed at the centre, from which it falls to zero at `radius`; 0.7 times that of shear waves in the benchmarks \[m/s\].
    pub speed: Spanned<Velocity>,
    /// Time over which friction falls from `mu_s` to `mu_k` \[s\].
    pub duration: Spanned<Time>,
}
