//! Initial stress of a body.

use crate::key_default::usual;
use crate::shape::{Either, shaped};
use crate::spanned::Spanned;
use crate::units::{Gradient, Length, Pressure};
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserializer, MapAccess, SeqAccess, Visitor};
use std::fmt;

/// Initial stress of a body, tension positive.
#[derive(Clone, Debug)]
pub enum InitialStress {
    /// Uniform components: [xx, yy, xy], in antiplane motion [yz, zx], or [xx, yy, zz, xy, yz, zx] \[Pa\].
    Uniform(Vec<Pressure>),
    /// Varying along an axis.
    Varying(Box<VaryingStress>),
}

impl InitialStress {
    /// True if the stress has components in the plane.
    #[must_use]
    pub fn presses(&self) -> bool {
        !matches!(self, Self::Uniform(values) if values.len() <= 2)
    }
}

/// A stress that varies linearly along an axis.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VaryingStress {
    /// Source.
    pub kind: Spanned<StressKind>,
    /// Axis along which the stress grows.
    #[schemars(extend("x-with" = ["kind", "linear"]))]
    pub along: Option<Spanned<Axis>>,
    /// Lithostatic: coordinate of the upper end along the axis of `gravity`. Linear: coordinate at which the stress is `stress`
    /// \[m\].
    pub level: Option<Spanned<Length>>,
    /// Components at the level, in the order of a uniform stress \[Pa\].
    #[schemars(extend("x-with" = ["kind", "linear"]))]
    pub stress: Option<Spanned<Vec<Pressure>>>,
    /// Gradient of the components along the axis \[Pa/m\].
    #[schemars(extend("x-with" = ["kind", "linear"]))]
    pub gradient: Option<Spanned<Vec<Gradient>>>,
    /// Ratio of the stress in all horizontal directions to the vertical stress \[-\].
    #[schemars(extend("x-with" = ["kind", "lithostatic"]))]
    pub k0: Option<Spanned<f64>>,
    /// Vertical pressure at the level from overlying layers that are other bodies \[Pa\].
    #[schemars(extend("x-with" = ["kind", "lithostatic"], "x-default" = usual(0)))]
    pub overburden: Option<Spanned<Pressure>>,
}

/// Source of a varying stress.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum StressKind {
    /// Value at a level and gradient.
    Linear,
    /// Weight of the overlying material.
    Lithostatic,
}

/// An axis of space.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Axis {
    /// First axis.
    X,
    /// Second axis.
    Y,
    /// Third axis.
    Z,
}

shaped!(InitialStress as Either<Vec<Pressure>, VaryingStress>);

impl<'de> Deserialize<'de> for InitialStress {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct StressVisitor;
        impl<'de> Visitor<'de> for StressVisitor {
            type Value = InitialStress;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(
                    "a list of stresses such as [\"-1 MPa\", \"-2 MPa\", 0], { kind = \"lithostatic\", level = .., k0 = .. } or \
                     { kind = \"linear\", along = .., level = .., stress = [..], gradient = [..] }",
                )
            }

            fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<InitialStress, A::Error> {
                Deserialize::deserialize(SeqAccessDeserializer::new(list)).map(InitialStress::Uniform)
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<InitialStress, A::Error> {
                let varying = VaryingStress::deserialize(MapAccessDeserializer::new(map))?;
                Ok(InitialStress::Varying(Box::new(varying)))
            }
        }
        deserializer.deserialize_any(StressVisitor)
    }
}
