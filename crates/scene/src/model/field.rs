//! Parameters of a fault at positions in a file.

use crate::spanned::Spanned;
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
}

impl Fields {
    /// Fields with the names of their parameters.
    #[must_use]
    pub fn all(&self) -> [(&'static str, Option<&Field>); 5] {
        [("a", &self.a), ("b", &self.b), ("l", &self.l), ("normal", &self.normal), ("shear", &self.shear)]
            .map(|(key, field)| (key, field.as_ref()))
    }
}

/// Values of a parameter in a file of columns.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Field {
    /// Path of a CSV file, relative to the folder of the scene.
    pub file: Spanned<String>,
    /// Column of the values; absent: the one with the name of the parameter.
    pub column: Option<Spanned<String>>,
    /// Values between positions: `"linear"` (default), on the triangles between them, or `"nearest"`.
    pub interpolation: Option<Spanned<FieldInterpolation>>,
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
