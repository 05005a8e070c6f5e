//! A spring slider that sticks and slips: every method finds the same events.

use super::common::*;
use asperity_ode::{Clock, Method, Problem, integrate};

/// A spring slider without inertia but with radiation damping: y = (ln V/V0, ln theta V0/D), without regularisation; stiffness
/// 0.7 of the critical one, so that it sticks and slips between 1e-13 and 1 m/s. Events: V crosses 1 mm/s.
struct Slider;

impl Slider {
    const A: f64 = 0.010e8;
    const B: f64 = 0.015e8;
    const LENGTH: f64 = 0.01;
    const REFERENCE: f64 = 1e-6;
    const LOAD: f64 = 1e-9;
    const DAMPING: f64 = 5e6;
    const STIFFNESS: f64 = 0.7 * (Self::B - Self::A) / Self::LENGTH;
}

impl Problem for Slider {
    fn size(&self) -> usize {
        2
    }
    fn rates(&self, _: Clock, y: &[f64], dy: &mut [f64]) {
        let v = Self::REFERENCE * y[0].exp();
        let ageing = Self::REFERENCE / Self::LENGTH * (-y[1]).exp() - v / Self::LENGTH;
        dy[1] = ageing;
        dy[0] = (Self::STIFFNESS * (Self::LOAD - v) - Self::B * ageing) / (Self::A + Self::DAMPING * v);
    }
    fn jacobian(&self, at: Clock, y: &[f64], jac: &mut [f64]) {
        let v = Self::REFERENCE * y[0].exp();
        let healing = Self::REFERENCE / Self::LENGTH * (-y[1]).exp();
        let mut dy = [0.0; 2];
        self.rates(at, y, &mut dy);
        let mass = Self::A + Self::DAMPING * v;
        jac[1] = -v / Self::LENGTH;
        jac[3] = -healing;
        jac[0] = (-Self::STIFFNESS * v - Self::B * jac[1] - dy[0] * Self::DAMPING * v) / mass;
        jac[2] = -Self::B * jac[3] / mass;
    }
    fn events(&self) -> usize {
        1
    }
    fn event(&self, _: Clock, y: &[f64], g: &mut [f64]) {
        g[0] = y[0] - 1000.0_f64.ln();
    }
}

#[test]
fn every_method_finds_the_same_earthquakes() {
    let onsets = |method, tolerance| {
        let mut record = Record::new();
        let finished =
            integrate(&Slider, START, &[-6.0, 6.0], 1e10, &options(method, tolerance, 2), &mut record);
        completed(&finished);
        let onsets: Vec<Clock> = record.occurrences.iter().filter(|o| o.rising).map(|o| o.at).collect();
        let ends: Vec<Clock> = record.occurrences.iter().filter(|o| !o.rising).map(|o| o.at).collect();
        assert!(
            onsets.len() >= 3 && onsets.len().abs_diff(ends.len()) <= 1,
            "{} {finished:?}",
            method.name()
        );
        (onsets, ends)
    };
    let reference = onsets(Method::Dop853, 1e-12);
    let recurrence = reference.0[2].since(&reference.0[1]);
    let duration = reference.1[2].since(&reference.0[2]);
    for (method, tolerance) in [
        (Method::Tsit5, 1e-9),
        (Method::Tsit45, 1e-9),
        (Method::Dop853, 1e-9),
        (Method::Radau5, 1e-8),
        (Method::Bdf, 1e-8),
        (Method::Esdirk34, 1e-8),
        (Method::TrBdf2, 1e-6),
    ] {
        let (starts, ends) = onsets(method, tolerance);
        let error = (starts[2].since(&starts[1]) / recurrence - 1.0).abs();
        let shape = (ends[2].since(&starts[2]) / duration - 1.0).abs();
        assert!(error < 1e3 * tolerance, "{}: recurrence {error:e}", method.name());
        assert!(shape < 1e4 * tolerance, "{}: duration {shape:e}", method.name());
    }
}
