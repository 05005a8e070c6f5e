//! Isotropic work hardening: the yield stress Y \[Pa\] as a function of the equivalent plastic strain e_p \[-\].
//!
//! Softening is refused: without a length scale, the width of a softening band would be that of an element.

use crate::error::FemError;

/// Y(e_p), never decreasing.
#[derive(Clone, Debug, PartialEq)]
pub struct Hardening(Form);

#[derive(Clone, Debug, PartialEq)]
enum Form {
    Linear { initial: f64, modulus: f64 },
    Swift { initial: f64, strain: f64, exponent: f64 },
    Table { strains: Vec<f64>, stresses: Vec<f64> },
}

/// Yield stress and its slope at one plastic strain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Yield {
    /// Y \[Pa\].
    pub stress: f64,
    /// dY/de_p \[Pa\], from the right at the kinks of a table.
    pub slope: f64,
}

impl Hardening {
    /// Perfect plasticity: Y constant, 0 < Y.
    ///
    /// # Errors
    /// [`FemError::Material`] outside the range.
    pub fn perfect(initial: f64) -> Result<Self, FemError> {
        Self::linear(initial, 0.0)
    }

    /// Y = Y0 + H e_p, 0 < Y0, 0 <= H.
    ///
    /// # Errors
    /// [`FemError::Material`] outside the range.
    pub fn linear(initial: f64, modulus: f64) -> Result<Self, FemError> {
        positive("yield stress", initial, "0 < Y, finite")?;
        admit(
            modulus >= 0.0,
            "hardening modulus",
            modulus,
            "0 <= H, finite (softening has no length scale)",
        )?;
        Ok(Self(Form::Linear { initial, modulus }))
    }

    /// Swift's power law Y = Y0 (1 + e_p/e_0)^n, that is K (e_0 + e_p)^n with Y0 = K e_0^n; 0 < Y0, 0 < e_0, 0 <= n <= 1.
    /// Unlike Ludwik's Y0 + K e_p^n its slope is finite at e_p = 0.
    ///
    /// # Errors
    /// [`FemError::Material`] outside the range.
    pub fn swift(initial: f64, strain: f64, exponent: f64) -> Result<Self, FemError> {
        positive("yield stress", initial, "0 < Y, finite")?;
        positive("reference plastic strain", strain, "0 < e_0, finite")?;
        admit((0.0..=1.0).contains(&exponent), "hardening exponent", exponent, "0 <= n <= 1")?;
        Ok(Self(Form::Swift { initial, strain, exponent }))
    }

    /// Piecewise linear through (e_p, Y), constant after the last entry. The first plastic strain is 0, strains ascend,
    /// stresses are positive and do not decrease.
    ///
    /// # Errors
    /// [`FemError::Material`] with the first entry that violates one of these.
    pub fn table(entries: &[[f64; 2]]) -> Result<Self, FemError> {
        let Some(&[first, stress]) = entries.first() else {
            return Err(FemError::Material {
                name: "entries of the hardening table",
                value: 0.0,
                admissible: "at least one (plastic strain, yield stress)",
            });
        };
        admit(first == 0.0, "first plastic strain of the hardening table", first, "0")?;
        positive("yield stress", stress, "0 < Y, finite")?;
        for pair in entries.windows(2) {
            let ([e0, y0], [e1, y1]) = (pair[0], pair[1]);
            admit(e1 > e0, "plastic strain of the hardening table", e1, "finite and above the one before")?;
            admit(
                y1 >= y0,
                "yield stress of the hardening table",
                y1,
                "finite and not below the one before",
            )?;
        }
        let (strains, stresses) = entries.iter().map(|&[strain, stress]| (strain, stress)).unzip();
        Ok(Self(Form::Table { strains, stresses }))
    }

    /// Plastic work per volume up to `plastic` >= 0, the integral of Y \[J/m³\].
    #[must_use]
    pub fn work(&self, plastic: f64) -> f64 {
        match &self.0 {
            Form::Linear { initial, modulus } => (initial + 0.5 * modulus * plastic) * plastic,
            Form::Swift { initial, strain, exponent } => {
                // ∫ (1 + e/e_0)^n de = e_0 [(1 + e/e_0)^(n+1) - 1]/(n + 1).
                let power = exponent + 1.0;
                initial * strain * (power * (plastic / strain).ln_1p()).exp_m1() / power
            }
            Form::Table { strains, stresses } => {
                let ends = strains[1..].iter().copied().chain([f64::INFINITY]).map(|end| end.min(plastic));
                let pieces =
                    strains.iter().zip(stresses).zip(ends).filter(|((start, _), _)| **start < plastic);
                pieces.map(|((start, y), end)| 0.5 * (y + self.at(end).stress) * (end - start)).sum()
            }
        }
    }

