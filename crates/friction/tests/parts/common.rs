//! Values and orders shared by the tests of parts.

use asperity_friction::evolution::flash::Weakening;

pub const V_REF: f64 = 1e-6;
pub const LENGTH: f64 = 1e-5;
pub const B: f64 = 0.015;

/// Weakening from 0.6 to 0.2 above 0.1 m/s, with a direct effect of `a`.
pub fn weakening(a: f64) -> Weakening {
    Weakening { mu0: 0.6, a, b: B, v_ref: V_REF, mu_w: 0.2, v_w: 0.1 }
}

/// True if the remainder f(h) - f(0) - h f' vanishes at second order or faster, down to `rounding`; the second result is true
/// if it was large enough to show an order.
pub fn taylor(f: impl Fn(f64) -> f64, derivative: f64, h: f64, rounding: f64) -> (bool, bool) {
    let remainder = |h: f64| (f(h) - f(0.0) - h * derivative).abs();
    let (coarse, fine) = (remainder(h), remainder(0.5 * h));
    let shows = fine > 30.0 * rounding;
    ((!shows && coarse < 1000.0 * rounding) || (coarse / fine).log2() > 1.7, shows)
}

/// Counts Taylor tests that showed an order, and fails at the first wrong one.
#[derive(Default)]
pub struct Tally {
    all: usize,
    pub shown: usize,
}

impl Tally {
    pub fn add(&mut self, (holds, shows): (bool, bool), what: impl FnOnce() -> String) {
        assert!(holds, "{}", what());
        self.all += 1;
        self.shown += usize::from(shows);
    }

    /// Asserts that at least this fraction of the tests showed an order.
    pub fn told(&self, share: f64) {
        assert!(self.shown as f64 >= share * self.all as f64, "{} of {}", self.shown, self.all);
    }
}

pub fn rates() -> impl Iterator<Item = f64> {
    (-60..=8).map(|n| 10f64.powf(0.5 * f64::from(n)))
}
