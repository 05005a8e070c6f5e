//! Faults through earthquake cycles as a scene declares them.

use super::LawSpec;
use crate::scene::units::{Damping, Length, Pressure, Velocity};
use serde::Deserialize;
use serde::de::{self, Deserializer, Visitor};
use serde_spanned::Spanned;
use std::fmt;

/// A fault: two sides at one place that slide past each other and do not part; their jump is the unknown.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fault {
    /// Set of the minus side, `body.set`.
    pub minus: Spanned<String>,
    /// Set of the plus side: slip is that of plus relative to minus.
    pub plus: Spanned<String>,
    /// Friction.
    pub law: Spanned<LawSpec>,
    /// What varies along the fault.
    #[serde(default)]
    pub profiles: Profiles,
    /// Normal traction f_n at the start \[Pa\].
    pub normal: Spanned<Pressure>,
    /// Slip rate of all points at the start \[m/s\].
    pub rate: Spanned<Velocity>,
    /// Shear traction at the start \[Pa\]; absent: that of the law's initial steady state at `rate`.
    pub shear: Option<Spanned<Pressure>>,
    /// Radiation damping.
    pub damping: Option<Spanned<DampingSpec>>,
    /// Where slip is prescribed.
    pub creep: Option<Creep>,
}

/// Parameters that vary along a fault; their value in the law, or beside it, is not used then.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Profiles {
    /// Direct effect a \[-\].
    pub a: Option<Profile>,
    /// Evolution effect b \[-\]; laws with one state variable.
    pub b: Option<Profile>,
    /// Characteristic slip L \[m\]; laws with one state variable.
    pub l: Option<Profile>,
    /// Normal traction at the start \[Pa\].
    pub normal: Option<Profile>,
}

/// A parameter along a fault.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Profile {
    /// What it depends on.
    pub along: Spanned<Along>,
    /// Pairs of place \[m\] and value in SI, the places ascending: linear between, constant beyond.
    pub points: Spanned<Vec<(Length, f64)>>,
}

/// A coordinate of the points of a fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Along {
    /// The coordinate x.
    X,
    /// The coordinate y.
    Y,
    /// Distance along a plane fault from its upper end.
    Distance,
}

/// The part of a fault that slips at a given rate.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Creep {
    /// Distance along the fault from its upper end beyond which it does \[m\].
    pub beyond: Spanned<Length>,
    /// Slip rate \[m/s\].
    pub rate: Spanned<Velocity>,
}

/// Radiation damping: a number, or from the material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DampingSpec {
    /// η \[Pa s/m\].
    Value(f64),
    /// η = √(G ρ)/2, half the impedance of shear waves.
    Radiation,
}

impl<'de> Deserialize<'de> for DampingSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct DampingVisitor;
        impl Visitor<'_> for DampingVisitor {
            type Value = DampingSpec;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("\"radiation\", or a damping such as \"5 MPa s/m\" or a number in Pa s/m")
            }

            fn visit_f64<E: de::Error>(self, value: f64) -> Result<DampingSpec, E> {
                Ok(DampingSpec::Value(value))
            }

            fn visit_i64<E: de::Error>(self, value: i64) -> Result<DampingSpec, E> {
                Ok(DampingSpec::Value(value as f64))
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<DampingSpec, E> {
                if text == "radiation" {
                    return Ok(DampingSpec::Radiation);
                }
                Damping::deserialize(de::value::StrDeserializer::new(text)).map(|d| DampingSpec::Value(d.0))
            }
        }
        deserializer.deserialize_any(DampingVisitor)
    }
}
