//! μ = μ0 + φ + a ln(V/Vref), the bare logarithm: the source's form. It has no value at rest.

use super::{Form, Parameters, Strength};

/// See the module.
#[derive(Clone, Debug, PartialEq)]
pub struct Bare(pub Parameters);

impl Form for Bare {
    fn at(&self, log_rate: f64, phi: f64) -> Strength {
        let p = &self.0;
        Strength { mu: p.mu0 + phi + p.a * (log_rate - p.v_ref.ln()), d_log_rate: p.a, d_phi: 1.0 }
    }

    fn log_rate(&self, mu: f64, phi: f64) -> f64 {
        let p = &self.0;
        p.v_ref.ln() + (mu - p.mu0 - phi) / p.a
    }

    fn direct_effect(&self) -> f64 {
        self.0.a
    }

    fn rest_slope(&self, _phi: f64) -> Option<f64> {
        None
    }
}
