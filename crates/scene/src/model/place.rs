//! Geographical position and time of the events of a scene.

use crate::key_default::usual;
use crate::kinematics;
use crate::spanned::Spanned;
use crate::units::{Angle, Length};
use schemars::JsonSchema;
use serde::Deserialize;

/// Geographical position and time, for catalogues in the formats of real events.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Place {
    /// Time zero, `"2000-01-01T00:00:00Z"`.
    pub epoch: Spanned<String>,
    /// Latitude of the origin, such as `"35 deg"` \[rad\].
    pub latitude: Spanned<Angle>,
    /// Longitude of the origin, east positive \[rad\].
    pub longitude: Spanned<Angle>,
    /// Depth of the origin \[m\].
    #[schemars(extend("x-default" = usual(0)))]
    pub depth: Option<Spanned<Length>>,
    /// Azimuth of the direction into the plane, with x to its right and y up; in space, azimuth of `along`.
    pub strike: Spanned<Angle>,
    /// Direction that points up; default against `gravity` of the bodies, else y, `[0, 1, 0]`.
    #[schemars(extend("x-kinematics" = kinematics::SPACE, "x-otherwise" = "in the plane y is up, and `strike` is the direction into the plane"))]
    #[serde(default, deserialize_with = "crate::exact_list::optional")]
    pub up: Option<Spanned<[f64; 3]>>,
    /// Horizontal direction with the azimuth `strike`; default with x to its right, `[0, 0, -1]` if y is up.
    #[schemars(extend("x-kinematics" = kinematics::SPACE, "x-otherwise" = "in the plane y is up, and `strike` is the direction into the plane"))]
    #[serde(default, deserialize_with = "crate::exact_list::optional")]
    pub along: Option<Spanned<[f64; 3]>>,
    /// Length of the fault out of the plane, for moments and magnitudes \[m\].
    #[schemars(extend("x-kinematics" = kinematics::PLANE))]
    pub length: Option<Spanned<Length>>,
}
