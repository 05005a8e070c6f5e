//! Materials.

use super::Checker;
use crate::model::{Hardening, Material, Plasticity, Spanned};
use std::ops::Range;

/// A parameter of hardening: its key, its position if given, and the kinds to which it belongs.
type Key = (&'static str, Option<Range<usize>>, &'static [Hardening]);

impl Checker<'_> {
    pub(super) fn materials(&mut self) {
        for (name, material) in &self.scene.materials {
            let young = material.young.get_ref().0;
            if young <= 0.0 {
                self.error(
                    material.young.span(),
                    format!("Young's modulus of `{name}` must be positive, found {young:e} Pa"),
                    "such as `young = \"44.8 GPa\"`",
                );
            }
            let nu = *material.poisson.get_ref();
            if !(nu > -1.0 && nu < 0.5) {
                self.error(
                    material.poisson.span(),
                    format!("Poisson's ratio of `{name}` must lie between -1 and 0.5, both excluded, found {nu:?}"),
                    "such as `poisson = 0.25`; at 0.5 the material is incompressible, which these elements cannot be",
                );
            }
            self.behaviour(name, material);
            if let Some(density) = material.density.as_ref().filter(|d| d.get_ref().0 <= 0.0) {
                self.error(
                    density.span(),
                    format!("the density of `{name}` must be positive"),
                    "such as `density = \"2700 kg/m^3\"`",
                );
            }
        }
    }

    /// Checks the inelastic properties of a material.
    fn behaviour(&mut self, name: &str, material: &Material) {
        let viscous = [
            material.viscosity.as_ref().map(|v| ("viscosity", v.span())),
            material.maxwell.as_ref().map(|v| ("maxwell", v.span())),
        ];
        if let [Some((_, first)), Some((_, second))] = &viscous {
            let message = format!("material `{name}` has both `viscosity` and `maxwell`");
            let help = "one Maxwell element is `viscosity`, several are `maxwell`: give one of them";
            self.conflict(second, message, help, (first, "and here"));
            return;
        }
        if let (Some(plasticity), Some((key, place))) =
            (&material.plasticity, viscous.into_iter().flatten().next())
        {
            let message = format!("material `{name}` has both `plasticity` and `{key}`");
            let help = "there is no material that is plastic and viscous: give one of them";
            self.conflict(&place, message, help, (&plasticity.span(), "and here"));
            return;
        }
        // The values of the parameters are checked where they are used.
        if let Some(plasticity) = &material.plasticity {
            self.plasticity(name, plasticity);
        }
    }

    /// Checks that the parameters are those of the hardening.
    fn plasticity(&mut self, name: &str, plasticity: &Spanned<Plasticity>) {
        let p = plasticity.get_ref();
        let keys: [Key; 5] = [
            (
                "yield",
                p.initial.as_ref().map(Spanned::span),
                &[Hardening::Perfect, Hardening::Linear, Hardening::Power],
            ),
            ("modulus", p.modulus.as_ref().map(Spanned::span), &[Hardening::Linear]),
            ("strain", p.strain.as_ref().map(Spanned::span), &[Hardening::Power]),
            ("exponent", p.exponent.as_ref().map(Spanned::span), &[Hardening::Power]),
            ("table", p.table.as_ref().map(Spanned::span), &[Hardening::Table]),
        ];
        let (kind, place) = (p.hardening.get_ref(), p.hardening.span());
        let own: Vec<&str> = keys.iter().filter(|k| k.2.contains(kind)).map(|k| k.0).collect();
        let help = format!("the parameters of this hardening are {}", own.join(", "));
        for (key, given, kinds) in keys {
            if given.is_none() && kinds.contains(kind) {
                let message = format!("the hardening of material `{name}` has no `{key}`");
                self.error(place.clone(), message, help.clone());
            }
        }
    }
}
