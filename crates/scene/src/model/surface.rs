//! A map of the free surface.

use super::Extent;
use crate::kinematics;
use crate::spanned::Spanned;
use crate::units::{Angle, Length};
use schemars::JsonSchema;
use serde::Deserialize;

/// Positions of a horizontal map, such as the free surface of a half-space, at equal distances.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SurfaceSpec {
    /// Distance of neighbouring positions, rounded so that it divides the extents \[m\].
    pub spacing: Spanned<Length>,
    /// `{ from, to }` along x; default: the faults, and their greatest depth beyond them on either side.
    pub x: Option<Spanned<Extent>>,
    /// `{ from, to }` along z; default as along x.
    #[schemars(extend("x-kinematics" = kinematics::SPACE, "x-otherwise" = "in the plane a map is a line along x"))]
    pub z: Option<Spanned<Extent>>,
    /// In space, instead of `x` and `z`: range of longitude, such as `{ from = "134 deg", to = "136 deg" }`.
    #[schemars(extend("x-kinematics" = kinematics::SPACE, "x-otherwise" = "in the plane a map is a line along x"))]
    pub longitude: Option<Spanned<AngleExtent>>,
    /// Range of latitude.
    #[schemars(extend("x-kinematics" = kinematics::SPACE, "x-otherwise" = "in the plane a map is a line along x"))]
    pub latitude: Option<Spanned<AngleExtent>>,
}

/// A range of an angle.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AngleExtent {
    /// Lower end \[rad\].
    pub from: Angle,
    /// Upper end \[rad\].
    pub to: Angle,
}
