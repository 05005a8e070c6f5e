//! Limits of values on successively halved meshes, with their uncertainty.

use super::rounding::digits;
use asperity_reference::benchmark::Place;

/// Largest ratio of successive differences that is extrapolated, order 0.4. Extrapolation of slower sequences amplifies errors of
/// other orders.
const SLOWEST: f64 = 0.75;

/// Fraction of the tolerance below which an uncertainty does not matter.
const FINE: f64 = 1e-4;
/// Units of the last digit by which rounding may raise a number above a round one.
const ROUNDING: f64 = 1e-6;
/// Smallest ratio of tolerance to uncertainty.
const SAFE: f64 = 3.0;

/// Smallest uncertainty of points on a curve over the largest one: where errors change sign, a small correction is not significant.
const ALONG: f64 = 0.1;

/// Reference values along a curve, from coordinates and limits.
pub fn places(limits: &[(f64, Limit)], tolerance: f64) -> Vec<Place> {
    let floor = ALONG * limits.iter().map(|(_, limit)| limit.uncertainty).fold(0.0, f64::max);
    let place = |(at, limit): &(f64, Limit)| {
        Limit { uncertainty: limit.uncertainty.max(floor), ..*limit }.place(Some(*at), tolerance)
    };
    limits.iter().map(place).collect()
}

/// A limit and its uncertainty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// Estimate for zero cell size.
    pub value: f64,
    /// Uncertainty.
    pub uncertainty: f64,
}

/// Richardson extrapolation of three values with their observed order; `None` if their differences do not decrease fast enough.
fn extrapolated(values: &[f64]) -> Option<f64> {
    let [a, b, c] = values else { return None };
    let ratio = (c - b) / (b - a);
    (ratio > 0.0 && ratio < SLOWEST).then(|| c + (c - b) * ratio / (1.0 - ratio))
}

impl Limit {
    /// Limit of at least three values, the finest last.
    ///
    /// The uncertainty of an extrapolation is the size of its correction or, if larger, its change from the extrapolation one
    /// mesh coarser. Values with a decreasing oscillation have their limit between the last two; the uncertainty is twice their
    /// difference. For other values it is the larger of the last two differences.
    pub fn from_values(values: &[f64]) -> Self {
        let n = values.len();
        let last = values[n - 1];
        let Some(value) = extrapolated(&values[n - 3..]) else {
            let (late, early) = (last - values[n - 2], values[n - 2] - values[n - 3]);
            let swings = late * early < 0.0 && late.abs() < 0.5 * early.abs();
            let uncertainty = if swings { 2.0 * late.abs() } else { late.abs().max(early.abs()) };
            return Self { value: last, uncertainty };
        };
        let before = (n > 3).then(|| extrapolated(&values[n - 4..n - 1])).flatten();
        let change = before.map_or(0.0, |before| (value - before).abs());
        Self { value, uncertainty: change.max((value - last).abs()) }
    }

    /// The limit, with an uncertainty not below its difference from the limit of another method.
    pub fn beside(self, other: Self) -> Self {
        Self { uncertainty: self.uncertainty.max((self.value - other.value).abs()), ..self }
    }

    /// Reference value: the uncertainty is rounded up to two digits, the value to one digit more.
    ///
    /// An uncertainty below [`FINE`] of the tolerance is raised to this value, where it does not matter. A tolerance below
    /// [`SAFE`] uncertainties is raised to them, since the reference allows no closer comparison.
    pub fn place(self, at: Option<f64>, tolerance: f64) -> Place {
        let floor = self.uncertainty.max(FINE * tolerance);
        let unit = 10f64.powf(floor.log10().floor() - 1.0);
        let uncertainty = digits((floor / unit - ROUNDING).ceil() * unit, 2);
        let fine = unit / 10.0;
        // Adding zero turns -0 into 0.
        let value = digits((self.value / fine).round() * fine, 12) + 0.0;
        Place { at, value, uncertainty, tolerance: tolerance.max(digits(SAFE * uncertainty, 2)) }
    }
}
