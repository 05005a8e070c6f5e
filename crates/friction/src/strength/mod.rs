//! Strength forms μ(V, φ): one form per file. All of them work with `ln V`, so that neither 1e-30 m/s nor a = 1e-4
//! overflows.

pub mod arrhenius;
pub mod bare;
pub mod cut_off;
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
    /// ∂²μ/∂(ln V)² \[-\].
    pub curvature: f64,
}

/// The slip rate at which the friction coefficient is `a m`, with its derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlipRate {
    /// V \[m/s\], negative if m is.
    pub rate: f64,
    /// ln |V|.
    pub log: f64,
    /// ∂V/∂m.
    pub d_m: f64,
    /// ∂V/∂φ.
    pub d_phi: f64,
    /// ∂²V/∂m².
    pub d_mm: f64,
    /// ∂²V/∂m∂φ.
    pub d_m_phi: f64,
    /// ∂²V/∂φ².
    pub d_phi_phi: f64,
}

/// `|V| = exp(|m| - F - φ/a) (1 - exp(-2 |m|))`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sine {
    /// F \[-\].
    pub offset: f64,
    /// |m| above which the second factor is 1 to rounding.
    pub from: f64,
    /// |m| above which the second factor loses no digits.
    pub least: f64,
}

/// A strength form.
pub trait Form: Send + Sync + Clone + std::fmt::Debug {
    /// μ and derivatives at ln V \[ln(m/s)\] and the state contribution φ \[-\].
    fn at(&self, log_rate: f64, phi: f64) -> Strength;

    /// ∂μ/∂V \[s/m\] at fixed state; infinite only if it exceeds the range of numbers.
    fn d_rate(&self, log_rate: f64, phi: f64) -> f64 {
        self.at(log_rate, phi).d_log_rate * (-log_rate).exp()
    }

    /// ∂μ/∂T \[1/K\] at fixed V and state.
    fn d_temperature(&self, _log_rate: f64, _phi: f64) -> f64 {
        0.0
    }

    /// True if the strength depends on temperature.
    fn warms(&self) -> bool {
        false
    }

    /// Sets the temperature \[K\].
    fn warm(&mut self, _temperature: f64) {}

    /// ∂ln V/∂T \[1/K\] at fixed friction coefficient and state.
    fn log_rate_by_temperature(&self) -> f64 {
        0.0
    }

    /// ln V at which the coefficient is `mu` > 0.
    fn log_rate(&self, mu: f64, phi: f64) -> f64;

    /// F and m such that `μ = a (ln V + F)` to rounding wherever `μ > a m`, for forms that are logarithms there.
    fn logarithm(&self, _phi: f64) -> Option<(f64, f64)> {
        None
    }

    /// For forms that are hyperbolic sines of m; see [`Sine`].
    fn sine(&self) -> Option<Sine> {
        None
    }

    /// V at which the coefficient is `a m`: of either sign if the form is odd, otherwise not a number at m ≤ 0.
    fn slip_rate(&self, m: f64, phi: f64) -> SlipRate;

    /// a \[-\], the scale of μ over an e-fold of V.
    fn scale(&self) -> f64;

    /// The direct effect \[-\]: the smallest ratio of ∂μ/∂ln V to ∂μ/∂φ over all rates up to ln V.
    fn direct_effect(&self, log_rate: f64) -> f64;

    /// ∂μ/∂V \[s/m\] at V = 0, or `None` if the form has no value there.
    fn rest_slope(&self, phi: f64) -> Option<f64>;

    /// True if the form has a value at V = 0 (then μ = 0) and is odd in V.
    fn regular_at_rest(&self) -> bool {
        self.rest_slope(0.0).is_some()
    }
}

/// Parameters common to all forms. Only [`Parameters::new`] makes them, so that a form never holds a ≤ 0. A law that weakens
/// immediately with the rate is ill-posed (its static problem has no continuous solution), whatever its state does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// μ0 \[-\].
    mu0: f64,
    /// a \[-\].
    a: f64,
    /// Vref \[m/s\].
    v_ref: f64,
    /// ln Vref, needed by every evaluation.
    log_v_ref: f64,
}

impl Parameters {
    /// Checks a > 0, Vref > 0 and that all are finite.
    ///
    /// # Errors
    /// [`crate::Failure::Parameter`].
    pub fn new(mu0: f64, a: f64, v_ref: f64) -> Result<Self, crate::Failure> {
        Ok(Self {
            mu0: crate::finite("mu0", mu0)?,
            a: if a > 0.0 && a.is_finite() {
                a
            } else {
                let admissible =
                    "a positive, finite number: a strength that falls with the rate at once is ill-posed";
                return Err(crate::Failure::Parameter { name: "a", value: a, admissible });
            },
            v_ref: crate::positive("v_ref", v_ref)?,
            log_v_ref: v_ref.ln(),
        })
    }

    /// μ0 \[-\].
    #[must_use]
    pub fn mu0(&self) -> f64 {
        self.mu0
    }

    /// a \[-\].
    #[must_use]
    pub fn a(&self) -> f64 {
        self.a
    }

    /// Vref \[m/s\].
    #[must_use]
    pub fn v_ref(&self) -> f64 {
        self.v_ref
    }
}
