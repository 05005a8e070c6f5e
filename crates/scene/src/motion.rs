//! Reading of motions, loadings and fluxes.

use super::entry::Entry;
use super::model::{Flux, Loading, Motion, Pace, TableFile, TimeSeries};
use super::units::{self, Dimension, Length, Pressure, Velocity};
use crate::shape::{Either, shaped};
use schemars::JsonSchema;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{self, Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};
use std::fmt;
use std::marker::PhantomData;

#[derive(serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct MotionTable {
    to: Option<Length>,
    rate: Option<RateForm>,
    spring: Option<SideSpring>,
    table: Option<TableForm<Entry<Length>>>,
}

shaped!(Motion as Either<Length, MotionTable>);

impl<'de> Deserialize<'de> for Motion {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct MotionVisitor;
        impl<'de> Visitor<'de> for MotionVisitor {
            type Value = Motion;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(
                    "a motion such as \"1 mm\", 0, \"hold\", \"free\", {to = ..}, {rate = ..}, \
                     {spring = .., rate = ..} or {table = [[time, displacement], ..]}",
                )
            }

            fn visit_f64<E: de::Error>(self, value: f64) -> Result<Motion, E> {
                units::finite(value, Dimension::Length).map(Motion::Fixed)
            }

            fn visit_i64<E: de::Error>(self, value: i64) -> Result<Motion, E> {
                Ok(Motion::Fixed(value as f64))
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<Motion, E> {
                match text {
                    "hold" => Ok(Motion::Hold),
                    "free" => Ok(Motion::Free),
                    _ if text.starts_with(|c: char| c.is_ascii_alphabetic()) => {
                        Err(E::invalid_value(de::Unexpected::Str(text), &self))
                    }
                    _ => units::parse(text, Dimension::Length).map(Motion::Fixed).map_err(E::custom),
                }
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Motion, A::Error> {
                let t = MotionTable::deserialize(MapAccessDeserializer::new(map))?;
                match (t.to, t.rate, t.table, t.spring) {
                    (Some(to), None, None, None) => Ok(Motion::To(to.0)),
                    (None, Some(rate), None, None) => Ok(Motion::Rate(rate.0)),
                    (None, Some(rate), None, Some(stiffness)) => {
                        Ok(Motion::Spring { stiffness: stiffness.0, rate: rate.0 })
                    }
                    (None, None, Some(points), None) => Ok(Motion::Table(points.tabled(|length| length.0))),
                    _ => Err(de::Error::custom(
                        "a motion has exactly one of the keys `to`, `rate`, `table`, or `spring` beside `rate`",
                    )),
                }
            }
        }
        deserializer.deserialize_any(MotionVisitor)
    }
}

/// A rate as written: a velocity, or a table of velocities.
struct RateForm(Pace);

#[derive(serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct RateTable {
    table: TableForm<Entry<Velocity>>,
}

shaped!(RateForm as Either<Velocity, RateTable>);

impl<'de> Deserialize<'de> for RateForm {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct RateVisitor;
        impl<'de> Visitor<'de> for RateVisitor {
            type Value = RateForm;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a velocity such as \"1e-3 mm/s\" or a number in m/s, or { table = [[time, velocity], ..] }")
            }

            fn visit_f64<E: de::Error>(self, value: f64) -> Result<RateForm, E> {
                units::finite(value, Dimension::Velocity).map(|rate| RateForm(Pace::Steady(rate)))
            }

            fn visit_i64<E: de::Error>(self, value: i64) -> Result<RateForm, E> {
                Ok(RateForm(Pace::Steady(value as f64)))
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<RateForm, E> {
                let rate = units::parse(text, Dimension::Velocity).map_err(E::custom)?;
                Ok(RateForm(Pace::Steady(rate)))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<RateForm, A::Error> {
                let given = RateTable::deserialize(MapAccessDeserializer::new(map))?;
                Ok(RateForm(Pace::Table(given.table.tabled(|velocity| velocity.0))))
            }
        }
        deserializer.deserialize_any(RateVisitor)
    }
}

/// A table as written: pairs of time and value, or a file that has them.
pub(crate) enum TableForm<E> {
    /// Its entries.
    Pairs(Vec<E>),
    /// The file.
    File(TableFile),
}

impl<Q> TableForm<Entry<Q>> {
    fn tabled(self, value: impl Fn(Q) -> f64) -> TimeSeries {
        match self {
            Self::Pairs(pairs) => {
                pairs.into_iter().map(|p| (p.time.0, value(p.value))).collect::<Vec<_>>().into()
            }
            Self::File(file) => TimeSeries::in_file(file),
        }
    }
}

shaped!(@ E; TableForm<E> as Either<Vec<E>, TableFile>);

