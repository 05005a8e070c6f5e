//! One side of a body, or several, with their places in the file.

use crate::shape::{Either, shaped};
use crate::spanned::Spanned;
use serde::de::{self, Deserialize, Deserializer, SeqAccess, Visitor};
use std::fmt;
use std::ops::Range;

/// Sides of bodies, `BODY.SIDE`: one, or a list. Empty where the key is not given; a list in a scene has at least one.
#[derive(Clone, Debug, Default)]
pub struct Sides {
    all: Vec<Spanned<String>>,
    span: Range<usize>,
}

impl Sides {
    /// Byte range in the file.
    #[must_use]
    pub fn span(&self) -> Range<usize> {
        self.span.clone()
    }

    /// True where nothing is given.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// Names of the sides.
    pub fn iter(&self) -> impl Iterator<Item = &Spanned<String>> {
        self.all.iter()
    }
}

/// All in quotes: `` `a.top`, `b.top` and `c.top` ``.
impl fmt::Display for Sides {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let quoted: Vec<String> = self.all.iter().map(|side| format!("`{side}`")).collect();
        match &quoted[..] {
            [rest @ .., last] if !rest.is_empty() => write!(f, "{} and {last}", rest.join(", ")),
            few => f.write_str(&few.concat()),
        }
    }
}

shaped!(Sides as Either<String, Vec<String>>);

/// The two forms. The place of a single text is known only to what holds it.
enum Form {
    One(String),
    List(Vec<Spanned<String>>),
}

impl<'de> Deserialize<'de> for Form {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct FormVisitor;
        impl<'de> Visitor<'de> for FormVisitor {
            type Value = Form;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a side such as \"lower.top\", or a list of sides")
            }

            fn visit_str<E: de::Error>(self, side: &str) -> Result<Form, E> {
                Ok(Form::One(side.into()))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut entries: A) -> Result<Form, A::Error> {
                let mut sides = Vec::new();
                while let Some(side) = entries.next_element()? {
                    sides.push(side);
                }
                if sides.is_empty() {
                    Err(de::Error::invalid_length(0, &self))
                } else {
                    Ok(Form::List(sides))
                }
            }
        }
        deserializer.deserialize_any(FormVisitor)
    }
}

impl<'de> Deserialize<'de> for Sides {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let form = Spanned::<Form>::deserialize(deserializer)?;
        let span = form.span();
        let all = match form.into_inner() {
            Form::One(side) => vec![Spanned::new(span.clone(), side)],
            Form::List(sides) => sides,
        };
        Ok(Self { all, span })
    }
}
