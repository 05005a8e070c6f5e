//! Energies of the committed state.
//!
//! Under finite deformation the stress is that of Kirchhoff and volumes are those of the reference. The Jaumann rate of isotropic
//! hypoelasticity works as much on the elastic rate of deformation as its energy in terms of the Kirchhoff stress changes.

use super::block::Block;
use super::model::with_material;
use crate::material::constitutive::{ConstitutiveLaw, Voigt};

impl<const D: usize> Block<D> {
    /// Elastic energy \[J, or J/m of thickness\].
    #[must_use]
    pub fn strain_energy(&self) -> f64 {
        with_material!(&self.body.model.material, m => self.integral(|s, h| m.stored(s, h)))
    }

    /// Energy that plastic flow has dissipated \[J, or J/m of thickness\].
    #[must_use]
    pub fn plastic_work(&self) -> f64 {
        with_material!(&self.body.model.material, m => self.integral(|_, h| m.plastic_work(h)))
    }

    /// Rate at which viscous flow dissipates energy \[W, or W/m of thickness\].
    #[must_use]
    pub fn viscous_rate(&self) -> f64 {
        with_material!(&self.body.model.material, m => self.integral(|s, h| m.viscous_rate(s, h)))
    }

    /// Integral of a function of stress and history over the reference volume.
    fn integral(&self, density: impl Fn(&Voigt, &[f64]) -> f64) -> f64 {
        let layout = self.body.frame.layout;
        let states = self.state.committed.chunks_exact(layout.stride.max(1));
        let point = |(kept, volume): (&[f64], &f64)| {
            let mut state = layout.read(kept);
            let (stress, history) = layout.split(&mut state);
            volume * density(stress, history)
        };
        states.zip(&self.body.volumes).map(point).sum()
    }
}
