//! Lists of fixed length. Surplus entries are an error; the TOML reader would ignore them.

use crate::spanned::Spanned;
use serde::de::{self, Deserialize, Deserializer, SeqAccess, Visitor};
use std::fmt;
use std::marker::PhantomData;

/// Exactly `N` values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExactList<T, const N: usize>(pub [T; N]);

impl<'de, T: Deserialize<'de>, const N: usize> Deserialize<'de> for ExactList<T, N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct ListVisitor<T, const N: usize>(PhantomData<T>);
        impl<'de, T: Deserialize<'de>, const N: usize> Visitor<'de> for ListVisitor<T, N> {
            type Value = ExactList<T, N>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "an array of length {N}")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut entries: A) -> Result<ExactList<T, N>, A::Error> {
                let mut values = Vec::with_capacity(N);
                while values.len() < N {
                    match entries.next_element()? {
                        Some(value) => values.push(value),
                        None => return Err(de::Error::invalid_length(values.len(), &self)),
                    }
                }
                let length = N + rest(&mut entries)?;
                let all: Result<[T; N], _> = values.try_into();
                match all {
                    Ok(all) if length == N => Ok(ExactList(all)),
                    _ => Err(de::Error::invalid_length(length, &self)),
                }
            }
        }
        deserializer.deserialize_seq(ListVisitor(PhantomData))
    }
}

/// Counts the remaining entries.
fn rest<'de, A: SeqAccess<'de>>(entries: &mut A) -> Result<usize, A::Error> {
    let mut length = 0;
    while entries.next_element::<de::IgnoredAny>()?.is_some() {
        length += 1;
    }
    Ok(length)
}

/// Exactly two values of two kinds.
struct Pair<A, B>(A, B);

impl<'de, A: Deserialize<'de>, B: Deserialize<'de>> Deserialize<'de> for Pair<A, B> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct PairVisitor<A, B>(PhantomData<(A, B)>);
        impl<'de, A: Deserialize<'de>, B: Deserialize<'de>> Visitor<'de> for PairVisitor<A, B> {
            type Value = Pair<A, B>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a tuple of size 2")
            }

            fn visit_seq<S: SeqAccess<'de>>(self, mut entries: S) -> Result<Pair<A, B>, S::Error> {
                let a = entries.next_element()?.ok_or_else(|| de::Error::invalid_length(0, &self))?;
                let b = entries.next_element()?.ok_or_else(|| de::Error::invalid_length(1, &self))?;
                match rest(&mut entries)? {
                    0 => Ok(Pair(a, b)),
                    more => Err(de::Error::invalid_length(2 + more, &self)),
                }
            }
        }
        deserializer.deserialize_seq(PairVisitor(PhantomData))
    }
}

/// Converts a value and keeps its position.
fn at<T, U>(value: Spanned<T>, change: impl FnOnce(T) -> U) -> Spanned<U> {
    Spanned::new(value.span(), change(value.into_inner()))
}

/// Reads a list of `N` values.
pub fn list<'de, D: Deserializer<'de>, T: Deserialize<'de>, const N: usize>(
    from: D,
) -> Result<Spanned<[T; N]>, D::Error> {
    Ok(at(Spanned::<ExactList<T, N>>::deserialize(from)?, |v| v.0))
}

/// Reads an optional list of `N` values.
pub fn optional<'de, D: Deserializer<'de>, T: Deserialize<'de>, const N: usize>(
    from: D,
) -> Result<Option<Spanned<[T; N]>>, D::Error> {
    list(from).map(Some)
}

/// Reads `M` lists of `N` values.
pub fn lists<'de, D: Deserializer<'de>, T: Deserialize<'de>, const N: usize, const M: usize>(
    from: D,
) -> Result<Spanned<[[T; N]; M]>, D::Error> {
    Ok(at(Spanned::<ExactList<ExactList<T, N>, M>>::deserialize(from)?, |v| v.0.map(|x| x.0)))
}

/// Pairs with their position in the file.
type Pairs<A, B> = Spanned<Vec<(A, B)>>;

/// Reads any number of pairs.
pub fn pairs<'de, D: Deserializer<'de>, A: Deserialize<'de>, B: Deserialize<'de>>(
    from: D,
) -> Result<Pairs<A, B>, D::Error> {
    Ok(at(Spanned::<Vec<Pair<A, B>>>::deserialize(from)?, |v| v.into_iter().map(|p| (p.0, p.1)).collect()))
}

/// Reads an optional list of pairs.
pub fn optional_pairs<'de, D: Deserializer<'de>, A: Deserialize<'de>, B: Deserialize<'de>>(
    from: D,
) -> Result<Option<Pairs<A, B>>, D::Error> {
    pairs(from).map(Some)
}
