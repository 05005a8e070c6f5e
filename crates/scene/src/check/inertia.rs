//! Inertia of bodies.

use super::Checker;
use crate::model::{EnforcementKind, InertiaSpec, Method, Path, Spanned, Stepper};

/// Admissible errors of displacement in a step. Newton's method hides smaller ones, and a tenth resolves no motion.
const TOLERANCES: std::ops::RangeInclusive<f64> = 1e-8..=0.1;

impl Checker<'_> {
    pub(super) fn inertia(&mut self) {
        let scene = self.scene;
        let given = scene.time.inertia.as_ref().zip(scene.inertia());
        match given {
            // Another stepper is reported with its key.
            Some((key, settings)) if *scene.time.stepper.get_ref() == Stepper::Implicit => {
                self.settings(&settings);
                self.masses(key);
                self.unsupported(key);
            }
            Some(_) => {}
            None => self.velocities_at_rest(),
        }
    }

    fn settings(&mut self, settings: &InertiaSpec) {
        if let Some(radius) = settings.spectral_radius.as_ref().filter(|r| !(0.0..=1.0).contains(r.get_ref()))
        {
            self.error(
                radius.span(),
                format!("`spectral_radius` must lie between 0 and 1, found {:?}", radius.get_ref()),
                "1 dissipates nothing, 0 removes what the steps do not resolve in one step; the default is 0.5",
            );
        }
        if let Some(tolerance) = settings.tolerance.as_ref().filter(|t| !TOLERANCES.contains(t.get_ref())) {
            self.error(
                tolerance.span(),
                "`tolerance` bounds the error of displacement of a step: less than 1e-8 is hidden by rounding, and more than a tenth \
                 resolves no motion",
                "between 1e-8 and 0.1; the default is 1e-3",
            );
        }
    }

    /// Checks densities and velocities of the bodies.
    fn masses(&mut self, key: &Spanned<crate::model::Inertia>) {
        for (name, body) in &self.scene.bodies {
            for (_, material, place) in body.materials() {
                if self.scene.materials.get(material).is_none_or(|m| m.density.is_some()) {
                    continue;
                }
                self.conflict(
                    &place,
                    format!("body `{name}` has inertia, and its material `{material}` has no density"),
                    "add `density = \"2700 kg/m^3\"` to the material",
                    (&key.span(), "the inertia"),
                );
            }
            if let Some(velocity) = &body.velocity {
                self.count(velocity, "velocity", &self.motions());
                if velocity.get_ref().iter().any(|v| !v.0.is_finite()) {
                    let help = "such as `velocity = [\"1 m/s\", 0]`";
                    self.error(velocity.span(), "a velocity must be finite", help);
                }
            }
        }
    }

    /// Refuses what does not go together with inertia.
    fn unsupported(&mut self, key: &Spanned<crate::model::Inertia>) {
        let scene = self.scene;
        let here = (&key.span(), "the inertia");
        if scene.time.path == Path::Condensed {
            self.error(
                key.span(),
                "bodies with inertia cannot be condensed onto their interfaces: the condensed stiffness is that of equilibrium",
                "use `path = \"auto\"` or `path = \"full\"`",
            );
        }
        if let Some(method) = scene.solver.method.as_ref().filter(|m| *m.get_ref() == Method::Iterative) {
            let message =
                "the iterative method solves for states of equilibrium, not for bodies with inertia";
            self.conflict(&method.span(), message, "use `method = \"direct\"`, or leave it out", here);
        }
        if let Some(limit) = &scene.time.slip_rate_limit {
            let message = "`slip_rate_limit` ends a run at an instability, and bodies with inertia follow it";
            self.conflict(&limit.span(), message, "remove `slip_rate_limit`", here);
        }
        for (name, interface) in &scene.interfaces {
            let kind = &interface.enforcement.kind;
            if *kind.get_ref() == EnforcementKind::Penalty {
                continue;
            }
            let message = format!(
                "interface `{name}` enforces contact by multipliers, whose impulses at each closing inertia would make oscillate"
            );
            self.conflict(
                &kind.span(),
                message,
                "use `kind = \"penalty\"`, whose energy is part of the budget",
                here,
            );
        }
    }

    fn velocities_at_rest(&mut self) {
        for (name, body) in &self.scene.bodies {
            let Some(velocity) = &body.velocity else { continue };
            self.error(
                velocity.span(),
                format!("body `{name}` has a velocity, and the scene has no inertia"),
                "add `inertia = true` to `[time]`, or remove `velocity`",
            );
        }
    }
}
