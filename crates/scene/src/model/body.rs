//! Materials, bodies and meshes as declared in a scene.

use super::stress::InitialStress;
use super::trace::Trace;
use crate::defaults;
use crate::exact_list::{self, ExactList};
use crate::key_default::usual;
use crate::kind::Kind;
use crate::kinematics;
use crate::shape::{Either, shaped};
use crate::spanned::Spanned;
use crate::units::{Density, Length, Pressure, Velocity, Viscosity};
use schemars::JsonSchema;
use serde::de::{
    self, Deserializer, MapAccess, SeqAccess, Visitor,
    value::{MapAccessDeserializer, SeqAccessDeserializer},
};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt;

/// An isotropic material: elastic, optionally plastic or viscous.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Young's modulus E, positive \[Pa\].
    pub young: Spanned<Pressure>,
    /// Poisson's ratio ν, between -1 and 0.5, both excluded \[-\].
    pub poisson: Spanned<f64>,
    /// Density ρ, required for `gravity`, for inertia and for radiation damping \[kg/m3\].
    pub density: Option<Spanned<Density>>,
    /// J2 plasticity, a table; absent: none.
    pub plasticity: Option<Spanned<Plasticity>>,
    /// Maxwell material: viscosity η; the shear stress relaxes as exp(-G t/η) \[Pa s\].
    pub viscosity: Option<Spanned<Viscosity>>,
    /// Up to four Maxwell elements in parallel: `[{ share = .., viscosity = .. }, ..]`.
    pub maxwell: Option<Spanned<Vec<Branch>>>,
}

impl Material {
    /// True if the stress is a linear function of the strain alone.
    #[must_use]
    pub fn is_elastic(&self) -> bool {
        self.plasticity.is_none() && self.viscosity.is_none() && self.maxwell.is_none()
    }
}

/// Yield and hardening.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plasticity {
    /// Initial yield stress Y0 \[Pa\].
    #[serde(rename = "yield")]
    #[schemars(extend("x-with" = ["hardening", "perfect", "linear", "power"]))]
    pub initial: Option<Spanned<Pressure>>,
    /// Hardening of the yield stress.
    pub hardening: Spanned<Hardening>,
    /// Slope H = dY/de_p \[Pa\].
    #[schemars(extend("x-with" = ["hardening", "linear"]))]
    pub modulus: Option<Spanned<Pressure>>,
    /// Reference plastic strain e_0 \[-\].
    #[schemars(extend("x-with" = ["hardening", "power"]))]
    pub strain: Option<Spanned<f64>>,
    /// Exponent n \[-\].
    #[schemars(extend("x-with" = ["hardening", "power"]))]
    pub exponent: Option<Spanned<f64>>,
    /// Pairs (plastic strain \[-\], yield stress \[Pa\]).
    #[serde(default, deserialize_with = "exact_list::optional_pairs")]
    #[schemars(extend("x-with" = ["hardening", "table"]))]
    pub table: Option<Spanned<Vec<(f64, Pressure)>>>,
}

/// Hardening laws.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Hardening {
    /// Y constant.
    Perfect,
    /// Y = Y0 + H e_p.
    Linear,
    /// Y = Y0 (1 + e_p/e_0)^n.
    Power,
    /// Piecewise linear.
    Table,
}

/// A dashpot of a generalised Maxwell material.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Branch {
    /// Share of the shear modulus \[-\].
    pub share: f64,
    /// Viscosity η \[Pa s\].
    pub viscosity: Viscosity,
}

/// A deformable body.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Body {
    /// Source of the mesh: exactly one of the [kinds of mesh](meshes.md).
    pub mesh: MeshSource,
    /// Coordinates of the layers through which a plane mesh is extruded, in `"3d"` \[m\].
    #[schemars(extend("x-kinematics" = kinematics::SPACE, "x-otherwise" = "it makes a mesh three-dimensional, for `kinematics = \"3d\"`"))]
    pub extrude: Option<Spanned<Vec<Length>>>,
    /// Name of a material, or a table of names by groups of cells: `{ lower = "a", upper = "b" }`.
    pub material: Spanned<MaterialChoice>,
    /// Treatment of the dilatation: `"standard"` or `"b-bar"`.
    #[schemars(extend("x-default" = usual(Formulation::default())))]
    #[serde(default)]
    pub formulation: Option<Spanned<Formulation>>,
    /// Measure of strains: `"small"` or `"finite"`.
    #[schemars(extend("x-default" = usual(Strain::default())))]
    #[serde(default)]
    pub strain: Option<Spanned<Strain>>,
    /// Initial stress, tension positive: a list, or a [table](#stress-that-grows-with-depth); absent: none \[Pa\].
    pub initial_stress: Option<Spanned<InitialStress>>,
    /// Acceleration of gravity: plain numbers, one per axis of motion; needs `density` \[m/s2\].
    pub gravity: Option<Spanned<Vec<f64>>>,
    /// Velocity at the start, one entry per axis of motion; needs `inertia`; absent: none \[m/s\].
    #[schemars(extend("x-kinds" = [Kind::Implicit], "x-instead" = "other bodies start in equilibrium"))]
    pub velocity: Option<Spanned<Vec<Velocity>>>,
}

