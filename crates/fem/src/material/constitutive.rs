//! Interface between a block and a material with memory: the stress after a strain increment, and its derivative.
//!
//! Stresses are xx, yy, zz, xy, yz, zx \[Pa\]; strain increments have the same order, with engineering shears γ = 2 ε.
//! Materials are isotropic: `update` of rotated arguments is the rotated update. The integration of objective rates relies on
//! this.

use super::elastic::Elastic;

/// Stress xx, yy, zz, xy, yz, zx \[Pa\] or strain with engineering shears \[-\].
pub type Voigt = [f64; 6];
/// ∂σ/∂ε, with a row per stress and a column per engineering strain \[Pa\].
pub type Moduli = [[f64; 6]; 6];

/// An isotropic material whose next stress depends on the last one, on a history and on the strain increment.
pub trait ConstitutiveLaw: Sync {
    /// True if the stress changes in time at constant strain.
    const RELAXES: bool;

    /// Symmetric tensors in the history (six numbers each, first in the slice): they rotate with the material.
    fn tensors(&self) -> usize {
        0
    }

    /// Invariant numbers in the history, after the tensors.
    fn scalars(&self) -> usize {
        0
    }

    /// Replaces stress and history by those after `strain` over `dt` \[s\], and writes the consistent tangent ∂σ_new/∂(strain)
    /// if requested.
    fn update(
        &self,
        dt: f64,
        strain: &Voigt,
        stress: &mut Voigt,
        history: &mut [f64],
        moduli: Option<&mut Moduli>,
    );

    /// Tangent of a forward step of length `dt` from the given state: the continuum tangent if the state is on the yield
    /// surface.
    fn forward(&self, dt: f64, stress: &Voigt, history: &[f64]) -> Moduli;

    /// Elastic energy per volume \[J/m³\].
    fn stored(&self, stress: &Voigt, history: &[f64]) -> f64;

    /// Energy per volume that plastic flow has dissipated \[J/m³\].
    fn plastic_work(&self, _history: &[f64]) -> f64 {
        0.0
    }

    /// Energy per volume and time that viscous flow dissipates \[W/m³\].
    fn viscous_rate(&self, _stress: &Voigt, _history: &[f64]) -> f64 {
        0.0
    }

    /// The fraction of an elastic stress path along `strain`, possibly beyond 1, at which an elastic state starts to yield
    /// (r1); `None` if it yields already or cannot yield.
    fn yields(&self, _strain: &Voigt, _stress: &Voigt, _history: &[f64]) -> Option<f64> {
        None
    }
}

/// κ 1⊗1 + 2 g (I - 1⊗1/3): an isotropic tangent with bulk modulus κ and shear modulus g.
#[must_use]
pub fn isotropic(bulk: f64, shear: f64) -> Moduli {
    let mut c = [[0.0; 6]; 6];
    for i in 0..3 {
        c[i][..3].fill(bulk - 2.0 / 3.0 * shear);
        c[i][i] += 2.0 * shear;
        c[i + 3][i + 3] = shear;
    }
    c
}

/// Deviator of a stress.
#[must_use]
pub fn deviator(s: &Voigt) -> Voigt {
    let p = pressure(s);
    [s[0] - p, s[1] - p, s[2] - p, s[3], s[4], s[5]]
}

/// Mean of the normal components (for an engineering strain: a third of the dilatation).
#[must_use]
pub fn pressure(s: &Voigt) -> f64 {
    (s[0] + s[1] + s[2]) / 3.0
}

/// a : b of two stresses.
#[must_use]
pub fn contract(a: &Voigt, b: &Voigt) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2.0 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5])
}

/// Stress increment of isotropic elasticity.
#[must_use]
pub fn elastic_increment(bulk: f64, shear: f64, strain: &Voigt) -> Voigt {
    let volume = (bulk - 2.0 / 3.0 * shear) * (strain[0] + strain[1] + strain[2]);
    let g = shear;
    [
        volume + 2.0 * g * strain[0],
        volume + 2.0 * g * strain[1],
        volume + 2.0 * g * strain[2],
        g * strain[3],
        g * strain[4],
        g * strain[5],
    ]
}

/// Elastic energy per volume, `p²/2K + s:s/4G` with p the mean stress and s the deviator \[J/m³\].
#[must_use]
pub fn elastic_energy(bulk: f64, shear: f64, stress: &Voigt) -> f64 {
    let s = deviator(stress);
    0.5 * pressure(stress).powi(2) / bulk + 0.25 * contract(&s, &s) / shear
}

impl ConstitutiveLaw for Elastic {
    const RELAXES: bool = false;

    fn update(
        &self,
        _dt: f64,
        strain: &Voigt,
        stress: &mut Voigt,
        _history: &mut [f64],
        moduli: Option<&mut Moduli>,
    ) {
        let (k, g) = (self.bulk(), self.shear());
        for (s, d) in stress.iter_mut().zip(elastic_increment(k, g, strain)) {
            *s += d;
        }
        if let Some(c) = moduli {
            *c = isotropic(k, g);
        }
    }

    fn forward(&self, _dt: f64, _stress: &Voigt, _history: &[f64]) -> Moduli {
        isotropic(self.bulk(), self.shear())
    }

    fn stored(&self, stress: &Voigt, _history: &[f64]) -> f64 {
        elastic_energy(self.bulk(), self.shear(), stress)
    }
}
