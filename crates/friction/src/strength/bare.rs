//! μ = μ0 + φ + a ln(V/Vref), the bare logarithm: the source's form. It has no value at rest.

use super::{Form, Parameters, SlipRate, Strength};

/// See the module.
#[derive(Clone, Debug, PartialEq)]
pub struct Bare(pub Parameters);

impl Form for Bare {
    fn at(&self, log_rate: f64, phi: f64) -> Strength {
        let p = &self.0;
        let mu = p.mu0 + phi + p.a * (log_rate - p.log_v_ref);
        Strength { mu, d_log_rate: p.a, d_phi: 1.0, curvature: 0.0 }
    }

    fn logarithm(&self, phi: f64) -> Option<(f64, f64)> {
        let p = &self.0;
        // No value at rest.
        Some(((p.mu0 + phi) / p.a - p.log_v_ref, 0.0))
    }

    fn log_rate(&self, mu: f64, phi: f64) -> f64 {
        let p = &self.0;
        p.log_v_ref + (mu - p.mu0 - phi) / p.a
    }

    fn slip_rate(&self, m: f64, phi: f64) -> SlipRate {
        let p = &self.0;
        let log = if m > 0.0 { m - (p.mu0 + phi) / p.a + p.log_v_ref } else { f64::NAN };
        let (rate, per) = (log.exp(), -1.0 / p.a);
        SlipRate {
            rate,
            log,
            d_m: rate,
            d_phi: per * rate,
            d_mm: rate,
            d_m_phi: per * rate,
            d_phi_phi: per * per * rate,
        }
    }

    fn scale(&self) -> f64 {
        self.0.a
    }

    fn direct_effect(&self, _log_rate: f64) -> f64 {
        self.0.a
    }

    fn rest_slope(&self, _phi: f64) -> Option<f64> {
        None
    }
}
