//! Linear viscoelasticity of the deviator: Maxwell elements in parallel, optionally with a spring; the bulk is elastic.
//!
//! Each element obeys `ds/dt + s/τ = 2 G de/dt`, τ = η/G. Over a step at constant strain rate this has the exact solution `s =
//! exp(-x) s_0 + 2 G φ(x) Δe`, x = dt/τ, φ(x) = (1 - exp(-x))/x, for steps of any length.

use super::constitutive::{ConstitutiveLaw, Moduli, Voigt, contract, deviator, isotropic, pressure};
use super::elastic::Elastic;
use crate::error::FemError;

/// Largest number of elements in parallel: the history of a point is kept on the stack.
pub const MOST_ELEMENTS: usize = 4;

/// One spring and dashpot in series, or a spring alone.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Element {
    shear: f64,
    /// η/G \[s\]; infinite for a spring.
    time: f64,
}

/// A dashpot and the fraction of the instantaneous shear modulus that relaxes through it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Branch {
    /// Fraction of G \[-\].
    pub share: f64,
    /// Viscosity η \[Pa s\].
    pub viscosity: f64,
}

/// Elements in parallel. The stress of the first is the total minus those of the others, so that a single Maxwell element needs
/// no history but its stress.
#[derive(Clone, Debug, PartialEq)]
pub struct Maxwell {
    bulk: f64,
    elements: Vec<Element>,
}

impl Maxwell {
    /// A Maxwell material: instantaneous constants E, ν and viscosity 0 < η \[Pa s\]. Shear stress relaxes as exp(-G t/η).
    ///
    /// # Errors
    /// [`FemError::Material`] if η is out of range.
    pub fn new(elastic: &Elastic, viscosity: f64) -> Result<Self, FemError> {
        Self::generalised(elastic, &[Branch { share: 1.0, viscosity }])
    }

    /// Branches in parallel; the remainder of their shares to 1 is a spring that does not relax. One branch with a share below
    /// 1 is the standard linear solid.
    ///
    /// # Errors
    /// [`FemError::Material`] for a viscosity or share that is not positive, shares that sum to more than 1, or too many
    /// branches.
    pub fn generalised(elastic: &Elastic, branches: &[Branch]) -> Result<Self, FemError> {
        let refuse = |name, value, admissible| Err(FemError::Material { name, value, admissible });
        for branch in branches {
            if !(branch.viscosity > 0.0 && branch.viscosity.is_finite()) {
                return refuse("viscosity", branch.viscosity, "0 < eta, finite");
            }
            if !(branch.share > 0.0 && branch.share <= 1.0) {
                return refuse("share of a branch", branch.share, "0 < share <= 1");
            }
        }
        let rest = 1.0 - branches.iter().map(|b| b.share).sum::<f64>();
        // Decimal shares that should sum to 1 miss it by rounding.
        let rounding = 8.0 * f64::EPSILON;
        if rest < -rounding {
            return refuse("sum of the shares", 1.0 - rest, "at most 1");
        }
        let spring =
            (rest > rounding).then(|| Element { shear: rest * elastic.shear(), time: f64::INFINITY });
        let elements: Vec<Element> = spring
            .into_iter()
            .chain(branches.iter().map(|b| {
                let shear = b.share * elastic.shear();
                Element { shear, time: b.viscosity / shear }
            }))
            .collect();
        if elements.len() > MOST_ELEMENTS {
            return refuse("number of springs and branches", elements.len() as f64, "at most 4");
        }
        Ok(Self { bulk: elastic.bulk(), elements })
    }

    /// Shortest relaxation time \[s\].
    #[must_use]
    pub fn shortest_time(&self) -> f64 {
        self.elements.iter().map(|e| e.time).fold(f64::INFINITY, f64::min)
    }

    /// Effective shear modulus in a step of length `dt`: Σ G φ \[Pa\].
    fn effective_shear(&self, dt: f64) -> f64 {
        self.elements.iter().map(|e| e.shear * mean_decay(dt / e.time)).sum()
    }
}

/// (1 - exp(-x))/x.
fn mean_decay(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { -(-x).exp_m1() / x }
}

impl Maxwell {
    /// s:s of each element \[Pa²\], with the element.
    fn parts<'a>(&'a self, stress: &Voigt, history: &'a [f64]) -> impl Iterator<Item = (f64, &'a Element)> {
        let mut first = deviator(stress);
        for part in history.chunks_exact(6) {
            first.iter_mut().zip(part).for_each(|(f, h)| *f -= h);
        }
        let others = history.chunks_exact(6).map(|part| std::array::from_fn(|i| part[i]));
        let all = std::iter::once(first).chain(others);
        all.zip(&self.elements).map(|(s, element): (Voigt, _)| (contract(&s, &s), element))
    }
}

impl ConstitutiveLaw for Maxwell {
    const RELAXES: bool = true;

    fn tensors(&self) -> usize {
        self.elements.len().saturating_sub(1)
    }

    fn update(
        &self,
        dt: f64,
        strain: &Voigt,
        stress: &mut Voigt,
        history: &mut [f64],
        moduli: Option<&mut Moduli>,
    ) {
        let p = pressure(stress) + 3.0 * self.bulk * pressure(strain);
        let mut first = deviator(stress);
        let theta = pressure(strain);
        // Tensor components of the deviatoric strain, doubled.
        let e2: Voigt = std::array::from_fn(|i| if i < 3 { 2.0 * (strain[i] - theta) } else { strain[i] });
        for part in history.chunks_exact(6) {
            first.iter_mut().zip(part).for_each(|(f, h)| *f -= h);
        }
        let mut total = [0.0; 6];
        for (k, element) in self.elements.iter().enumerate() {
            let x = dt / element.time;
            let (decay, g) = ((-x).exp(), element.shear * mean_decay(x));
            let part: &mut [f64] = if k == 0 { &mut first } else { &mut history[6 * (k - 1)..6 * k] };
            for ((s, t), e) in part.iter_mut().zip(&mut total).zip(&e2) {
                *s = decay * *s + g * e;
                *t += *s;
            }
        }
        *stress = std::array::from_fn(|i| if i < 3 { total[i] + p } else { total[i] });
        if let Some(c) = moduli {
            *c = isotropic(self.bulk, self.effective_shear(dt));
        }
    }

    fn forward(&self, dt: f64, _stress: &Voigt, _history: &[f64]) -> Moduli {
        isotropic(self.bulk, self.effective_shear(dt))
    }

    /// Energy of the bulk and of the spring of each element.
    fn stored(&self, stress: &Voigt, history: &[f64]) -> f64 {
        let parts = self.parts(stress, history);
        0.5 * pressure(stress).powi(2) / self.bulk + parts.map(|(s2, e)| 0.25 * s2 / e.shear).sum::<f64>()
    }

    /// s:s/2η of each element, with η = G τ; 0 for a spring.
    fn viscous_rate(&self, stress: &Voigt, history: &[f64]) -> f64 {
        self.parts(stress, history).map(|(s2, e)| 0.5 * s2 / (e.shear * e.time)).sum()
    }
}
