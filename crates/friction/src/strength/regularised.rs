//! μ = a asinh[V/(2 Vref) exp((μ0 + φ)/a)], the regularised form (Rice & Ben-Zion 1996): odd in V, zero at rest, and equal to
//! the bare logarithm to e^(-2μ/a) elsewhere.

use super::{Form, Parameters, Sine, SlipRate, Strength};
use std::f64::consts::LN_2;

/// Above this ln x, asinh x = ln 2x to rounding: the next term, 1/(4x²), is below 1e-17. Above this m, 2 sinh m = e^m.
const LARGE: f64 = 20.0;

/// Below this m, sinh is taken from the standard library, since e^m - e^(-m) loses digits.
const SMALL: f64 = 1.0;

/// See the module.
#[derive(Clone, Debug, PartialEq)]
pub struct Regularised(pub Parameters);

impl Regularised {
    /// ln of x/V, x = V/(2 Vref) exp((μ0 + φ)/a).
    #[inline]
    fn log_factor(&self, phi: f64) -> f64 {
        let p = &self.0;
        (p.mu0 + phi) / p.a - (LN_2 + p.log_v_ref)
    }
}

impl Form for Regularised {
    fn at(&self, log_rate: f64, phi: f64) -> Strength {
        let a = self.0.a;
        let log_x = log_rate + self.log_factor(phi);
        if log_x > LARGE {
            return Strength { mu: a * (log_x + LN_2), d_log_rate: a, d_phi: 1.0, curvature: 0.0 };
        }
        let x = log_x.exp();
        let root = x.hypot(1.0);
        let slope = x / root;
        // dS/dln x = S (1 - S²) with 1 - S² = 1/(1 + x²).
        Strength {
            mu: a * x.asinh(),
            d_log_rate: a * slope,
            d_phi: slope,
            curvature: a * slope / (root * root),
        }
    }

    #[inline]
    fn logarithm(&self, phi: f64) -> Option<(f64, f64)> {
        Some((self.log_factor(phi) + LN_2, LARGE + LN_2))
    }

    fn sine(&self) -> Option<Sine> {
        Some(Sine { offset: self.log_factor(0.0) + LN_2, from: LARGE, least: SMALL })
    }

    fn log_rate(&self, mu: f64, phi: f64) -> f64 {
        let p = &self.0;
        let y = mu / p.a;
        // ln sinh y = y - ln 2 + ln(1 - e^(-2y)), without overflow or cancellation.
        p.log_v_ref + (mu - p.mu0 - phi) / p.a + (-(-2.0 * y).exp_m1()).ln()
    }

    #[inline]
    fn slip_rate(&self, m: f64, phi: f64) -> SlipRate {
        let per = -1.0 / self.0.a;
        // V = 2 Vref e^(-(μ0+φ)/a) sinh m, with the two exponents added before either can overflow.
        let size = m.abs();
        let log_factor = self.log_factor(phi);
        let (log, speed, d_m) = if size > LARGE {
            let log = size - LN_2 - log_factor;
            let speed = log.exp();
            (log, speed, speed)
        } else if size > SMALL {
            let share = -(-2.0 * size).exp_m1();
            let log = size - LN_2 - log_factor + share.ln();
            let speed = log.exp();
            (log, speed, (2.0 - share) / share * speed)
        } else {
            let (sinh, factor) = (size.sinh(), (-log_factor).exp());
            (sinh.ln() - log_factor, sinh * factor, size.cosh() * factor)
        };
        let rate = speed.copysign(m);
        SlipRate {
            rate,
            log,
            d_m,
            d_phi: per * rate,
            d_mm: rate,
            d_m_phi: per * d_m,
            d_phi_phi: per * per * rate,
        }
    }

    fn d_rate(&self, log_rate: f64, phi: f64) -> f64 {
        let factor = self.log_factor(phi);
        let log_x = log_rate + factor;
        // a (x/V)/√(1 + x²): at large x, the factor alone may overflow where the quotient a/V does not.
        if log_x > LARGE {
            self.0.a * (-log_rate).exp()
        } else {
            self.0.a * factor.exp() / log_x.exp().hypot(1.0)
        }
    }

    #[inline]
    fn scale(&self) -> f64 {
        self.0.a
    }

    fn direct_effect(&self, _log_rate: f64) -> f64 {
        self.0.a
    }

    fn rest_slope(&self, phi: f64) -> Option<f64> {
        Some(self.0.a * self.log_factor(phi).exp())
    }
}
