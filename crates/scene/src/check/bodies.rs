//! Bodies: their materials and the forces on them.

use super::Checker;
use crate::model::{Body, Formulation, Kinematics, Strain};
use crate::suggestions::suggest;

impl Checker<'_> {
    pub(super) fn bodies(&mut self) {
        if self.scene.bodies.is_empty() && self.scene.medium.is_none() {
            self.error(
                self.scene.kinematics.span(),
                "the scene has no body",
                "add a table `[bodies.A]`, or `[medium]` for faults in homogeneous rock",
            );
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
            if self.is_antiplane() {
                self.antiplane(name, body);
            }
        }
    }

    /// Refuses settings that do not exist in antiplane motion.
    fn antiplane(&mut self, name: &str, body: &Body) {
        let refused = [
            body.strain
                .as_ref()
                .filter(|s| *s.get_ref() == Strain::Finite)
                .map(|s| ("large deformation", s.span())),
            body.formulation
                .as_ref()
                .filter(|f| *f.get_ref() == Formulation::BBar)
                .map(|f| ("B-bar", f.span())),
        ];
        for (what, place) in refused.into_iter().flatten() {
            let why = match what {
                "B-bar" => "antiplane motion has no dilatation, so nothing locks: leave `formulation` out",
                _ => {
                    "bodies in antiplane motion are elastic, plastic or viscous with small strain; leave `strain` out, or \
                      use `kinematics = \"3d\"`"
                }
            };
            self.error(
                place,
                format!("body `{name}` has {what}, which does not exist in antiplane motion"),
                why,
            );
        }
    }

    fn forces(&mut self, name: &str, body: &Body) {
        if let Some(gravity) = &body.gravity {
            self.count(gravity, "gravity", &self.motions());
            if gravity.get_ref().iter().any(|g| !g.is_finite()) {
                self.error(
                    gravity.span(),
                    "gravity must be finite",
                    "in m/s^2, such as `gravity = [0, -9.81]`",
                );
            }
            let axial = *self.scene.kinematics.get_ref() == Kinematics::Axisymmetric;
            if axial && gravity.get_ref().first().is_some_and(|radial| *radial != 0.0) {
                self.error(
                    gravity.span(),
                    "gravity along x pulls towards the axis of revolution, or away from it: x is the radius",
                    "in m/s^2 along the axis, such as `gravity = [0, -9.81]`",
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
        self.initial_stress(name, body);
    }
}