impl<'de, E: Deserialize<'de>> Deserialize<'de> for TableForm<E> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct TableVisitor<E>(PhantomData<E>);
        impl<'de, E: Deserialize<'de>> Visitor<'de> for TableVisitor<E> {
            type Value = TableForm<E>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("pairs [[time, value], ..], or { file = \"FILE.csv\", column = \"NAME\" }")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<TableForm<E>, A::Error> {
                Deserialize::deserialize(SeqAccessDeserializer::new(list)).map(TableForm::Pairs)
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<TableForm<E>, A::Error> {
                TableFile::deserialize(MapAccessDeserializer::new(map)).map(TableForm::File)
            }
        }
        deserializer.deserialize_any(TableVisitor(PhantomData))
    }
}

/// Stiffness of a spring that pulls a whole side \[N/m; N/m per metre of thickness in the plane\].
struct SideSpring(f64);

shaped!(SideSpring as f64);

impl<'de> Deserialize<'de> for SideSpring {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct SpringVisitor;
        impl Visitor<'_> for SpringVisitor {
            type Value = SideSpring;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(
                    "a number of N/m without quotes, the stiffness of a spring that loads the whole side (in the plane Pa: \
                     per metre of thickness)",
                )
            }

            fn visit_f64<E: de::Error>(self, value: f64) -> Result<SideSpring, E> {
                if value.is_finite() {
                    Ok(SideSpring(value))
                } else {
                    Err(E::invalid_value(de::Unexpected::Float(value), &self))
                }
            }

            fn visit_i64<E: de::Error>(self, value: i64) -> Result<SideSpring, E> {
                Ok(SideSpring(value as f64))
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<SideSpring, E> {
                let instead = if let Ok(modulus) = units::parse(text, Dimension::Pressure) {
                    format!("in the plane that is `spring = {modulus:e}`")
                } else if units::parse(text, Dimension::Spring).is_ok() {
                    "a stiffness per area times the area of the side gives N/m".into()
                } else {
                    "such as `spring = 5e9`".into()
                };
                Err(E::custom(format!("expected {}, found \"{text}\": {instead}", Expectation(&self))))
            }
        }
        deserializer.deserialize_any(SpringVisitor)
    }
}

/// Formats what a visitor expects.
struct Expectation<'a, V>(&'a V);

impl<'de, V: Visitor<'de>> fmt::Display for Expectation<'_, V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.expecting(f)
    }
}

#[derive(serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct LoadingTable {
    to: Option<Pressure>,
    table: Option<TableForm<Entry<Pressure>>>,
}

shaped!(Loading as Either<Pressure, LoadingTable>);

impl<'de> Deserialize<'de> for Loading {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct LoadingVisitor;
        impl<'de> Visitor<'de> for LoadingVisitor {
            type Value = Loading;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(
                    "a load: a pressure such as \"5 MPa\", { to = .. } or { table = [[time, pressure], ..] }",
                )
            }

            fn visit_f64<E: de::Error>(self, value: f64) -> Result<Loading, E> {
                units::finite(value, Dimension::Pressure).map(Loading::Fixed)
            }

            fn visit_i64<E: de::Error>(self, value: i64) -> Result<Loading, E> {
                Ok(Loading::Fixed(value as f64))
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<Loading, E> {
                if text.starts_with(|c: char| c.is_ascii_alphabetic()) {
                    return Err(E::invalid_value(de::Unexpected::Str(text), &self));
                }
                units::parse(text, Dimension::Pressure).map(Loading::Fixed).map_err(E::custom)
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Loading, A::Error> {
                let t = LoadingTable::deserialize(MapAccessDeserializer::new(map))?;
                match (t.to, t.table) {
                    (Some(to), None) => Ok(Loading::To(to.0)),
                    (None, Some(points)) => Ok(Loading::Table(points.tabled(|pressure| pressure.0))),
                    _ => Err(de::Error::custom("a load has exactly one of the keys `to`, `table`")),
                }
            }
        }
        deserializer.deserialize_any(LoadingVisitor)
    }
}

#[derive(serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Stepped")]
struct StepTable {
    steps: TableForm<Entry<Velocity>>,
}

shaped!(Flux as Either<Velocity, StepTable>);

impl<'de> Deserialize<'de> for Flux {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct FluxVisitor;
        impl<'de> Visitor<'de> for FluxVisitor {
            type Value = Flux;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a flux such as \"1.25e-6 m/s\", or { steps = [[time, flux], ..] }")
            }

            fn visit_f64<E: de::Error>(self, value: f64) -> Result<Flux, E> {
                units::finite(value, Dimension::Velocity).map(Flux::Constant)
            }

            fn visit_i64<E: de::Error>(self, value: i64) -> Result<Flux, E> {
                Ok(Flux::Constant(value as f64))
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<Flux, E> {
                units::parse(text, Dimension::Velocity).map(Flux::Constant).map_err(E::custom)
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Flux, A::Error> {
                let given = StepTable::deserialize(MapAccessDeserializer::new(map))?;
                Ok(Flux::Steps(given.steps.tabled(|flux| flux.0)))
            }
        }
        deserializer.deserialize_any(FluxVisitor)
    }
}
