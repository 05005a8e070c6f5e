//! Strength forms μ(V, φ): one form per file. All of them work with `ln V`, so that neither 1e-30 m/s nor a = 1e-4
//! overflows.

pub mod bare;
pub mod regularised;

/// Value and derivatives of a strength at a slip rate and state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strength {
    /// μ \[-\].
    pub mu: f64,
    /// ∂μ/∂ln V \[-\].
    pub d_log_rate: f64,
    /// ∂μ/∂φ \[-\].
    pub d_phi: f64,
}

/// A strength form.
pub trait Form: Send + Sync + Clone + std::fmt::Debug {
    /// μ and derivatives at ln V \[ln(m/s)\] and the state contribution φ \[-\].
    fn at(&self, log_rate: f64, phi: f64) -> Strength;

    /// ln V at which the coefficient is `mu` > 0.
    fn log_rate(&self, mu: f64, phi: f64) -> f64;

    /// Whether the form has a value at V = 0 (then μ = 0) and is odd in V.
    fn regular_at_rest(&self) -> bool;
}

/// Parameters both forms share.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// μ0 \[-\].
    pub mu0: f64,
    /// a \[-\].
    pub a: f64,
    /// Vref \[m/s\].
    pub v_ref: f64,
}

impl Parameters {
    /// Checks a > 0, Vref > 0 and that all are finite.
    ///
    /// # Errors
    /// [`crate::Failure::Parameter`].
    pub fn new(mu0: f64, a: f64, v_ref: f64) -> Result<Self, crate::Failure> {
        Ok(Self {
            mu0: crate::finite("mu0", mu0)?,
            a: crate::positive("a", a)?,
            v_ref: crate::positive("v_ref", v_ref)?,
        })
    }
}
