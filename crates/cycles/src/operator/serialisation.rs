//! Operators as they are written and read: their kind, then their contents.

use super::{Both, CheckedOperator, Dense, Hierarchical, Operator, Planar, Toeplitz};
use serde::de::Deserializer;
use serde::ser::{Error as _, Serializer};
use serde::{Deserialize, Serialize};
use std::any::Any;

/// An operator that is written.
#[derive(Serialize)]
enum OperatorKind<'a> {
    Dense(&'a Dense),
    Hierarchical(&'a Hierarchical),
    Toeplitz(&'a Toeplitz),
    Both(&'a Both),
    Checked(&'a CheckedOperator),
    Planar(&'a Planar),
}

/// An operator that was read. Its kinds have the order of [`OperatorKind`].
#[derive(Deserialize)]
enum Read {
    Dense(Dense),
    Hierarchical(Hierarchical),
    Toeplitz(Toeplitz),
    Both(Both),
    Checked(CheckedOperator),
    Planar(Planar),
}

impl<'a> OperatorKind<'a> {
    fn from_operator(operator: &'a dyn Operator) -> Option<Self> {
        let any: &dyn Any = operator;
        None.or_else(|| any.downcast_ref().map(Self::Dense))
            .or_else(|| any.downcast_ref().map(Self::Hierarchical))
            .or_else(|| any.downcast_ref().map(Self::Toeplitz))
            .or_else(|| any.downcast_ref().map(Self::Both))
            .or_else(|| any.downcast_ref().map(Self::Checked))
            .or_else(|| any.downcast_ref().map(Self::Planar))
    }
}

impl Serialize for dyn Operator {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let written = OperatorKind::from_operator(self)
            .ok_or_else(|| S::Error::custom("an operator of another kind"))?;
        written.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Box<dyn Operator> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Ok(match Read::deserialize(deserializer)? {
            Read::Dense(operator) => Box::new(operator),
            Read::Hierarchical(operator) => Box::new(operator.restored()),
            Read::Toeplitz(operator) => Box::new(operator),
            Read::Both(operator) => Box::new(operator),
            Read::Checked(operator) => Box::new(operator),
            Read::Planar(operator) => Box::new(operator),
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::operator::{
        Both, CheckedOperator, Dense, Forces, Geometry, Hierarchical, Lattice, Operator, Planar, Toeplitz,
        Tolerance,
    };

    const POINTS: usize = 300;

    /// Tractions of a row of points; normal ones have both signs.
    fn dense(sign: f64) -> Dense {
        let of = |k: usize| ((k / POINTS) as f64, (k % POINTS) as f64);
        let shear = |(i, j): (f64, f64)| sign / (0.3 + (i - j).powi(2));
        let normal = |(i, j): (f64, f64)| (i - j) / (1.0 + (i - j).powi(2)).powi(2);
        let all = || (0..POINTS * POINTS).map(of);
        Dense::new(POINTS, all().map(shear).collect(), Some(all().map(normal).collect()))
    }

    fn compressed(tolerance: Tolerance) -> Hierarchical {
        let places: Vec<[f64; 3]> = (0..POINTS).map(|k| [k as f64, 0.0, 0.0]).collect();
        let (all, areas) = (0..POINTS, vec![1.5; POINTS]);
        let faults = std::slice::from_ref(&all);
        let geometry = Geometry { places: &places, faults, areas: &areas, surfaces: false };
        let dense = dense(1.0);
        let forces = Forces::from_tractions(dense.matrix(), dense.normal_matrix().unwrap(), &areas);
        Hierarchical::from_forces(&forces, &geometry, tolerance)
    }

    fn grid() -> Toeplitz {
        let lattice = Lattice { columns: POINTS / 3, rows: 3, points: (0..POINTS).collect() };
        let count = lattice.distances() * 9;
        let table: Vec<f64> =
            (0..count).map(|k| 1.0 / (1.0 + (k as f64 - 0.4 * count as f64).abs())).collect();
        Toeplitz::new(lattice, &table, Some(&table.iter().map(|v| v * v).collect::<Vec<f64>>()))
    }

    fn planar() -> Planar {
        let lattice = Lattice { columns: POINTS / 3, rows: 3, points: (0..POINTS).collect() };
        Planar::new(lattice, 2, |[c, r]| [1.0, 0.3, 0.7].map(|k| k / (1.0 + (c * c + r * r) as f64)))
    }

    fn both() -> Both {
        let dense = |sign: f64| -> Box<dyn Operator> { Box::new(dense(sign)) };
        Both::new(
            [Box::new(compressed(Tolerance::OfLargest(1e-9))), Box::new(grid())],
            Some([dense(-1.0), dense(0.5)]),
        )
    }

    fn checked() -> CheckedOperator {
        CheckedOperator::new(Box::new(compressed(Tolerance::OfLargest(1e-9))), &|_| {
            [vec![1.0; POINTS], Vec::new(), vec![0.5; POINTS]]
        })
    }

    /// Everything that an operator says of itself.
    fn said(operator: &dyn Operator) -> (Vec<f64>, String) {
        let count = operator.points() * operator.components();
        let slip: Vec<f64> = (0..count).map(|k| ((k * 7919) % 1000) as f64 / 1000.0 - 0.3).collect();
        let (shear, normal) = (operator.shear_of(&slip), operator.normal_of(&slip));
        let all = [&shear, &normal, operator.stiffness().all()].concat();
        let words = operator.words();
        (all, format!("{words} {:?} {} {}", operator.errors(), operator.bytes(), operator.couples_normal()))
    }

    #[test]
    fn an_operator_that_is_read_has_the_bits_of_the_one_that_was_written() {
        let all: [Box<dyn Operator>; 7] = [
            Box::new(dense(1.0)),
            Box::new(compressed(Tolerance::OfLargest(1e-9))),
            // In single precision.
            Box::new(compressed(Tolerance::OfBlock(1e-3))),
            Box::new(grid()),
            Box::new(planar()),
            Box::new(both()),
            Box::new(checked()),
        ];
        for operator in all {
            let bytes = postcard::to_stdvec(&operator).unwrap();
            let read: Box<dyn Operator> = postcard::from_bytes(&bytes).unwrap();
            assert!(said(read.as_ref()) == said(operator.as_ref()), "{}", operator.words());
        }
    }
}
