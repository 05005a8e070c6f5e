//! Plots of a result over the reference.

use super::reference::{Quantity, Reference};
use super::submission::Submission;
use asperity_output::figures::{Chart, Measure};

/// Units of quantities and coordinates: the measure of an axis, and the value of the unit in SI.
const UNITS: [(&str, Measure, f64); 10] = [
    ("s", Measure::Time, 1.0),
    ("yr", Measure::Time, 31_557_600.0),
    ("m", Measure::Length, 1.0),
    ("um", Measure::Length, 1e-6),
    ("mm", Measure::Length, 1e-3),
    ("km", Measure::Length, 1e3),
    ("m/s", Measure::Velocity, 1.0),
    ("Pa", Measure::Stress, 1.0),
    ("MPa", Measure::Stress, 1e6),
    ("1", Measure::Number, 1.0),
];

/// Charts of all quantities along a coordinate of which a value is given.
#[must_use]
pub fn charts(reference: &'static Reference, result: &Submission) -> Vec<Chart> {
    reference.quantities.iter().filter_map(|quantity| chart(reference, quantity, result)).collect()
}

fn chart(reference: &'static Reference, quantity: &'static Quantity, result: &Submission) -> Option<Chart> {
    let along = quantity.along.as_ref()?;
    let ((x, x_unit), (y, y_unit)) = (measure(&along.unit), measure(&quantity.unit));
    let line = |value: &dyn Fn(Option<f64>, f64) -> Option<f64>| -> Vec<(f64, f64)> {
        let point = |p: &super::Place| Some((p.at? * x_unit, value(p.at, p.value)? * y_unit));
        quantity.places.iter().filter_map(point).collect()
    };
    let given = line(&|at, _| result.value(quantity, at));
    if given.is_empty() {
        return None;
    }
    Some(Chart {
        file: quantity.name.clone(),
        title: reference.benchmark.clone(),
        x: (along.meaning.clone(), x),
        y: (quantity.meaning.clone(), y),
        curves: vec![("reference".into(), line(&|_, value| Some(value))), ("result".into(), given)],
        pairs: false,
    })
}

fn measure(unit: &str) -> (Measure, f64) {
    UNITS.iter().find(|row| row.0 == unit).map_or((Measure::Number, 1.0), |row| (row.1, row.2))
}
