//! Reading of the course of a quantity over time: a constant, a table, or a sine.

use crate::entry::Entry;
use crate::model::{Spanned, TimeSeries};
use crate::motion::TableForm;
use crate::shape::{Either, shaped};
use crate::units::Time;
use schemars::JsonSchema;
use serde::de::{
    self, Deserialize, Deserializer, IntoDeserializer, MapAccess, Visitor, value::MapAccessDeserializer,
};
use std::fmt;
use std::marker::PhantomData;

/// A course over time: a constant, a table, or a sine.
#[derive(Clone, Debug)]
pub enum Course<Q> {
    /// Constant.
    Constant(Q),
    /// Piecewise linear; two entries at the same time make a jump.
    Table(Vec<Spanned<Entry<Q>>>),
    /// The same in a file.
    File(TimeSeries),
    /// Sine around a mean.
    Sine {
        /// Mean.
        mean: Q,
        /// Amplitude.
        amplitude: Q,
        /// Period \[s\].
        period: Spanned<Time>,
        /// Time at which the sine crosses its mean upwards \[s\].
        start: Option<Time>,
    },
}

/// Keys of a course that is not constant.
#[derive(serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct CourseTable<Q> {
    table: Option<TableForm<Spanned<Entry<Q>>>>,
    mean: Option<Q>,
    amplitude: Option<Q>,
    period: Option<Spanned<Time>>,
    start: Option<Time>,
}

impl<Q> CourseTable<Q> {
    fn course<E: de::Error>(self) -> Result<Course<Q>, E> {
        let sine =
            self.mean.is_some() || self.amplitude.is_some() || self.period.is_some() || self.start.is_some();
        match self.table {
            Some(TableForm::Pairs(table)) if !sine => Ok(Course::Table(table)),
            Some(TableForm::File(file)) if !sine => Ok(Course::File(TimeSeries::in_file(file))),
            None if sine => Ok(Course::Sine {
                mean: self.mean.ok_or_else(|| E::missing_field("mean"))?,
                amplitude: self.amplitude.ok_or_else(|| E::missing_field("amplitude"))?,
                period: self.period.ok_or_else(|| E::missing_field("period"))?,
                start: self.start,
            }),
            _ => Err(E::custom(
                "a course has the key `table`, or the keys `mean`, `amplitude` and `period`, and not both",
            )),
        }
    }
}

impl<Q> Course<Q> {
    /// The table that a file has.
    pub(super) fn in_file(&self) -> Option<&TimeSeries> {
        if let Self::File(table) = self { Some(table) } else { None }
    }

    /// The same, to be filled.
    pub(super) fn in_file_mut(&mut self) -> Option<&mut TimeSeries> {
        if let Self::File(table) = self { Some(table) } else { None }
    }
}

shaped!(@ Q; Course<Q> as Either<Q, CourseTable<Q>>);

impl<'de, Q: Deserialize<'de>> Deserialize<'de> for Course<Q> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct CourseVisitor<Q>(PhantomData<Q>);
        impl<'de, Q: Deserialize<'de>> Visitor<'de> for CourseVisitor<Q> {
            type Value = Course<Q>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(
                    "a course: a number in SI, a text with a unit, { table = [[time, value], ..] }, \
                     { table = { file = .., column = .. } } or \
                     { mean = .., amplitude = .., period = .. }",
                )
            }

            fn visit_f64<E: de::Error>(self, value: f64) -> Result<Course<Q>, E> {
                Q::deserialize(value.into_deserializer()).map(Course::Constant)
            }

            fn visit_i64<E: de::Error>(self, value: i64) -> Result<Course<Q>, E> {
                Q::deserialize(value.into_deserializer()).map(Course::Constant)
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<Course<Q>, E> {
                Q::deserialize(text.into_deserializer()).map(Course::Constant)
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Course<Q>, A::Error> {
                CourseTable::deserialize(MapAccessDeserializer::new(map))?.course()
            }
        }
        deserializer.deserialize_any(CourseVisitor(PhantomData))
    }
}
