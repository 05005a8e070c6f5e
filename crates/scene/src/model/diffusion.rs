//! Fluid that diffuses along a fault, as declared in a scene.

use super::{Field, Flux, ParameterProfiles};
use crate::key_default::usual;
use crate::spanned::Spanned;
use crate::units::{Length, Permeability, Time, Viscosity};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Fluid from wells that diffuses along a fault whose permeability and storage may vary.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Diffusion {
    /// Permeability k of the fault along itself \[m2\].
    pub permeability: Option<Spanned<Permeability>>,
    /// Porosity times the compressibility of fluid and pores \[1/Pa\].
    pub storage: Option<Spanned<f64>>,
    /// Viscosity η of the fluid \[Pa s\].
    pub viscosity: Spanned<Viscosity>,
    /// Values of `permeability` or `storage` along the fault.
    #[serde(default)]
    pub profiles: DiffusionProfiles,
    /// Values of `permeability` or `storage` at positions in files.
    #[serde(default)]
    pub fields: DiffusionFields,
    /// Both ends of what slides of the fault: `"closed"` to flow, or `"drained"`, where the pressure stays zero.
    #[schemars(extend("x-default" = usual(DiffusionEnds::default())))]
    pub ends: Option<Spanned<DiffusionEnds>>,
    /// Wells.
    pub wells: Spanned<Vec<Well>>,
}

/// A parameter of the diffusion: its key, its constant value, its profile and its file.
pub type Hydraulic<'a> =
    (&'static str, Option<(f64, Range<usize>)>, Option<&'a ParameterProfiles>, Option<&'a Field>);

impl Diffusion {
    /// Parameters that may vary along the fault.
    #[must_use]
    pub fn parameters(&self) -> [Hydraulic<'_>; 2] {
        let permeability = self.permeability.as_ref().map(|k| (k.get_ref().0, k.span()));
        let storage = self.storage.as_ref().map(|s| (*s.get_ref(), s.span()));
        let (profiles, fields) = (&self.profiles, &self.fields);
        [
            ("permeability", permeability, profiles.permeability.as_ref(), fields.permeability.as_ref()),
            ("storage", storage, profiles.storage.as_ref(), fields.storage.as_ref()),
        ]
    }
}

/// Parameters of the diffusion that vary along a fault.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DiffusionProfiles {
    /// Permeability \[m2\].
    pub permeability: Option<ParameterProfiles>,
    /// Porosity times compressibility \[1/Pa\].
    pub storage: Option<ParameterProfiles>,
}

/// Parameters of the diffusion that files give at positions.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DiffusionFields {
    /// Permeability \[m2\].
    pub permeability: Option<Field>,
    /// Porosity times compressibility \[1/Pa\].
    pub storage: Option<Field>,
}

/// Ends of a fault along which fluid diffuses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum DiffusionEnds {
    /// No fluid flows through them.
    #[default]
    Closed,
    /// The pressure there is that at the start.
    Drained,
}

/// A well on a fault.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Well {
    /// Distance along the fault \[m\].
    pub at: Spanned<Length>,
    /// Volume per cross-sectional area and time, in both directions together; negative: extraction; or `{ steps = .. }` \[m/s\].
    pub flux: Spanned<Flux>,
    /// End of an injection at a constant flux; absent: no end \[s\].
    pub until: Option<Spanned<Time>>,
}
