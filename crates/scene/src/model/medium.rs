//! Homogeneous rock without bodies around faults, and the geometry of faults in it.

use super::{InterpolationSpec, SpacingSpec, Trace};
use crate::key_default::usual;
use crate::spanned::Spanned;
use crate::units::{Angle, Length};
use crate::{defaults, exact_list};
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
    pub trace: Spanned<Trace>,
    /// Curve through the vertices: `"spline"`, a smooth curve, or `"polyline"`, straight lines with corners.
    #[schemars(extend("x-default" = usual(InterpolationSpec::default())))]
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
    #[serde(deserialize_with = "exact_list::list")]
    pub from: Spanned<[Length; 3]>,
    /// Second end of the upper edge, at the same height. Seen from above, the fault dips to the right of the way from `from` to
    /// `to` \[m\].
    #[serde(deserialize_with = "exact_list::list")]
    pub to: Spanned<[Length; 3]>,
    /// Dip, above 0 and at most 90 degrees \[rad\].
    #[schemars(extend("x-default" = usual(defaults::DIP)))]
    pub dip: Option<Spanned<Angle>>,
    /// Extent down dip \[m\].
    pub width: Spanned<Length>,
    /// Size of the square cells; along each axis, the nearest size that divides the fault \[m\].
    pub size: Spanned<Length>,
}

/// A fault in space as a surface of triangles, in a medium without bodies.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub enum FaultTriangles {
    /// A Gmsh file, MSH 2.2 or 4.1.
    Gmsh(GmshTriangles),
    /// An Abaqus input file.
    Abaqus(AbaqusTriangles),
    /// An STL file, text or binary.
    Stl(StlTriangles),
    /// A text with longitudes, latitudes and depths, such as contours or a grid of the interface of two plates.
    Depths(DepthTriangles),
}

/// Triangles of a surface that is given by depths.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DepthTriangles {
    /// Path, relative to the folder of the scene. Lines of longitude and latitude in degrees and a depth, or a netCDF grid.
    pub file: Spanned<String>,
    /// Unit of the depths of the file, such as `"km"`. Depths increase downwards.
    pub unit: Spanned<String>,
    /// Depth of the upper edge of the fault, below the shallowest of the file \[m\].
    pub top: Spanned<Length>,
    /// Depth of the lower edge, above the deepest of the file \[m\].
    pub bottom: Spanned<Length>,
    /// Length of the sides of the triangles, about \[m\].
    pub size: Spanned<Length>,
}

/// Triangles of a Gmsh file.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GmshTriangles {
    /// Path, relative to the folder of the scene.
    pub file: Spanned<String>,
    /// Physical groups of triangles that form the fault; absent: all triangles, in a file without cells in space.
    pub groups: Option<Spanned<Vec<Spanned<String>>>>,
    /// Unit of length of the file.
    #[schemars(extend("x-default" = usual(defaults::FILE_UNIT)))]
    pub unit: Option<Spanned<String>>,
}

/// Triangles of an Abaqus input file.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AbaqusTriangles {
    /// Path, relative to the folder of the scene.
    pub file: Spanned<String>,
    /// Element sets of triangles that form the fault; absent: all triangles, in a file without cells in space.
    pub elsets: Option<Spanned<Vec<Spanned<String>>>>,
    /// Unit of length of the file.
    #[schemars(extend("x-default" = usual(defaults::FILE_UNIT)))]
    pub unit: Option<Spanned<String>>,
}

/// Triangles of an STL file.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StlTriangles {
    /// Path, relative to the folder of the scene.
    pub file: Spanned<String>,
    /// Names of the solids of a text that form the fault; absent: all triangles.
    pub solids: Option<Spanned<Vec<Spanned<String>>>>,
    /// Unit of length of the file.
    #[schemars(extend("x-default" = usual(defaults::FILE_UNIT)))]
    pub unit: Option<Spanned<String>>,
}

impl FaultTriangles {
    /// Path of the file, relative to the folder of the scene.
    #[must_use]
    pub fn file(&self) -> &Spanned<String> {
        match self {
            Self::Gmsh(mesh) => &mesh.file,
            Self::Abaqus(mesh) => &mesh.file,
            Self::Stl(mesh) => &mesh.file,
            Self::Depths(mesh) => &mesh.file,
        }
    }

    /// Names of the groups that form the fault.
    #[must_use]
    pub fn groups(&self) -> Option<&Spanned<Vec<Spanned<String>>>> {
        match self {
            Self::Gmsh(mesh) => mesh.groups.as_ref(),
            Self::Abaqus(mesh) => mesh.elsets.as_ref(),
            Self::Stl(mesh) => mesh.solids.as_ref(),
            Self::Depths(_) => None,
        }
    }

    /// Unit of length of the file.
    #[must_use]
    pub fn unit(&self) -> Option<&Spanned<String>> {
        match self {
            Self::Gmsh(mesh) => mesh.unit.as_ref(),
            Self::Abaqus(mesh) => mesh.unit.as_ref(),
            Self::Stl(mesh) => mesh.unit.as_ref(),
            Self::Depths(mesh) => Some(&mesh.unit),
        }
    }
}