impl Body {
    /// True if the body undergoes finite strain.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.strain.as_ref().is_some_and(|s| *s.get_ref() == Strain::Finite)
    }

    /// Names of the materials, each with its group of cells, if any, and its position in the file.
    pub fn materials(&self) -> impl Iterator<Item = (Option<&str>, &str, std::ops::Range<usize>)> {
        let (one, groups) = match self.material.get_ref() {
            MaterialChoice::One(name) => (Some((None, name.as_str(), self.material.span())), None),
            MaterialChoice::ByGroup(groups) => (None, Some(groups)),
        };
        let groups = groups.into_iter().flatten();
        one.into_iter().chain(groups.map(|(g, m)| (Some(g.as_str()), m.get_ref().as_str(), m.span())))
    }
}

/// The material of a body.
#[derive(Clone, Debug)]
pub enum MaterialChoice {
    /// One for all cells.
    One(String),
    /// One for each group of cells.
    ByGroup(BTreeMap<String, Spanned<String>>),
}

shaped!(MaterialChoice as Either<String, BTreeMap<String, String>>);

impl<'de> Deserialize<'de> for MaterialChoice {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct ChoiceVisitor;
        impl<'de> Visitor<'de> for ChoiceVisitor {
            type Value = MaterialChoice;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("the name of a material, or a table of names by groups of cells")
            }

            fn visit_str<E: de::Error>(self, name: &str) -> Result<MaterialChoice, E> {
                Ok(MaterialChoice::One(name.to_string()))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<MaterialChoice, A::Error> {
                BTreeMap::deserialize(MapAccessDeserializer::new(map)).map(MaterialChoice::ByGroup)
            }
        }
        deserializer.deserialize_any(ChoiceVisitor)
    }
}

/// Treatments of the dilatation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Formulation {
    /// Standard: integrated as the shape functions give it.
    #[default]
    Standard,
    /// Projected in each cell; avoids locking near incompressibility.
    BBar,
}

/// Measures of strain.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Strain {
    /// Infinitesimal, on the reference geometry.
    #[default]
    Small,
    /// Finite: updated Lagrangian, Jaumann rate of the Kirchhoff stress.
    Finite,
}

/// Sources of meshes.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub enum MeshSource {
    /// A generated rectangular block.
    Block(BlockMesh),
    /// A generated patch with four straight sides.
    Quadrilateral(QuadrilateralMesh),
    /// A generated box around a fault, split along it.
    Fault(FaultMesh),
    /// A Gmsh file, MSH 2.2 or 4.1.
    Gmsh(GmshMesh),
    /// An Abaqus input file.
    Abaqus(AbaqusMesh),
}

/// A structured, possibly graded block.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BlockMesh {
    /// Lower corner \[m\].
    pub min: Spanned<Vec<Length>>,
    /// Upper corner \[m\].
    pub max: Spanned<Vec<Length>>,
    /// Size of the cells; must divide each edge \[m\].
    pub size: Option<Spanned<Length>>,
    /// Number of cells along each axis.
    pub divisions: Option<Spanned<Vec<usize>>>,
    /// Sizes of the cells along each axis \[m\].
    pub spacing: Option<Spanned<Vec<Spanned<SpacingSpec>>>>,
    /// With `size` or `divisions`: ratio of the last cell size to the first along each axis; absent: 1 \[-\].
    pub grading: Option<Spanned<Vec<f64>>>,
    /// Cells that become larger with the distance from a side.
    pub coarser: Option<Spanned<CoarserSpec>>,
    /// Curved sides by name.
    #[serde(default)]
    pub curves: BTreeMap<String, Spanned<CurveSpec>>,
    /// Name of the element, such as `"quad4"`.
    pub element: Spanned<String>,
}

