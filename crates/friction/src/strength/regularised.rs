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
    /// ln of x/V, x = V/(2 Vref) exp((μ0 + φ)/a).
    fn log_factor(&self, phi: f64) -> f64 {
        let p = &self.0;
        (p.mu0 + phi) / p.a - (LN_2 + p.v_ref.ln())
    }
}

impl Form for Regularised {
    fn at(&self, log_rate: f64, phi: f64) -> Strength {
        let a = self.0.a;
        let log_x = log_rate + self.log_factor(phi);
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
        p.v_ref.ln() + (mu - p.mu0 - phi) / p.a + (-(-2.0 * y).exp_m1()).ln()
    }

    fn d_rate(&self, log_rate: f64, phi: f64) -> f64 {
        let factor = self.log_factor(phi);
        let log_x = log_rate + factor;
        // a (x/V)/√(1 + x²): at large x the factor alone may overflow where the quotient a/V does not.
        if log_x > LARGE {
            self.0.a * (-log_rate).exp()
        } else {
            self.0.a * factor.exp() / log_x.exp().hypot(1.0)
        }
    }

    fn direct_effect(&self) -> f64 {
        self.0.a
    }

    fn rest_slope(&self, phi: f64) -> Option<f64> {
        Some(self.0.a * self.log_factor(phi).exp())
    }
}
