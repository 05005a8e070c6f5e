//! `fault-bend/v1`: tractions caused by given slip across a fault bend.

use super::entry::Entry;
use super::independent::Results;
use super::parts::{ComputedBenchmark, PER_PASCAL, Words, interpolated, reference};
use super::rounding::digits;
use crate::CaseError;
use crate::cases::fault_bend;
use asperity_reference::benchmark::{Place, Quantity};

/// Error of scipy's quadrature and of the twelve digits in the file \[MPa\].
const QUADRATURE: f64 = 1e-6;
/// Cell size of this program's entry \[m\].
const SIZE: f64 = 125.0;

pub fn make() -> Result<ComputedBenchmark, CaseError> {
    let rows = Results::read(include_str!("../../independent/bend.json"))?
        .at("distance above the bend [m], shear [Pa], normal [Pa]")?
        .rows()?;
    let column = |j: usize| -> Vec<f64> { rows.iter().map(|row| row[j] * PER_PASCAL).collect() };
    let places: Vec<f64> = rows.iter().map(|row| row[0] * 1e-3).collect();
    let quantity = |name, meaning, values: Vec<f64>, tolerance: f64| -> Quantity {
        let place = |(at, value): (&f64, f64)| Place {
            at: Some(*at),
            value: digits(value, 8),
            uncertainty: QUADRATURE,
            tolerance,
        };
        let source =
            "integrals over edge dislocations in the whole plane, by scipy's quadrature of principal value";
        let because =
            "1 % of the largest value, as cells of 250 m err: they smear the dislocation at the bend";
        Words { name, meaning, unit: "MPa", source, because }.along(
            "Distance above the bend",
            "km",
            places.iter().zip(values).map(place).collect(),
        )
    };
    let quantities = vec![
        quantity("shear", "Change of shear traction", column(1), 0.04),
        quantity("normal", "Change of normal traction, compression positive", column(2), 0.01),
    ];
    let reference =
        reference("fault-bend/v1", "tractions of given slip across a restraining bend", quantities);
    let dislocations = Entry::new(
        "dislocations",
        "bend.py (numpy, scipy)",
        "integrals over edge dislocations in the whole plane",
        "adaptive quadrature, relative error 1e-12",
    )
    .with("shear", column(1))
    .with("normal", column(2));
    Ok(ComputedBenchmark { reference, entries: vec![here(&places)?, dislocations] })
}

fn here(places: &[f64]) -> Result<Entry, CaseError> {
    let found = fault_bend::statics_of(SIZE)?;
    let above: Vec<f64> = found.along.iter().rev().map(|s| (fault_bend::BEND - s) * 1e-3).collect();
    let at = |values: &[f64]| -> Vec<f64> {
        let values: Vec<f64> = values.iter().rev().map(|v| v * PER_PASCAL).collect();
        places.iter().map(|&s| interpolated(&above, &values, s)).collect()
    };
    Ok(Entry::new(
        "asperity",
        concat!("asperity ", env!("CARGO_PKG_VERSION")),
        "finite elements, split nodes, bodies condensed onto the fault",
        "quad4, cells of 125 m, sides 1000 km away",
    )
    .with("shear", at(&found.shear))
    .with("normal", at(&found.normal)))
}
