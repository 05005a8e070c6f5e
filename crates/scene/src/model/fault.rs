//! Faults through earthquake cycles as a scene declares them.

use super::LawSpec;
use crate::shape::{Either, shaped};
use crate::spanned::Spanned;
use crate::units::{Damping, Length, Pressure, Time, Velocity};
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{self, Deserializer, MapAccess, SeqAccess, Visitor};
use std::fmt;

/// A fault: two sides at one place that slide past each other; their jump is the unknown.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fault {
    /// Minus side, such as `BODY.fault.minus`.
    pub minus: Spanned<String>,
    /// Plus side, such as `BODY.fault.plus`; slip is that of plus relative to minus.
    pub plus: Spanned<String>,
    /// A [friction law](laws.md) of kind `"rate-and-state"` or `"rate"`, without `f_limit`.
    pub law: Spanned<LawSpec>,
    /// Values of `a`, `b`, `l`, `normal` or `shear` along the fault.
    #[serde(default)]
    pub profiles: Profiles,
    /// Normal traction at the start, compression positive; absent where the initial stress of the bodies gives it \[Pa\].
    pub normal: Option<Spanned<Pressure>>,
    /// Slip rate of all points at the start; its sign is the sense of slip \[m/s\].
    pub rate: Spanned<Velocity>,
    /// Shear traction at the start, of the sign of `rate`; absent: that of the law's initial steady state \[Pa\].
    pub shear: Option<Spanned<Pressure>>,
    /// Radiation damping η, or `"radiation"`; absent: none \[Pa s/m\].
    pub damping: Option<Spanned<DampingSpec>>,
    /// Part of the fault that slips at a given rate.
    pub creep: Option<Creep>,
    /// In space: direction of slip `[x, y, z]`, of any length; its part along the fault counts.
    #[serde(default, deserialize_with = "crate::exact::optional")]
    pub rake: Option<Spanned<[f64; 3]>>,
    /// In space: slip `"along-rake"` (default) or `"free"`, with a direction that may turn.
    pub slip: Option<Spanned<SlipSpec>>,
    /// Fluid that enters at one position and diffuses along the fault.
    pub injection: Option<Injection>,
    /// Treatment of less than one point per cohesive zone: `"refuse"` (default) or `"allow"`.
    pub under_resolved: Option<Spanned<UnderResolved>>,
    /// `false`: slip and loads do not change normal tractions; default `true`.
    pub normal_changes: Option<Spanned<bool>>,
    /// Smallest normal traction that friction uses \[Pa\].
    pub normal_floor: Option<Spanned<Pressure>>,
    /// `true`: the sides separate where no compression is left; needs `normal_floor`; default `false`.
    pub opening: Option<Spanned<bool>>,
}

/// Treatment of a fault whose points stand farther apart than the cohesive zone is long.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum UnderResolved {
    /// The scene is refused.
    Refuse,
    /// It runs with a warning.
    Allow,
}

/// Directions in which a fault in space slips.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SlipSpec {
    /// Along `rake`; slip across it is held at zero.
    AlongRake,
    /// Along the shear traction, wherever it points in the fault; along `rake` at the start.
    Free,
}

/// Parameters that vary along a fault; their value in the law, or beside it, is not used then.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Profiles {
    /// Direct effect a \[-\].
    pub a: Option<Profiled>,
    /// Evolution effect b \[-\]; laws with one state variable.
    pub b: Option<Profiled>,
    /// Characteristic slip L \[m\]; laws with one state variable.
    pub l: Option<Profiled>,
    /// Normal traction at the start \[Pa\].
    pub normal: Option<Profiled>,
    /// Shear traction at the start \[Pa\].
    pub shear: Option<Profiled>,
}

/// A parameter as one profile or the largest of several.
#[derive(Clone, Debug)]
pub struct Profiled(pub Vec<Profile>);

shaped!(Profiled as Either<Profile, Vec<Profile>>);

impl<'de> Deserialize<'de> for Profiled {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct ProfiledVisitor;
        impl<'de> Visitor<'de> for ProfiledVisitor {
            type Value = Profiled;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("{ along = .., points = .. }, or a list of such profiles of which the largest value holds")
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Profiled, A::Error> {
                Profile::deserialize(MapAccessDeserializer::new(map)).map(|p| Profiled(vec![p]))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Profiled, A::Error> {
                Deserialize::deserialize(SeqAccessDeserializer::new(list)).map(Profiled)
            }
        }
        deserializer.deserialize_any(ProfiledVisitor)
    }
}

