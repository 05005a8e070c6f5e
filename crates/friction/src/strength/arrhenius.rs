//! Effect of temperature by an Arrhenius factor of the slip rate (Chester 1994). The strength is that of a form at `V
//! exp[(Q/R)(1/T - 1/T_ref)]`, so that a logarithmic direct effect gains `a (Q/R)(1/T - 1/T_ref)`.

use super::{Form, SlipRate, Strength};

/// Molar gas constant R \[J/(mol K)\], exact in the SI since 2019.
pub const GAS_CONSTANT: f64 = 8.314_462_618_153_24;

/// See the module.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrhenius<F> {
    form: F,
    /// Q/R \[K\].
    activation: f64,
    reference: f64,
    temperature: f64,
    /// (Q/R)(1/T - 1/T_ref).
    shift: f64,
}

impl<F: Form> Arrhenius<F> {
    /// Strength with a form, Q ≥ 0 \[J/mol\], and T_ref, T > 0 \[K\].
    ///
    /// # Errors
    /// [`crate::Failure::Parameter`].
    pub fn new(form: F, activation: f64, reference: f64, temperature: f64) -> Result<Self, crate::Failure> {
        if !(activation >= 0.0 && activation.is_finite()) {
            let admissible = "0 <= activation energy, finite";
            return Err(crate::Failure::Parameter { name: "activation", value: activation, admissible });
        }
        let reference = crate::positive("t_ref", reference)?;
        let temperature = crate::positive("temperature", temperature)?;
        let activation = activation / GAS_CONSTANT;
        let mut law = Self { form, activation, reference, temperature, shift: 0.0 };
        law.warm(temperature);
        Ok(law)
    }
}

impl<F: Form> Form for Arrhenius<F> {
    fn at(&self, log_rate: f64, phi: f64) -> Strength {
        self.form.at(log_rate + self.shift, phi)
    }

    fn d_rate(&self, log_rate: f64, phi: f64) -> f64 {
        self.form.d_rate(log_rate + self.shift, phi) * self.shift.exp()
    }

    fn d_temperature(&self, log_rate: f64, phi: f64) -> f64 {
        -self.activation / (self.temperature * self.temperature) * self.at(log_rate, phi).d_log_rate
    }

    fn warms(&self) -> bool {
        self.activation > 0.0
    }

    fn warm(&mut self, temperature: f64) {
        self.temperature = temperature;
        // 1/T - 1/T_ref without subtracting nearly equal numbers.
        self.shift = self.activation * (self.reference - temperature) / (self.reference * temperature);
    }

    fn log_rate_by_temperature(&self) -> f64 {
        self.activation / (self.temperature * self.temperature)
    }

    fn log_rate(&self, mu: f64, phi: f64) -> f64 {
        self.form.log_rate(mu, phi) - self.shift
    }

    fn slip_rate(&self, m: f64, phi: f64) -> SlipRate {
        let (s, factor) = (self.form.slip_rate(m, phi), (-self.shift).exp());
        SlipRate {
            rate: s.rate * factor,
            log: s.log - self.shift,
            d_m: s.d_m * factor,
            d_phi: s.d_phi * factor,
            d_mm: s.d_mm * factor,
            d_m_phi: s.d_m_phi * factor,
            d_phi_phi: s.d_phi_phi * factor,
        }
    }

    fn scale(&self) -> f64 {
        self.form.scale()
    }

    fn direct_effect(&self, log_rate: f64) -> f64 {
        self.form.direct_effect(log_rate + self.shift)
    }

    fn rest_slope(&self, phi: f64) -> Option<f64> {
        Some(self.form.rest_slope(phi)? * self.shift.exp())
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::{Arrhenius, Form};
    use crate::strength::Parameters;
    use crate::strength::regularised::Regularised;

    fn law(temperature: f64) -> Arrhenius<Regularised> {
        let form = Regularised(Parameters::new(0.6, 0.01, 1e-6).unwrap());
        Arrhenius::new(form, 1e5, 400.0, temperature).unwrap()
    }

    #[test]
    fn a_law_that_is_warmed_is_the_law_at_that_temperature() {
        let mut warmed = law(300.0);
        warmed.warm(700.0);
        assert_eq!(warmed, law(700.0));
    }

    #[test]
    fn the_change_with_temperature_is_that_of_the_slip_rate_at_constant_friction() {
        let at = |temperature: f64| law(temperature).slip_rate(55.0, 0.02).log;
        let (temperature, step) = (600.0, 1e-3);
        let slope = (at(temperature + step) - at(temperature - step)) / (2.0 * step);
        let found = law(temperature).log_rate_by_temperature();
        assert!((slope / found - 1.0).abs() < 1e-8, "{slope} {found}");
    }
}
