//! Sites on Earth whose motion is written.

use crate::spanned::Spanned;
use crate::units::Angle;
use schemars::JsonSchema;
use serde::Deserialize;

/// A site in the free surface of a half-space, such as a station of a geodetic network.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Site {
    /// Longitude, east positive, such as `"-123.49 deg"` \[rad\].
    pub longitude: Spanned<Angle>,
    /// Latitude, such as `"48.39 deg"` \[rad\].
    pub latitude: Spanned<Angle>,
}