/// Cells of a block that become larger with the distance from one side.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CoarserSpec {
    /// Name of the side, such as `"right"`.
    pub from: Spanned<String>,
    /// Distances from the side, ascending: beyond each of them three cells become one along every axis of the side \[m\].
    pub beyond: Spanned<Vec<Length>>,
}

/// A curved side of a block.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CurveSpec {
    /// Shape.
    pub kind: Spanned<CurveKind>,
    /// Radius of curvature at the apex, positive if the body is convex \[m\].
    pub radius: Spanned<Length>,
    /// Line along which the side touches the straight side of the block.
    pub apex: Spanned<Apex>,
}

/// Shapes of curved sides.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum CurveKind {
    /// r²/(2R).
    Parabola,
    /// R - √(R² - r²).
    Circle,
}

/// Coordinates of an apex along the axes over which a side curves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Apex {
    /// Coordinate x \[m\].
    pub x: Option<Length>,
    /// Coordinate y \[m\].
    pub y: Option<Length>,
    /// Coordinate z \[m\].
    pub z: Option<Length>,
}

impl Apex {
    /// Coordinate along an axis.
    #[must_use]
    pub fn along(&self, axis: usize) -> Option<Length> {
        [self.x, self.y, self.z][axis]
    }
}

/// A patch with four straight sides: the unit square mapped bilinearly.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct QuadrilateralMesh {
    /// Corners anticlockwise from the lower left \[m\].
    #[serde(deserialize_with = "exact_list::lists")]
    pub corners: Spanned<[[Length; 2]; 4]>,
    /// Number of cells from left to right and from bottom to top.
    #[serde(deserialize_with = "exact_list::list")]
    pub divisions: Spanned<[usize; 2]>,
    /// Ratio of the last cell size to the first in both directions; absent: 1 \[-\].
    #[serde(default, deserialize_with = "exact_list::optional")]
    pub grading: Option<Spanned<[f64; 2]>>,
    /// Name of the element, such as `"quad4"`.
    pub element: Spanned<String>,
}

/// A box with one fault.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FaultMesh {
    /// Vertices of the fault from tip to tip, `[[x, y], ..]`, y up; monotonic in y \[m\].
    pub trace: Spanned<Trace>,
    /// Curve through the vertices: `"spline"`, a smooth curve, or `"polyline"`, straight lines with corners.
    #[schemars(extend("x-default" = usual(InterpolationSpec::default())))]
    #[serde(default)]
    pub interpolation: InterpolationSpec,
    /// Sizes of the cells along the fault, in one of the three forms above; distances are measured from the first vertex \[m\].
    pub spacing: Spanned<SpacingSpec>,
    /// Thickness of the first cells across the fault; default: the smallest size along it \[m\].
    pub thickness: Option<Spanned<Length>>,
    /// Lower corner of the box \[m\].
    #[serde(deserialize_with = "exact_list::list")]
    pub min: Spanned<[Length; 2]>,
    /// Upper corner of the box \[m\].
    #[serde(deserialize_with = "exact_list::list")]
    pub max: Spanned<[Length; 2]>,
    /// Largest ratio of neighbouring sizes away from the fault \[-\].
    pub growth: Spanned<f64>,
    /// Element: `"quad4"`, `"quad8"` or `"quad9"`.
    pub element: Spanned<String>,
}

/// Curve through the vertices of a trace.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum InterpolationSpec {
    /// A smooth curve.
    #[default]
    Spline,
    /// Straight lines that meet in corners.
    Polyline,
}

/// Cell sizes along a fault.
#[derive(Clone, Debug, PartialEq)]
pub enum SpacingSpec {
    /// Constant size \[m\].
    Constant(Length),
    /// Constant size within a zone, growing beyond it.
    Zone(Zone),
    /// Pairs of distance along the fault and size \[m\].
    Graded(Vec<[Length; 2]>),
}

/// A zone of constant cell size along a fault.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Zone {
    /// Size within the zone \[m\].
    pub size: Length,
    /// Start of the zone along the fault \[m\].
    pub from: Length,
    /// End of the zone along the fault \[m\].
    pub to: Length,
    /// Largest ratio of neighbouring sizes beyond the zone \[-\].
    pub ratio: f64,
}

shaped!(SpacingSpec as Either<Length, Either<Zone, Vec<[Length; 2]>>>);

