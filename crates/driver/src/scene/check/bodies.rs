//! Bodies: their materials and the forces on them.

use super::Checker;
use crate::scene::model::{Body, Kinematics};
use crate::scene::near::suggest;

impl Checker<'_> {
    pub(super) fn bodies(&mut self) {
        if self.scene.bodies.is_empty() {
            self.error(self.scene.kinematics.span(), "the scene has no body", "add a table `[bodies.A]`");
        }
        for (name, body) in &self.scene.bodies {
            self.name("a body", name, body.material.span());
            for (_, material, place) in body.materials() {
                if self.scene.materials.contains_key(material) {
                    continue;
                }
                let known = self.scene.materials.keys().map(String::as_str);
                self.error(
                    place,
                    format!("there is no material `{material}`"),
                    suggest(material, "materials", known),
                );
            }
            self.mesh(name, body);
            self.forces(name, body);
        }
    }

    fn forces(&mut self, name: &str, body: &Body) {
        if let Some(gravity) = &body.gravity {
            self.count(gravity, "gravity", self.dimension());
            if gravity.get_ref().iter().any(|g| !g.is_finite()) {
                self.error(
                    gravity.span(),
                    "gravity must be finite",
                    "in m/s^2, such as `gravity = [0, -9.81]`",
                );
            }
            for (_, material, _) in body.materials() {
                if self.scene.materials.get(material).is_none_or(|m| m.density.is_some()) {
                    continue;
                }
                self.error(
                    gravity.span(),
                    format!("gravity acts on body `{name}`, whose material `{material}` has no density"),
                    "add `density = \"2700 kg/m^3\"` to the material",
                );
            }
        }
        if let Some(stress) = &body.initial_stress {
            let (given, plane) = (stress.get_ref().len(), self.dimension() == 2);
            if given != 6 && !(plane && given == 3) {
                let right = if plane {
                    "[xx, yy, xy] or [xx, yy, zz, xy, yz, zx]"
                } else {
                    "[xx, yy, zz, xy, yz, zx]"
                };
                self.error(
                    stress.span(),
                    format!("`initial_stress` has {given} components"),
                    format!("in {} give {right}", self.idealisation()),
                );
            }
            let sheet = *self.scene.kinematics.get_ref() == Kinematics::PlaneStress;
            if let (true, 6, Some(zz)) = (sheet, given, stress.get_ref().get(2).filter(|z| z.0 != 0.0)) {
                self.error(
                    stress.span(),
                    format!("an initial stress zz of {:e} Pa in plane stress", zz.0),
                    "in plane stress zz is 0",
                );
            }
        }
    }
}
