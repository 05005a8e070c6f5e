//! Common parts of the benchmarks.

use super::entry::Entry;
use super::rounding::digits;
use asperity_reference::benchmark::reference::SCHEMA;
use asperity_reference::benchmark::{Along, Place, Quantity, Reference};

/// Licence of the values.
const LICENSE: &str = "CC0-1.0";

/// Megapascals per pascal.
pub const PER_PASCAL: f64 = 1e-6;
/// Metres per micrometre.
pub const MICROMETRE: f64 = 1e-6;

/// A computed benchmark.
pub struct ComputedBenchmark {
    /// Reference values.
    pub reference: Reference,
    /// Results stored with them.
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

/// Description of a quantity.
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
    /// The quantity with a single value.
    pub fn one(self, place: Place) -> Quantity {
        self.quantity(None, vec![place])
    }

    /// The quantity along a coordinate with this meaning and unit.
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

/// The quantity, marked as optional in results.
pub fn optional(quantity: Quantity) -> Quantity {
    Quantity { required: false, ..quantity }
}

/// A value known exactly.
pub fn exact(at: Option<f64>, value: f64, tolerance: f64) -> Place {
    Place { at, value: digits(value, 12), uncertainty: 0.0, tolerance }
}

/// Value at `x` by linear interpolation between points of ascending abscissa.
pub fn interpolated(xs: &[f64], ys: &[f64], x: f64) -> f64 {
    let k = xs.partition_point(|&known| known < x).clamp(1, xs.len() - 1);
    let share = (x - xs[k - 1]) / (xs[k] - xs[k - 1]);
    ys[k - 1] + share * (ys[k] - ys[k - 1])
}
