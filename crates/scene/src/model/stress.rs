//! The stress that a body starts with.

use crate::shape::{Either, shaped};
use crate::spanned::Spanned;
use crate::units::{Gradient, Length, Pressure};
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserializer, MapAccess, SeqAccess, Visitor};
use std::fmt;

/// The stress of a body at the start, tension positive.
#[derive(Clone, Debug)]
pub enum InitialStress {
    /// The same everywhere: [xx, yy, xy], in antiplane motion [yz, zx], or [xx, yy, zz, xy, yz, zx] \[Pa\].
    Uniform(Vec<Pressure>),
    /// Varying along an axis.
    Varying(Box<VaryingStress>),
}

impl InitialStress {
    /// True if it has components in the plane.
    #[must_use]
    pub fn presses(&self) -> bool {
        !matches!(self, Self::Uniform(values) if values.len() <= 2)
    }
}

/// A stress that varies linearly along an axis.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VaryingStress {
    /// Its source.
    pub kind: Spanned<StressKind>,
    /// Linear: the axis.
    pub along: Option<Spanned<Axis>>,
    /// Lithostatic: height of the upper end, along the axis of `gravity`. Linear: coordinate at which the stress is `stress` \[m\].
    pub level: Option<Spanned<Length>>,
    /// Linear: components at the level, as those of a uniform stress \[Pa\].
    pub stress: Option<Spanned<Vec<Pressure>>>,
    /// Linear: change of the components per length along the axis \[Pa/m\].
    pub gradient: Option<Spanned<Vec<Gradient>>>,
    /// Ratio of the stress in all horizontal directions to the vertical stress \[-\].
    pub k0: Option<Spanned<f64>>,
    /// Vertical pressure at the level, from layers above that are other bodies; default 0 \[Pa\].
    pub overburden: Option<Spanned<Pressure>>,
}

/// Source of a stress that varies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum StressKind {
    /// Its value at a level and its gradient.
    Linear,
    /// The weight of what lies above.
    Lithostatic,
}

/// An axis of space.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Axis {
    /// The first.
    X,
    /// The second.
    Y,
    /// The third.
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