    /// Yield stress and slope at `plastic` >= 0.
    #[must_use]
    pub fn at(&self, plastic: f64) -> Yield {
        match &self.0 {
            Form::Linear { initial, modulus } => {
                Yield { stress: initial + modulus * plastic, slope: *modulus }
            }
            Form::Swift { initial, strain, exponent } => {
                // ln_1p retains digits where e_p is far below e_0.
                let stress = initial * (exponent * (plastic / strain).ln_1p()).exp();
                Yield { stress, slope: exponent * stress / (strain + plastic) }
            }
            Form::Table { strains, stresses } => {
                let k = strains.partition_point(|&e| e <= plastic).max(1);
                if k == strains.len() {
                    return Yield { stress: stresses[k - 1], slope: 0.0 };
                }
                let slope = (stresses[k] - stresses[k - 1]) / (strains[k] - strains[k - 1]);
                Yield { stress: stresses[k - 1] + slope * (plastic - strains[k - 1]), slope }
            }
        }
    }
}

fn admit(condition: bool, name: &'static str, value: f64, admissible: &'static str) -> Result<(), FemError> {
    if condition && value.is_finite() { Ok(()) } else { Err(FemError::Material { name, value, admissible }) }
}

fn positive(name: &'static str, value: f64, admissible: &'static str) -> Result<(), FemError> {
    admit(value > 0.0, name, value, admissible)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_are_the_derivatives_of_yield_stresses() {
        let table = Hardening::table(&[[0.0, 2.0], [0.1, 3.0], [0.3, 3.5]]).unwrap();
        let forms = [
            Hardening::perfect(2.0).unwrap(),
            Hardening::linear(2.0, 7.0).unwrap(),
            Hardening::swift(2.0, 0.01, 0.3).unwrap(),
            table,
        ];
        for form in &forms {
            for e in [0.0, 0.02, 0.15, 0.7] {
                let h = 1e-5 * (e + 0.01);
                let at = form.at(e);
                let remainder = |h: f64| (form.at(e + h).stress - at.stress - h * at.slope).abs();
                let (coarse, fine) = (remainder(h), remainder(0.5 * h));
                assert!(coarse < 1e-14 || coarse / fine > 3.5, "{form:?} at {e}: {coarse:e} {fine:e}");
            }
        }
    }

    #[test]
    fn plastic_work_is_the_integral_of_the_yield_stress() {
        let table = Hardening::table(&[[0.0, 2.0], [0.1, 3.0], [0.3, 3.5]]).unwrap();
        let forms = [Hardening::linear(2.0, 7.0).unwrap(), Hardening::swift(2.0, 0.01, 0.3).unwrap(), table];
        for form in &forms {
            assert_eq!(form.work(0.0), 0.0);
            for e in [0.02, 0.15, 0.7] {
                let h = 1e-4 * e;
                let slope = (form.work(e + h) - form.work(e - h)) / (2.0 * h);
                approx::assert_relative_eq!(slope, form.at(e).stress, max_relative = 1e-6);
            }
        }
    }

    #[test]
    fn a_table_is_exact_at_its_entries_and_constant_beyond() {
        let table = Hardening::table(&[[0.0, 2.0], [0.1, 3.0], [0.3, 3.5]]).unwrap();
        for (e, y) in [(0.0, 2.0), (0.05, 2.5), (0.1, 3.0), (0.2, 3.25), (0.3, 3.5), (9.0, 3.5)] {
            approx::assert_relative_eq!(table.at(e).stress, y, max_relative = 1e-15);
        }
        assert_eq!(Hardening::table(&[[0.0, 2.0]]).unwrap().at(1.0), Yield { stress: 2.0, slope: 0.0 });
    }

    #[test]
    fn swift_is_the_power_of_its_shifted_strain() {
        let (k, e0, n) = (530.0, 0.004, 0.21);
        let form = Hardening::swift(k * f64::powf(e0, n), e0, n).unwrap();
        for e in [0.0, 1e-6, 0.01, 0.4] {
            approx::assert_relative_eq!(form.at(e).stress, k * (e0 + e).powf(n), max_relative = 1e-14);
        }
    }

    #[test]
    fn inadmissible_values_are_named_with_their_range() {
        let refused = |r: Result<Hardening, FemError>, words: &str| {
            let text = r.unwrap_err().to_string();
            assert!(text.contains(words), "{text}");
        };
        refused(Hardening::perfect(0.0), "0 < Y");
        refused(Hardening::linear(1.0, -0.1), "0 <= H");
        refused(Hardening::linear(1.0, f64::NAN), "0 <= H");
        refused(Hardening::swift(1.0, 0.0, 0.2), "0 < e_0");
        refused(Hardening::swift(1.0, 0.1, 1.2), "0 <= n <= 1");
        refused(Hardening::table(&[]), "at least one");
        refused(Hardening::table(&[[0.1, 1.0]]), "first plastic strain");
        refused(Hardening::table(&[[0.0, 1.0], [0.0, 2.0]]), "above the one before");
        refused(Hardening::table(&[[0.0, 1.0], [0.1, 0.9]]), "not below the one before");
    }
}
