//! Frictional heat on a fault, as declared in a scene.

use crate::spanned::Spanned;
use crate::units::{Diffusivity, HeatCapacity, Length, PerKelvin, Temperature};
use schemars::JsonSchema;
use serde::Deserialize;

/// Heat of friction in a zone along a fault, and its diffusion across the fault.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Heat {
    /// Thickness h of the zone that slips: slip is distributed across the fault as a Gaussian of standard deviation h/√(2π) \[m\].
    pub thickness: Spanned<Length>,
    /// Thermal diffusivity of the rock \[m2/s\].
    pub diffusivity: Spanned<Diffusivity>,
    /// Heat capacity per volume ρ c \[J/(m3 K)\].
    pub capacity: Spanned<HeatCapacity>,
    /// Temperature at the start; only where the law has no `temperature` \[K\].
    pub temperature: Option<Spanned<Temperature>>,
    /// Temperature above which the report warns of melting \[K\].
    pub melting: Option<Spanned<Temperature>>,
    /// With evolution flash: temperature T_w at which contacts weaken; `v_w` is then the value at the initial temperature \[K\].
    pub weakening_temperature: Option<Spanned<Temperature>>,
    /// Pore fluid that heat expands: thermal pressurisation.
    pub pressurisation: Option<Spanned<Pressurisation>>,
}

/// Pore fluid that heat expands.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Pressurisation {
    /// Pressure per temperature of fluid that cannot drain, Λ \[Pa/K\].
    pub coefficient: Spanned<PerKelvin>,
    /// Hydraulic diffusivity \[m2/s\].
    pub diffusivity: Spanned<Diffusivity>,
}
