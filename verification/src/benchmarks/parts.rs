//! Parts that the benchmarks share.

use super::entry::Entry;
use super::rounded::digits;
use asperity_driver::benchmark::reference::SCHEMA;
use asperity_driver::benchmark::{Along, Place, Quantity, Reference};

/// Licence of the values.
const LICENSE: &str = "CC0-1.0";

/// Pascals in megapascals.
pub const PER_PASCAL: f64 = 1e-6;
/// Metres of a micrometre.
pub const MICROMETRE: f64 = 1e-6;

/// A benchmark as it is made.
pub struct Made {
    /// Reference values.
    pub reference: Reference,
    /// Results that are kept beside them.
    pub entries: Vec<Entry>,
}

/// Reference values of a benchmark, from their quantities.
pub fn reference(benchmark: &str, title: &str, quantities: Vec<Quantity>) -> Reference {
    Reference {
        schema: SCHEMA,
        benchmark: benchmark.into(),
        title: title.into(),
        license: LICENSE.into(),
        quantities,
    }
}

/// A quantity in words.
pub struct Words {
    /// Name.
    pub name: &'static str,
    /// Meaning.
    pub meaning: &'static str,
    /// Unit.
    pub unit: &'static str,
    /// Origin of the values.
    pub source: &'static str,
    /// Reason for the tolerance.
    pub because: &'static str,
}

impl Words {
    /// The quantity with one value.
    pub fn one(self, place: Place) -> Quantity {
        self.quantity(None, vec![place])
    }

    /// The quantity along a coordinate, given in words and unit.
    pub fn along(self, meaning: &str, unit: &str, places: Vec<Place>) -> Quantity {
        let along = Along { meaning: meaning.into(), unit: unit.into() };
        self.quantity(Some(along), places)
    }

    fn quantity(self, along: Option<Along>, places: Vec<Place>) -> Quantity {
        Quantity {
            name: self.name.into(),
            meaning: self.meaning.into(),
            unit: self.unit.into(),
            required: true,
            along,
            source: self.source.into(),
            because: self.because.into(),
            places,
        }
    }
}

/// The quantity, which a result need not have.
pub fn optional(quantity: Quantity) -> Quantity {
    Quantity { required: false, ..quantity }
}

/// A value known exactly.
pub fn exact(at: Option<f64>, value: f64, tolerance: f64) -> Place {
    Place { at, value: digits(value, 12), uncertainty: 0.0, tolerance }
}

/// Value at `x` of a line through points of ascending abscissa, linear between them.
pub fn interpolated(xs: &[f64], ys: &[f64], x: f64) -> f64 {
    let k = xs.partition_point(|&known| known < x).clamp(1, xs.len() - 1);
    let share = (x - xs[k - 1]) / (xs[k] - xs[k - 1]);
    ys[k - 1] + share * (ys[k] - ys[k - 1])
}
