//! Inertia of bodies as declared in a scene.

use crate::defaults;
use crate::key_default::usual;
use crate::shape::{Either, shaped};
use crate::spanned::Spanned;
use crate::units::Velocity;
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::{self, Deserializer, MapAccess, Visitor, value::MapAccessDeserializer};
use std::fmt;

/// Settings of the time integration of bodies with mass.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InertiaSpec {
    /// Spectral radius ρ∞ at frequencies that the steps do not resolve, 0 to 1; 1 dissipates nothing \[-\].
    #[schemars(extend("x-default" = usual(defaults::SPECTRAL_RADIUS)))]
    pub spectral_radius: Option<Spanned<f64>>,
    /// Largest error of displacement in a step over the largest displacement of a step \[-\].
    #[schemars(extend("x-default" = usual(defaults::INERTIA_TOLERANCE)))]
    pub tolerance: Option<Spanned<f64>>,
}

/// Slip rates between which bodies pass from states of equilibrium to motion with inertia and back.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HandoverSpec {
    /// Largest slip rate above which bodies have inertia \[m/s\].
    #[schemars(extend("x-default" = usual(defaults::HANDOVER_ABOVE)))]
    pub above: Option<Spanned<Velocity>>,
    /// Largest slip rate below which they return to equilibrium, once it has stayed there while a shear wave crosses the bodies
    /// and returns \[m/s\].
    #[schemars(extend("x-default" = usual(defaults::HANDOVER_BELOW).share_of("`above`")))]
    pub below: Option<Spanned<Velocity>>,
    /// Largest kinetic energy with which they return, over the largest since they left; 1 is none \[-\].
    #[schemars(extend("x-default" = usual(defaults::HANDOVER_KINETIC)))]
    pub kinetic: Option<Spanned<f64>>,
}

/// Inertia of bodies, stated or with settings.
#[derive(Clone, Debug)]
pub enum Inertia {
    /// `true` or `false`.
    Stated(bool),
    /// With settings.
    Given(InertiaSpec),
}

impl Inertia {
    /// Settings; `None` if bodies have no inertia.
    #[must_use]
    pub fn settings(&self) -> Option<InertiaSpec> {
        match self {
            Self::Stated(false) => None,
            Self::Stated(true) => Some(InertiaSpec::default()),
            Self::Given(spec) => Some(spec.clone()),
        }
    }
}

shaped!(Inertia as Either<bool, InertiaSpec>);

impl<'de> Deserialize<'de> for Inertia {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct InertiaVisitor;
        impl<'de> Visitor<'de> for InertiaVisitor {
            type Value = Inertia;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("`true`, or a table such as `{ spectral_radius = 0.8 }`")
            }

            fn visit_bool<E: de::Error>(self, stated: bool) -> Result<Inertia, E> {
                Ok(Inertia::Stated(stated))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Inertia, A::Error> {
                InertiaSpec::deserialize(MapAccessDeserializer::new(map)).map(Inertia::Given)
            }
        }
        deserializer.deserialize_any(InertiaVisitor)
    }
}
