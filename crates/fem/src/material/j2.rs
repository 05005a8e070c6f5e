//! J2 plasticity with isotropic hardening: radial return, its algorithmic tangent, and the continuum tangent.
//!
//! With s the deviator, q = √(3/2 s:s) and the elastic trial stress of a step, plastic flow Δe_p > 0 solves `q_trial - 3 G
//! Δe_p = Y(e_p + Δe_p)`, and s = (1 - 3 G Δe_p/q_trial) s_trial (Simo & Hughes, Computational Inelasticity, sections 3.3 and
//! 3.4). The left side minus the right decreases monotonically, so the root is unique.

use super::constitutive::{
    ConstitutiveLaw, Moduli, Voigt, contract, deviator, elastic_energy, elastic_increment, isotropic,
    pressure,
};
use super::elastic::Elastic;
use super::hardening::Hardening;

/// Relative distance below the yield stress within which a state is on the yield surface. Scaling a forward step to the event
/// leaves this distance, as its fraction counts as whole within 1e-9.
const BAND: f64 = 1e-9;

/// Rounding of the scalar equation: its terms are of the size of q_trial.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Newton steps of the scalar equation, safeguarded by bisection: 60 halvings exhaust the digits of the bracket.
const MOST_ITERATIONS: usize = 60;

/// Linear elasticity below the Mises yield stress Y(e_p). Its history is e_p.
#[derive(Clone, Debug, PartialEq)]
pub struct J2 {
    elastic: Elastic,
    hardening: Hardening,
}

impl J2 {
    /// Material with these elastic constants and hardening.
    #[must_use]
    pub fn new(elastic: Elastic, hardening: Hardening) -> Self {
        Self { elastic, hardening }
    }

    /// Elastic part.
    #[must_use]
    pub fn elastic(&self) -> &Elastic {
        &self.elastic
    }

    /// Hardening.
    #[must_use]
    pub fn hardening(&self) -> &Hardening {
        &self.hardening
    }

    /// Plastic strain increment Δe_p of a trial equivalent stress above the yield stress, and the slope of Y there.
    fn flow(&self, trial: f64, plastic: f64) -> (f64, f64) {
        let g3 = 3.0 * self.elastic.shear();
        let (mut low, mut high) = (0.0, (trial - self.hardening.at(plastic).stress) / g3);
        let mut delta = 0.0;
        let mut at = self.hardening.at(plastic);
        for _ in 0..MOST_ITERATIONS {
            let excess = trial - g3 * delta - at.stress;
            if excess.abs() <= ROUNDING * trial {
                break;
            }
            if excess > 0.0 {
                low = delta;
            } else {
                high = delta;
            }
            let newton = delta + excess / (g3 + at.slope);
            let next = if newton > low && newton <= high { newton } else { 0.5 * (low + high) };
            if next == delta {
                break;
            }
            delta = next;
            at = self.hardening.at(plastic + delta);
        }
        (delta, at.slope)
    }
}

/// Mises equivalent stress √(3/2 s:s) of a deviator.
fn equivalent(s: &Voigt) -> f64 {
    (1.5 * contract(s, s)).sqrt()
}

/// Subtracts c n⊗n, n = s/|s|. A column times an engineering shear γ represents n:ε with both shear components, so no factor is
/// needed.
fn subtract_direction(c: &mut Moduli, factor: f64, s: &Voigt) {
    let scale = factor / contract(s, s);
    for (row, si) in c.iter_mut().zip(s) {
        for (entry, sj) in row.iter_mut().zip(s) {
            *entry -= scale * si * sj;
        }
    }
}

impl ConstitutiveLaw for J2 {
    const RELAXES: bool = false;

    fn scalars(&self) -> usize {
        1
    }

    fn update(
        &self,
        _dt: f64,
        strain: &Voigt,
        stress: &mut Voigt,
        history: &mut [f64],
        moduli: Option<&mut Moduli>,
    ) {
        let (k, g) = (self.elastic.bulk(), self.elastic.shear());
        for (s, d) in stress.iter_mut().zip(elastic_increment(k, g, strain)) {
            *s += d;
        }
        let s = deviator(stress);
        let trial = equivalent(&s);
        let yield_stress = self.hardening.at(history[0]).stress;
        if trial <= yield_stress * (1.0 + ROUNDING) {
            if let Some(c) = moduli {
                *c = isotropic(k, g);
            }
            return;
        }
        let (delta, slope) = self.flow(trial, history[0]);
        let scale = 1.0 - 3.0 * g * delta / trial;
        let p = pressure(stress);
        *stress = s.map(|s| scale * s);
        for component in stress.iter_mut().take(3) {
            *component += p;
        }
        history[0] += delta;
        if let Some(c) = moduli {
            *c = isotropic(k, g * scale);
            subtract_direction(c, 2.0 * g * (1.0 / (1.0 + slope / (3.0 * g)) - (1.0 - scale)), &s);
        }
    }

    fn forward(&self, _dt: f64, stress: &Voigt, history: &[f64]) -> Moduli {
        let (k, g) = (self.elastic.bulk(), self.elastic.shear());
        let mut c = isotropic(k, g);
        let s = deviator(stress);
        let at = self.hardening.at(history[0]);
        if equivalent(&s) >= at.stress * (1.0 - BAND) {
            subtract_direction(&mut c, 2.0 * g / (1.0 + at.slope / (3.0 * g)), &s);
        }
        c
    }

    fn stored(&self, stress: &Voigt, _history: &[f64]) -> f64 {
        elastic_energy(self.elastic.bulk(), self.elastic.shear(), stress)
    }

    /// The integral of Y over the plastic strain: with isotropic hardening all plastic work counts as dissipated.
    fn plastic_work(&self, history: &[f64]) -> f64 {
        self.hardening.work(history[0])
    }

    /// r = {g + √[g² + 4 ds² (Y² - s²)]}/(2 ds²), g = s² + ds² - s_new², with s, ds and s_new the equivalent stresses of state,
    /// increment and sum. This is the positive root of |s + r ds|² = Y², since g = -2 (s, ds) in the scalar product of q². For
    /// g < 0 the sum cancels; the product of the roots, -(Y² - s²)/ds², gives the same number with all digits.
    fn yields(&self, strain: &Voigt, stress: &Voigt, history: &[f64]) -> Option<f64> {
        let s = deviator(stress);
        let ds = deviator(&elastic_increment(0.0, self.elastic.shear(), strain));
        let y = self.hardening.at(history[0]).stress;
        let q = equivalent(&s);
        let (g, d2, room) = (-3.0 * contract(&s, &ds), 1.5 * contract(&ds, &ds), (y - q) * (y + q));
        if q >= y * (1.0 - BAND) || d2 == 0.0 {
            return None;
        }
        let root = (g * g + 4.0 * d2 * room).sqrt();
        Some(if g >= 0.0 { (g + root) / (2.0 * d2) } else { 2.0 * room / (root - g) })
    }
}
