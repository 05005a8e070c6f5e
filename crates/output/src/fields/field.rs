//! Fields: arrays of files for ParaView, with name, unit, sign and meaning, and their values.

use super::vtu::{Array, Values};
use crate::tables::Sign;
use crate::tables::describe::Row;
use std::borrow::Cow;

/// Shape of the values of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A number.
    Scalar,
    /// A vector in space.
    Vector,
    /// A symmetric tensor, in VTK's order xx, yy, zz, xy, yz, xz.
    Tensor,
}

impl Shape {
    /// Number of components.
    #[must_use]
    pub fn components(self) -> usize {
        match self {
            Self::Scalar => 1,
            Self::Vector => 3,
            Self::Tensor => 6,
        }
    }
}

/// A field at the points or in the cells of a grid.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// Name of the array.
    pub name: String,
    /// Unit; empty without one.
    pub unit: &'static str,
    /// Direction of positive values.
    pub sign: Sign,
    /// Meaning.
    pub meaning: &'static str,
    /// Shape of its values.
    pub shape: Shape,
    /// True if each cell has a value, and not each point.
    pub by_cell: bool,
}

impl Field {
    /// A field of numbers at points.
    #[must_use]
    pub fn scalar(name: impl Into<String>, unit: &'static str, sign: Sign, meaning: &'static str) -> Self {
        Self { name: name.into(), unit, sign, meaning, shape: Shape::Scalar, by_cell: false }
    }

    /// A field of vectors at points.
    #[must_use]
    pub fn vector(name: impl Into<String>, unit: &'static str, sign: Sign, meaning: &'static str) -> Self {
        Self { shape: Shape::Vector, ..Self::scalar(name, unit, sign, meaning) }
    }

    /// A field of tensors at points.
    #[must_use]
    pub fn tensor(name: impl Into<String>, unit: &'static str, sign: Sign, meaning: &'static str) -> Self {
        Self { shape: Shape::Tensor, ..Self::scalar(name, unit, sign, meaning) }
    }

    /// The field with a value in each cell.
    #[must_use]
    pub fn in_cells(self) -> Self {
        Self { by_cell: true, ..self }
    }

    /// The array of these values, which have the shape of the field.
    pub(super) fn array(&self, data: &Data<'_>) -> Array<'_> {
        debug_assert_eq!(self.shape, data.shape(), "{}", self.name);
        match data {
            Data::Numbers(values) => Array::scalar(&self.name, Values::F64(values)),
            Data::Integers(values) => Array::scalar(&self.name, Values::I64(values)),
            Data::Bytes(values) => Array::scalar(&self.name, Values::U8(values)),
            Data::Vectors(values) => Array::vector(&self.name, values),
            Data::Tensors(values) => Array::tensor(&self.name, values),
        }
    }
}

impl Row for Field {
    const HEAD: &'static str = "array | unit | sign | meaning | components | at";
    const TOGETHER: bool = false;

    fn row(&self) -> String {
        let Self { name, unit, sign, meaning, shape, by_cell } = self;
        let at = if *by_cell { "cells" } else { "points" };
        format!("`{name}` | {unit} | {} | {meaning} | {} | {at}", sign.word(), shape.components())
    }
}

/// Values of a field, one for each point or cell.
#[derive(Clone, Debug)]
pub enum Data<'s> {
    /// Numbers.
    Numbers(Cow<'s, [f64]>),
    /// Whole numbers.
    Integers(Cow<'s, [i64]>),
    /// Small whole numbers.
    Bytes(Cow<'s, [u8]>),
    /// Vectors.
    Vectors(Cow<'s, [[f64; 3]]>),
    /// Tensors.
    Tensors(Cow<'s, [[f64; 6]]>),
}

impl Data<'_> {
    fn shape(&self) -> Shape {
        match self {
            Self::Numbers(_) | Self::Integers(_) | Self::Bytes(_) => Shape::Scalar,
            Self::Vectors(_) => Shape::Vector,
            Self::Tensors(_) => Shape::Tensor,
        }
    }
}

macro_rules! data {
    ($($variant:ident: $of:ty),*) => {$(
        impl From<Vec<$of>> for Data<'_> {
            fn from(values: Vec<$of>) -> Self {
                Self::$variant(Cow::Owned(values))
            }
        }

        impl<'s> From<&'s Vec<$of>> for Data<'s> {
            fn from(values: &'s Vec<$of>) -> Self {
                Self::$variant(Cow::Borrowed(values))
            }
        }
    )*};
}

data!(Numbers: f64, Integers: i64, Bytes: u8, Vectors: [f64; 3], Tensors: [f64; 6]);
