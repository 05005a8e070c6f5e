//! μ = a asinh[V/(2 Vref) exp((μ0 + φ)/a)], the regularised form (Rice & Ben-Zion 1996): odd in V, zero at rest, and equal to
//! the bare logarithm to e^(-2μ/a) elsewhere.

use super::{Form, Parameters, Strength};
use std::f64::consts::LN_2;

/// Above this ln x, asinh x = ln 2x to rounding: the next term, 1/(4x²), is below 1e-17.
const LARGE: f64 = 20.0;

/// See the module.
#[derive(Clone, Debug, PartialEq)]
pub struct Regularised(pub Parameters);

impl Regularised {
    /// ln x of x = V/(2 Vref) exp((μ0 + φ)/a).
    fn log_argument(&self, log_rate: f64, phi: f64) -> f64 {
        let p = &self.0;
        log_rate - (2.0 * p.v_ref).ln() + (p.mu0 + phi) / p.a
    }
}

impl Form for Regularised {
    fn at(&self, log_rate: f64, phi: f64) -> Strength {
        let a = self.0.a;
        let log_x = self.log_argument(log_rate, phi);
        let (mu, slope) = if log_x > LARGE {
            (a * (log_x + LN_2), 1.0)
        } else {
            let x = log_x.exp();
            (a * x.asinh(), x / x.hypot(1.0))
        };
        Strength { mu, d_log_rate: a * slope, d_phi: slope }
    }

    fn log_rate(&self, mu: f64, phi: f64) -> f64 {
        let p = &self.0;
        let y = mu / p.a;
        // ln sinh y = y - ln 2 + ln(1 - e^(-2y)), which neither overflows nor cancels.
        (2.0 * p.v_ref).ln() - (p.mu0 + phi) / p.a + y - LN_2 + (-(-2.0 * y).exp_m1()).ln()
    }

    fn regular_at_rest(&self) -> bool {
        true
    }
}