/// A parameter along a fault.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Profile {
    /// Its dependence.
    pub along: Spanned<Along>,
    /// Pairs of place \[m\] and value in SI, the places ascending: linear between, constant beyond.
    #[serde(deserialize_with = "crate::exact::pairs")]
    pub points: Spanned<Vec<(Length, f64)>>,
}

/// A coordinate of the points of a fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Along {
    /// The coordinate x.
    X,
    /// The coordinate y.
    Y,
    /// The coordinate z.
    Z,
    /// Distance along a plane fault from its upper end.
    Distance,
}

/// The part of a fault that slips at a given rate.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Creep {
    /// Distance along a plane fault from its upper end beyond which it does \[m\].
    pub beyond: Option<Spanned<Length>>,
    /// The part outside which it does.
    pub outside: Option<Spanned<Outside>>,
    /// Slip rate \[m/s\].
    pub rate: Spanned<Velocity>,
    /// Direction of the slip rate where slip may turn, of any length; absent: that of the fault.
    #[serde(default, deserialize_with = "crate::exact::optional")]
    pub rake: Option<Spanned<[f64; 3]>>,
}

/// Ranges of coordinates within which, in all of them, a fault slides freely.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Outside {
    /// Of x.
    pub x: Option<Extent>,
    /// Of y.
    pub y: Option<Extent>,
    /// Of z.
    pub z: Option<Extent>,
}

impl Outside {
    /// By axis.
    #[must_use]
    pub fn ranges(&self) -> [Option<Extent>; 3] {
        [self.x, self.y, self.z]
    }
}

/// A range of a coordinate; its ends do not belong to it, and an end that is not given does not bound it.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Extent {
    /// Lower end \[m\].
    pub from: Option<Length>,
    /// Upper end \[m\].
    pub to: Option<Length>,
}

/// Position of a station.
#[derive(Clone, Debug, PartialEq)]
pub enum Station {
    /// Distance along a plane fault from its upper end \[m\].
    Along(f64),
    /// Coordinates \[m\].
    At(Vec<f64>),
}

shaped!(Station as Either<Length, Vec<Length>>);

impl<'de> Deserialize<'de> for Station {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct StationVisitor;
        impl<'de> Visitor<'de> for StationVisitor {
            type Value = Station;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(
                    "a distance such as \"5 km\", or coordinates such as [\"0 km\", \"-10 km\", \"24 km\"]",
                )
            }

            fn visit_f64<E: de::Error>(self, value: f64) -> Result<Station, E> {
                Ok(Station::Along(value))
            }

            fn visit_i64<E: de::Error>(self, value: i64) -> Result<Station, E> {
                Ok(Station::Along(value as f64))
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<Station, E> {
                Length::deserialize(de::value::StrDeserializer::new(text)).map(|l| Station::Along(l.0))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Station, A::Error> {
                let at: Vec<Length> = Deserialize::deserialize(SeqAccessDeserializer::new(list))?;
                Ok(Station::At(at.iter().map(|x| x.0).collect()))
            }
        }
        deserializer.deserialize_any(StationVisitor)
    }
}

/// Fluid injected at one place of a fault at a steady flux.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Injection {
    /// Distance along the fault \[m\].
    pub at: Spanned<Length>,
    /// Volume per area of the cross section and time, both ways; negative: extraction \[m/s\].
    pub flux: Spanned<Velocity>,
    /// Hydraulic diffusivity \[m²/s\].
    pub diffusivity: Spanned<f64>,
    /// Porosity \[-\].
    pub porosity: Spanned<f64>,
    /// Compressibility of fluid and pores \[1/Pa\].
    pub compressibility: Spanned<f64>,
    /// End of the injection; absent: never \[s\].
    pub until: Option<Spanned<Time>>,
}

/// Radiation damping: a number, or from the material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DampingSpec {
    /// η \[Pa s/m\].
    Value(f64),
    /// η = √(G ρ)/2, half the impedance of shear waves.
    Radiation,
}

shaped!(DampingSpec as Damping);

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