impl<'de> Deserialize<'de> for SpacingSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct SpacingVisitor;
        impl<'de> Visitor<'de> for SpacingVisitor {
            type Value = SpacingSpec;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a length such as \"25 m\", { size = .., from = .., to = .., ratio = .. }, or pairs [distance, size]")
            }

            fn visit_f64<E: de::Error>(self, value: f64) -> Result<SpacingSpec, E> {
                Ok(SpacingSpec::Constant(Length(value)))
            }

            fn visit_i64<E: de::Error>(self, value: i64) -> Result<SpacingSpec, E> {
                Ok(SpacingSpec::Constant(Length(value as f64)))
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<SpacingSpec, E> {
                Length::deserialize(de::value::StrDeserializer::new(text)).map(SpacingSpec::Constant)
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<SpacingSpec, A::Error> {
                Zone::deserialize(MapAccessDeserializer::new(map)).map(SpacingSpec::Zone)
            }

            fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<SpacingSpec, A::Error> {
                let pairs = Vec::<ExactList<Length, 2>>::deserialize(SeqAccessDeserializer::new(list))?;
                Ok(SpacingSpec::Graded(pairs.into_iter().map(|pair| pair.0).collect()))
            }
        }
        deserializer.deserialize_any(SpacingVisitor)
    }
}

/// A mesh read from a Gmsh file.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GmshMesh {
    /// Path, relative to the folder of the scene.
    pub file: Spanned<String>,
    /// Physical groups of cells that form the body; absent: all cells.
    pub groups: Option<Spanned<Vec<Spanned<String>>>>,
    /// Unit of length of the file.
    #[schemars(extend("x-default" = usual(defaults::FILE_UNIT)))]
    pub unit: Option<Spanned<String>>,
    /// Numbers of groups by name.
    #[serde(default)]
    pub tags: BTreeMap<String, Spanned<TagSpec>>,
    /// Named surfaces inside the body along which it is split into two sides, `BODY.NAME.minus` and `BODY.NAME.plus`.
    #[serde(default)]
    pub split: Vec<Spanned<String>>,
    /// Direction from the minus to the plus side of a surface in `split`, such as `{ fault = [1, 0] }`; default: larger x.
    #[serde(default)]
    pub plus: BTreeMap<String, Spanned<Vec<f64>>>,
}

/// Number of a group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TagSpec {
    /// Number of the physical group, or N of a group named `material-id:N`.
    pub tag: i64,
    /// Dimension of its elements; absent: groups of this number of every dimension.
    pub dimension: Option<usize>,
}

/// Number of a group as a table.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct TagTable {
    tag: i64,
    dimension: Option<usize>,
}

shaped!(TagSpec as Either<i64, Either<String, TagTable>>);

impl<'de> Deserialize<'de> for TagSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct TagVisitor;
        impl<'de> Visitor<'de> for TagVisitor {
            type Value = TagSpec;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(
                    "the number of a group such as 7, \"material-id:7\" or { tag = 7, dimension = 1 }",
                )
            }

            fn visit_i64<E: de::Error>(self, tag: i64) -> Result<TagSpec, E> {
                Ok(TagSpec { tag, dimension: None })
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<TagSpec, E> {
                let number = text.strip_prefix("material-id:").and_then(|n| n.trim().parse().ok());
                let tag = number.ok_or_else(|| E::invalid_value(de::Unexpected::Str(text), &self))?;
                Ok(TagSpec { tag, dimension: None })
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<TagSpec, A::Error> {
                let TagTable { tag, dimension } = TagTable::deserialize(MapAccessDeserializer::new(map))?;
                match dimension.filter(|d| *d > 3) {
                    Some(d) => Err(de::Error::custom(format!("a group has the dimension 0 to 3, not {d}"))),
                    None => Ok(TagSpec { tag, dimension }),
                }
            }
        }
        deserializer.deserialize_any(TagVisitor)
    }
}

/// A mesh read from an Abaqus input file.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AbaqusMesh {
    /// Path, relative to the folder of the scene.
    pub file: Spanned<String>,
    /// Element sets that form the body; absent: all elements.
    pub elsets: Option<Spanned<Vec<Spanned<String>>>>,
    /// Unit of length of the file.
    #[schemars(extend("x-default" = usual(defaults::FILE_UNIT)))]
    pub unit: Option<Spanned<String>>,
    /// Named surfaces inside the body along which it is split into two sides, `BODY.NAME.minus` and `BODY.NAME.plus`.
    #[serde(default)]
    pub split: Vec<Spanned<String>>,
    /// Direction from the minus to the plus side of a surface in `split`, such as `{ fault = [1, 0] }`; default: larger x.
    #[serde(default)]
    pub plus: BTreeMap<String, Spanned<Vec<f64>>>,
}
