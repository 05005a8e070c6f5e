//! A single value or a list with one value for each state variable.

use crate::code_value::here;
use crate::shape::{Either, shaped};
use crate::spanned::Spanned;
use serde::de::{Deserialize, Deserializer, Error, IntoDeserializer, SeqAccess, Visitor};
use std::fmt;
use std::marker::PhantomData;

/// Values with their positions. A single value has an empty span, and its position is that of the whole.
#[derive(Clone, Debug)]
pub struct Several<T>(pub Vec<Spanned<T>>);

impl<T> From<T> for Several<T> {
    fn from(value: T) -> Self {
        Self(vec![here(value)])
    }
}

impl<T, const N: usize> From<[T; N]> for Several<T> {
    fn from(values: [T; N]) -> Self {
        Self(values.into_iter().map(here).collect())
    }
}

shaped!(@ T; Several<T> as Either<T, Vec<T>>);

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Several<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(SeveralVisitor(PhantomData))
    }
}

/// Reads lists itself and delegates single values to `T`.
struct SeveralVisitor<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for SeveralVisitor<T> {
    type Value = Several<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value, or a list with one for each state variable")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut entries: A) -> Result<Self::Value, A::Error> {
        let mut values = Vec::new();
        while let Some(value) = entries.next_element()? {
            values.push(value);
        }
        Ok(Several(values))
    }

    fn visit_bool<E: Error>(self, value: bool) -> Result<Self::Value, E> {
        T::deserialize(value.into_deserializer()).map(Several::from)
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Self::Value, E> {
        T::deserialize(value.into_deserializer()).map(Several::from)
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Self::Value, E> {
        T::deserialize(value.into_deserializer()).map(Several::from)
    }

    fn visit_str<E: Error>(self, value: &str) -> Result<Self::Value, E> {
        T::deserialize(value.into_deserializer()).map(Several::from)
    }
}
