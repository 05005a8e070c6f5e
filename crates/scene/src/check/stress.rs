//! Initial stress of bodies.

use super::Checker;
use crate::model::{Body, InitialStress, Kinematics, Spanned, StressKind, VaryingStress};
use std::ops::Range;

impl Checker<'_> {
    pub(super) fn initial_stress(&mut self, name: &str, body: &Body) {
        let Some(stress) = &body.initial_stress else { return };
        match stress.get_ref() {
            InitialStress::Uniform(values) => {
                self.components("initial_stress", &stress.span(), values.len());
                self.sheet(&stress.span(), values.len(), values.get(2).map(|z| z.0));
                self.across(name, body, &stress.span(), values.len());
            }
            InitialStress::Varying(varying) => {
                if !self.scene.faults.is_empty() {
                    self.error(
                        stress.span(),
                        format!("the initial stress of body `{name}` varies, and that of bodies beside faults is uniform"),
                        "give a list of components, or `profiles.normal` and `profiles.shear` at the fault",
                    );
                }
                match varying.kind.get_ref() {
                    StressKind::Linear => self.linear_stress((name, body), varying),
                    StressKind::Lithostatic => self.lithostatic(name, body, varying),
                }
            }
        }
    }

    /// Checks that a list has the right number of stress components.
    fn components(&mut self, key: &str, place: &Range<usize>, given: usize) {
        let (short, right) = match (self.dimension(), self.is_antiplane()) {
            (_, true) => (2, "[yz, zx] or [xx, yy, zz, xy, yz, zx]"),
            (2, _) => (3, "[xx, yy, xy] or [xx, yy, zz, xy, yz, zx]"),
            _ => (6, "[xx, yy, zz, xy, yz, zx]"),
        };
        if given != 6 && given != short {
            self.error(
                place.clone(),
                format!("`{key}` has {given} components"),
                format!("in {} give {right}", self.idealisation()),
            );
        }
    }

    /// Warns of a body that yields and whose stress across the plane is left at zero.
    fn across(&mut self, name: &str, body: &Body, place: &Range<usize>, given: usize) {
        let strained =
            matches!(*self.scene.kinematics.get_ref(), Kinematics::PlaneStrain | Kinematics::Axisymmetric);
        let names = body.materials();
        let mut materials =
            names.into_iter().filter_map(|(_, material, _)| self.scene.materials.get(material));
        if strained && given == 3 && materials.any(|material| material.plasticity.is_some()) {
            self.warn(
                place.clone(),
                format!("the initial stress of body `{name}` has three components, so that zz is 0, and its yielding depends on zz"),
                "give all six, [xx, yy, zz, xy, 0, 0], with zz between the other two where rock is confined",
            );
        }
    }

    /// Refuses a stress zz in plane stress.
    fn sheet(&mut self, place: &Range<usize>, given: usize, through: Option<f64>) {
        let sheet = *self.scene.kinematics.get_ref() == Kinematics::PlaneStress;
        if let (true, 6, Some(zz)) = (sheet, given, through.filter(|z| *z != 0.0)) {
            self.error(
                place.clone(),
                format!("an initial stress zz of {zz:e} Pa in plane stress"),
                "in plane stress zz is 0",
            );
        }
    }

    fn linear_stress(&mut self, (name, body): (&str, &Body), stress: &VaryingStress) {
        let example = "such as { kind = \"linear\", along = \"y\", level = \"0 m\", stress = [0, 0, 0], gradient = [\"10 kPa/m\", \"26 \
                       kPa/m\", 0] }";
        self.needs(stress, "along", stress.along.is_some(), example);
        self.needs(stress, "level", stress.level.is_some(), example);
        self.needs(stress, "stress", stress.stress.is_some(), example);
        self.needs(stress, "gradient", stress.gradient.is_some(), example);
        if let Some(values) = &stress.stress {
            self.components("stress", &values.span(), values.get_ref().len());
            self.sheet(&values.span(), values.get_ref().len(), values.get_ref().get(2).map(|z| z.0));
            self.across(name, body, &values.span(), values.get_ref().len());
        }
        if let Some(values) = &stress.gradient {
            self.components("gradient", &values.span(), values.get_ref().len());
            self.sheet(&values.span(), values.get_ref().len(), values.get_ref().get(2).map(|z| z.0));
        }
        if let Some(along) = stress.along.as_ref().filter(|a| *a.get_ref() as usize >= self.dimension()) {
            self.error(along.span(), "there is no axis z in the plane", "use \"x\" or \"y\"");
        }
    }

    fn lithostatic(&mut self, name: &str, body: &Body, stress: &VaryingStress) {
        let example = "such as { kind = \"lithostatic\", level = \"0 m\", k0 = 0.5 }";
        self.needs(stress, "level", stress.level.is_some(), example);
        self.needs(stress, "k0", stress.k0.is_some(), example);
        if let Some(k0) = stress.k0.as_ref().filter(|k| !(k.get_ref().is_finite() && *k.get_ref() >= 0.0)) {
            self.error(
                k0.span(),
                format!("`k0` is {}", k0.get_ref()),
                "horizontal over vertical stress, such as 0.5",
            );
        }
        if let Some(load) = stress.overburden.as_ref().filter(|p| p.get_ref().0 < 0.0) {
            self.error(load.span(), "an overburden that pulls", "pressures are positive");
        }
        if self.is_antiplane() {
            self.error(
                stress.kind.span(),
                "a lithostatic stress has no component in antiplane motion",
                "give yz and zx with `kind = \"linear\"`",
            );
            return;
        }
        let along = body.gravity.as_ref().map(|g| g.get_ref().iter().filter(|g| **g != 0.0).count());
        if along != Some(1) {
            self.error(
                body.gravity.as_ref().map_or(stress.kind.span(), Spanned::span),
                format!("the lithostatic stress of body `{name}` needs `gravity` along one axis"),
                "such as `gravity = [0, -9.81]` in the same body; without weight use `kind = \"linear\"`",
            );
        }
        let density = |m: &str| Some(self.scene.materials.get(m)?.density.as_ref()?.get_ref().0);
        let mut densities: Vec<f64> = body.materials().filter_map(|(_, m, _)| density(m)).collect();
        densities.dedup();
        if densities.len() > 1 {
            self.error(
                stress.kind.span(),
                format!("the materials of body `{name}` differ in density, and the material above is not known at each point"),
                "make a body of each layer, with the `overburden` of those above, or use `kind = \"linear\"`",
            );
        }
    }

    fn needs(&mut self, stress: &VaryingStress, key: &str, given: bool, example: &str) {
        if !given {
            self.error(stress.kind.span(), format!("the initial stress has no `{key}`"), example);
        }
    }
}
