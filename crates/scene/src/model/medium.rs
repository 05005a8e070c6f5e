//! Homogeneous rock without bodies around faults, and the geometry of faults in it.

use super::{InterpolationSpec, SpacingSpec};
use crate::exact;
use crate::spanned::Spanned;
use crate::units::{Angle, Length};
use schemars::JsonSchema;
use serde::Deserialize;

/// Homogeneous linear elastic rock around the faults of a scene without bodies.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Medium {
    /// Extent of the rock: `"half-space"`, below the free surface y = 0, or `"whole-space"`.
    pub kind: Spanned<MediumKind>,
    /// Name of its material, which is elastic.
    pub material: Spanned<String>,
}

/// Extent of homogeneous rock.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum MediumKind {
    /// Rock in y ≤ 0, below a surface free of traction.
    HalfSpace,
    /// Rock everywhere.
    WholeSpace,
}

/// A fault in the plane, in a medium without bodies.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FaultLine {
    /// Vertices of the fault from tip to tip, `[[x, y], ..]`, y up \[m\].
    #[serde(deserialize_with = "exact::many")]
    pub trace: Spanned<Vec<[Length; 2]>>,
    /// Curve through the vertices: `"spline"` (default), a smooth curve, or `"polyline"`, straight lines with corners.
    #[serde(default)]
    pub interpolation: InterpolationSpec,
    /// Sizes of the cells, in one of the forms of [meshes](meshes.md); distances are measured from the first vertex \[m\].
    pub spacing: Spanned<SpacingSpec>,
}

/// A plane rectangular fault in space, in a medium without bodies.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FaultRectangle {
    /// First end of the upper edge, `[x, y, z]`, y up \[m\].
    #[serde(deserialize_with = "exact::list")]
    pub from: Spanned<[Length; 3]>,
    /// Second end of the upper edge, at the same height. Seen from above, the fault dips to the right of the way from `from` to
    /// `to` \[m\].
    #[serde(deserialize_with = "exact::list")]
    pub to: Spanned<[Length; 3]>,
    /// Dip, above 0 and at most 90 degrees; default: 90 degrees \[rad\].
    pub dip: Option<Spanned<Angle>>,
    /// Extent down dip \[m\].
    pub width: Spanned<Length>,
    /// Size of the square cells; along each axis, the nearest size that divides the fault \[m\].
    pub size: Spanned<Length>,
}
