//! Benchmarks that other programs can enter: where their reference values come from, and the entries of this program and of the
//! independent ones.
//!
//! The program `asperity-benchmarks` writes them to `docs/src/benchmarks`. Reference values are closed forms, or limits of the
//! independent programs of `verification/independent`; no value of this program is a reference.

mod bend;
mod block;
mod bp1;
mod contact;
mod entry;
mod independent;
mod limit;
pub mod pages;
mod sandwich;

use crate::CaseError;
use asperity_driver::benchmark::reference::SCHEMA;
use asperity_driver::benchmark::{Along, Place, Quantity, Reference};
pub use entry::Entry;

/// Licence of the values.
const LICENSE: &str = "CC0-1.0";

/// A benchmark as it is made.
pub struct Made {
    /// Reference values.
    pub reference: Reference,
    /// Results that are kept beside them.
    pub entries: Vec<Entry>,
}

/// A benchmark and the function that makes it.
pub struct Maker {
    /// Name with version.
    pub name: &'static str,
    /// Makes it; runs scenes for a minute or so.
    pub make: fn() -> Result<Made, CaseError>,
}

/// All benchmarks.
pub const ALL: &[Maker] = &[
    Maker { name: "sandwich/v1", make: sandwich::make },
    Maker { name: "sandwich-state/v1", make: block::make },
    Maker { name: "fault-bend/v1", make: bend::make },
    Maker { name: "hertz/v1", make: contact::hertz },
    Maker { name: "partial-slip/v1", make: contact::partial_slip },
    Maker { name: "seas-bp1-quick/v1", make: bp1::make },
];

fn reference(benchmark: &str, title: &str, quantities: Vec<Quantity>) -> Reference {
    Reference {
        schema: SCHEMA,
        benchmark: benchmark.into(),
        title: title.into(),
        license: LICENSE.into(),
        quantities,
    }
}

/// A quantity in words.
struct Words {
    name: &'static str,
    meaning: &'static str,
    unit: &'static str,
    source: &'static str,
    because: &'static str,
}

impl Words {
    /// The quantity with one value.
    fn one(self, place: Place) -> Quantity {
        self.quantity(None, vec![place])
    }

    /// The quantity along a coordinate, given in words and unit.
    fn along(self, meaning: &str, unit: &str, places: Vec<Place>) -> Quantity {
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
fn optional(quantity: Quantity) -> Quantity {
    Quantity { required: false, ..quantity }
}

/// A value known exactly.
fn exact(at: Option<f64>, value: f64, tolerance: f64) -> Place {
    Place { at, value: digits(value, 12), uncertainty: 0.0, tolerance }
}

/// Number rounded to significant digits, so that files do not depend on the last bits of a machine.
fn digits(value: f64, n: usize) -> f64 {
    format!("{value:.*e}", n - 1).parse().unwrap_or(value)
}

/// Value at `x` of a line through points of ascending abscissa, linear between them.
fn interpolated(xs: &[f64], ys: &[f64], x: f64) -> f64 {
    let k = xs.partition_point(|&known| known < x).clamp(1, xs.len() - 1);
    let share = (x - xs[k - 1]) / (xs[k] - xs[k - 1]);
    ys[k - 1] + share * (ys[k] - ys[k - 1])
}
