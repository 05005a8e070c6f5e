//! Parameters of a fault or an interface at positions in a file.

use crate::spanned::Spanned;
use crate::units::Dimension;
use schemars::JsonSchema;
use serde::Deserialize;

/// Parameters that files give at positions. Their values in the law or in the fault are then not used.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fields {
    /// Direct effect a \[-\].
    pub a: Option<Field>,
    /// Evolution effect b \[-\]; laws with one state variable.
    pub b: Option<Field>,
    /// Characteristic slip L \[m\]; laws with one state variable.
    pub l: Option<Field>,
    /// Initial normal traction \[Pa\].
    pub normal: Option<Field>,
    /// Initial shear traction, of the sign of `rate` \[Pa\].
    pub shear: Option<Field>,
    /// Initial slip rate, of the sign of `rate` \[m/s\].
    pub rate: Option<Field>,
    /// Explicit, laws of slip: shear traction that a closed point carries at no normal traction \[Pa\].
    pub cohesion: Option<Field>,
    /// Initial state θ \[s\], or the state variable of a law without θ; instead of `shear`.
    pub state: Option<Field>,
    /// a - b: the evolution effect b is a less this \[-\].
    pub a_minus_b: Option<Field>,
}

impl Fields {
    /// Fields with the names of their parameters.
    #[must_use]
    pub fn all(&self) -> [(&'static str, Option<&Field>); 9] {
        [
            ("a", &self.a),
            ("b", &self.b),
            ("l", &self.l),
            ("normal", &self.normal),
            ("shear", &self.shear),
            ("rate", &self.rate),
            ("cohesion", &self.cohesion),
            ("state", &self.state),
            ("a_minus_b", &self.a_minus_b),
        ]
        .map(|(key, field)| (key, field.as_ref()))
    }
}

/// Parameters of the law of an interface that files give at positions. Their values in the law are then not used.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LawFields {
    /// Coulomb: friction coefficient \[-\].
    pub mu: Option<Field>,
    /// Static-kinetic, slip-weakening: coefficient before slip \[-\].
    pub mu_s: Option<Field>,
    /// Static-kinetic, slip-weakening: coefficient during or after slip \[-\].
    pub mu_k: Option<Field>,
    /// Slip-weakening: slip over which the coefficient falls \[m\].
    pub d_c: Option<Field>,
    /// Coulomb, slip-weakening: shear traction that a closed point carries at no normal traction \[Pa\].
    pub cohesion: Option<Field>,
    /// Reference coefficient μ0 \[-\].
    pub mu0: Option<Field>,
    /// Direct effect a \[-\].
    pub a: Option<Field>,
    /// Evolution effect b, in laws with one state variable \[-\].
    pub b: Option<Field>,
    /// Characteristic slip L, in laws with one state variable \[m\].
    pub l: Option<Field>,
    /// Initial state: slip rate at which the point was in steady state \[m/s\].
    pub v_initial: Option<Field>,
    /// Largest shear traction \[Pa\].
    pub f_limit: Option<Field>,
}

impl LawFields {
    /// Fields with the names of their parameters.
    #[must_use]
    pub fn all(&self) -> [(&'static str, Option<&Field>); 11] {
        [
            ("mu", &self.mu),
            ("mu_s", &self.mu_s),
            ("mu_k", &self.mu_k),
            ("d_c", &self.d_c),
            ("cohesion", &self.cohesion),
            ("mu0", &self.mu0),
            ("a", &self.a),
            ("b", &self.b),
            ("l", &self.l),
            ("v_initial", &self.v_initial),
            ("f_limit", &self.f_limit),
        ]
        .map(|(key, field)| (key, field.as_ref()))
    }

    /// Fields that are given, with the names of their parameters.
    pub fn given(&self) -> impl Iterator<Item = (&'static str, &Field)> {
        self.all().into_iter().filter_map(|(key, field)| Some((key, field?)))
    }
}

/// Dimension of a parameter that files may give; none of a number.
#[must_use]
pub fn field_dimension(key: &str) -> Option<Dimension> {
    match key {
        "l" | "d_c" => Some(Dimension::Length),
        "normal" | "shear" | "cohesion" | "f_limit" => Some(Dimension::Pressure),
        "v_initial" | "rate" => Some(Dimension::Velocity),
        "state" => Some(Dimension::Time),
        "permeability" => Some(Dimension::Permeability),
        _ => None,
    }
}

/// Values of a parameter in a file.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Field {
    /// Path of a CSV file, a netCDF grid or a VTU file, relative to the folder of the scene.
    pub file: Spanned<String>,
    /// Column, variable or array of the values; absent: the one with the name of the parameter. Decimal logarithms if it begins with `log10_`.
    pub column: Option<Spanned<String>>,
    /// Values between positions: `"linear"` or `"nearest"`; absent: `"linear"`, but for points of a VTU file without cells, and its arrays in cells.
    pub interpolation: Option<Spanned<FieldInterpolation>>,
    /// Unit of the values, such as `"MPa"`, where the file has none.
    pub unit: Option<Spanned<String>>,
    /// Unit of the coordinates that are lengths, such as `"km"`, where the file has none.
    pub coordinate_unit: Option<Spanned<String>>,
    /// Names of the coordinates in the file, such as `{ distance = "x" }`; absent: those of the same names.
    #[serde(default)]
    pub coordinates: FieldCoordinates,
}

/// Names that the coordinates of a field have in its file. With one of them, the others count only if they are named.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FieldCoordinates {
    /// Distance along the line.
    pub distance: Option<Spanned<String>>,
    /// Degrees east.
    pub longitude: Option<Spanned<String>>,
    /// Degrees north.
    pub latitude: Option<Spanned<String>>,
    /// Coordinate x.
    pub x: Option<Spanned<String>>,
    /// Coordinate y.
    pub y: Option<Spanned<String>>,
    /// Coordinate z.
    pub z: Option<Spanned<String>>,
    /// Depth, counted downwards.
    pub depth: Option<Spanned<String>>,
}

impl FieldCoordinates {
    /// Coordinates that are named, with their names in the file.
    pub fn named(&self) -> impl Iterator<Item = (&'static str, &Spanned<String>)> {
        let all = [
            ("distance", &self.distance),
            ("longitude", &self.longitude),
            ("latitude", &self.latitude),
            ("x", &self.x),
            ("y", &self.y),
            ("z", &self.z),
            ("depth", &self.depth),
        ];
        all.into_iter().filter_map(|(key, name)| Some((key, name.as_ref()?)))
    }
}

/// Values between the positions of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum FieldInterpolation {
    /// Linear on triangles; on a line, linear between neighbours.
    Linear,
    /// Those of the nearest position.
    Nearest,
}
