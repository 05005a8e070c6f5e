//! μ = μ0 + φ - a ln(1 + V1/V), with a cut-off rate V1 above which the direct effect saturates (Okubo 1989). The matching
//! evolution is the ageing law with a cut-off, φ = b ln(1 + V2 θ/L). Like the bare logarithm, it has no value at rest.

use super::{Form, Parameters, SlipRate, Strength};

/// See the module. The reference rate of the parameters is not used.
#[derive(Clone, Debug, PartialEq)]
pub struct CutOff {
    p: Parameters,
    log_v_cut: f64,
}

impl CutOff {
    /// Strength with the parameters and V1 > 0 \[m/s\].
    ///
    /// # Errors
    /// [`crate::Failure::Parameter`].
    pub fn new(p: Parameters, v_cut: f64) -> Result<Self, crate::Failure> {
        Ok(Self { p, log_v_cut: crate::positive("v_cut", v_cut)?.ln() })
    }
}

/// ln(1 + e^y).
fn soft_plus(y: f64) -> f64 {
    if y > 0.0 { y + (-y).exp().ln_1p() } else { y.exp().ln_1p() }
}

impl Form for CutOff {
    fn at(&self, log_rate: f64, phi: f64) -> Strength {
        let y = self.log_v_cut - log_rate;
        // V1/(V + V1).
        let share = 1.0 / (1.0 + (-y).exp());
        Strength {
            mu: self.p.mu0 + phi - self.p.a * soft_plus(y),
            d_log_rate: self.p.a * share,
            d_phi: 1.0,
            curvature: -self.p.a * share * (1.0 - share),
        }
    }

    fn log_rate(&self, mu: f64, phi: f64) -> f64 {
        // V1/V = e^w - 1; no rate has a strength of μ0 + φ.
        let w = (self.p.mu0 + phi - mu) / self.p.a;
        if w > 0.0 { self.log_v_cut - w - (-(-w).exp_m1()).ln() } else { f64::INFINITY }
    }

    fn slip_rate(&self, m: f64, phi: f64) -> SlipRate {
        let (a, w) = (self.p.a, (self.p.mu0 + phi) / self.p.a - m);
        let within = if w > 0.0 { self.log_v_cut - w - (-(-w).exp_m1()).ln() } else { f64::INFINITY };
        let log = if m > 0.0 { within } else { f64::NAN };
        let (rate, per) = (log.exp(), -1.0 / a);
        // dV/dw = -V r with r = e^w/(e^w - 1), dr/dw = r (1 - r).
        let r = -1.0 / (-w).exp_m1();
        let (first, second) = (rate * r, rate * r * (2.0 * r - 1.0));
        SlipRate {
            rate,
            log,
            d_m: first,
            d_phi: per * first,
            d_mm: second,
            d_m_phi: per * second,
            d_phi_phi: per * per * second,
        }
    }

    fn scale(&self) -> f64 {
        self.p.a
    }

    fn direct_effect(&self, log_rate: f64) -> f64 {
        self.p.a / (1.0 + (log_rate - self.log_v_cut).exp())
    }

    fn rest_slope(&self, _phi: f64) -> Option<f64> {
        None
    }
}
