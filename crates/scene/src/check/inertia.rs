//! Inertia of bodies.

use super::Checker;
use super::time::OF_SLIP;
use crate::model::{EnforcementKind, InertiaSpec, Method, Path, Spanned, Stepper};
use std::ops::Range;

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
                self.masses(&key.span());
                self.unsupported(&key.span());
            }
            _ if *scene.time.stepper.get_ref() == Stepper::Auto => self.auto(),
            Some(_) => {}
            None => self.velocities_at_rest(),
        }
    }

    /// Checks a scene with the stepper "auto".
    fn auto(&mut self) {
        let scene = self.scene;
        let place = scene.time.inertia.as_ref().map_or_else(|| scene.time.stepper.span(), Spanned::span);
        if let Some(off) = scene.time.inertia.as_ref().filter(|i| i.get_ref().settings().is_none()) {
            self.conflict(
                &off.span(),
                "bodies have inertia while surfaces slip fast",
                "remove `inertia = false`, or use `stepper = \"implicit\"`",
                (&scene.time.stepper.span(), "the stepper"),
            );
        }
        if let Some(settings) = scene.inertia() {
            self.settings(&settings);
        }
        self.masses(&place);
        self.unsupported(&place);
        self.handover();
        self.steps_of_events();
        self.laws_of_events();
        let velocities = scene.bodies.values().filter_map(|b| b.velocity.as_ref());
        for velocity in velocities {
            let message =
                "bodies are in equilibrium until surfaces slip fast, and have no velocity at the start";
            self.error(
                velocity.span(),
                message,
                "remove `velocity`, or use `stepper = \"implicit\"` with `inertia = true`",
            );
        }
        if scene.faults.is_empty() && scene.interfaces.is_empty() {
            let message = "the stepper \"auto\" adds inertia while surfaces slip fast, and the scene has no surface that slips";
            let help = "add `[interfaces.NAME]`, or use `stepper = \"implicit\"`";
            self.error(scene.time.stepper.span(), message, help);
        }
    }

    /// Refuses stages of equal steps in which surfaces may slip fast: such steps cannot follow an event.
    fn steps_of_events(&mut self) {
        let scene = self.scene;
        for stage in &scene.stages {
            let acts = |name: &String| !stage.frictionless.iter().any(|f| f.get_ref() == name);
            let slips =
                scene.interfaces.iter().any(|(name, interface)| interface.law.is_some() && acts(name));
            let Some(steps) = stage.steps.as_ref().filter(|_| slips) else { continue };
            let message =
                format!("the equal steps of stage `{}` cannot follow an event with inertia", stage.name);
            let help = "leave out `steps`: they are adapted; `max_step` in `[time]` bounds them";
            self.conflict(&steps.span(), message, help, (&scene.time.stepper.span(), "the stepper"));
        }
    }

    /// Refuses laws that lose strength with slip or at once: an event under them is no slip rate that grows.
    fn laws_of_events(&mut self) {
        for (name, interface) in &self.scene.interfaces {
            let kind = interface.law.as_ref().and_then(|law| law.get_ref().kind.as_ref());
            let Some(kind) = kind.filter(|k| OF_SLIP.contains(&k.get_ref().as_str())) else { continue };
            let message = format!(
                "interface `{name}` has the law \"{}\", under which no slip rate announces an event",
                kind.get_ref()
            );
            let help = "\"rate-and-state\" or \"rate\"; or `stepper = \"implicit\"` with `inertia = true`, which has inertia at all times";
            self.conflict(&kind.span(), message, help, (&self.scene.time.stepper.span(), "the stepper"));
        }
    }

    /// Checks the slip rates of the hand-over.
    fn handover(&mut self) {
        let Some(given) = &self.scene.time.handover else { return };
        let spec = given.get_ref();
        for (key, rate, example) in [("above", &spec.above, "1 mm/s"), ("below", &spec.below, "0.1 mm/s")] {
            let Some(rate) = rate.as_ref().filter(|v| !(v.get_ref().0 > 0.0 && v.get_ref().0.is_finite()))
            else {
                continue;
            };
            let help = format!("such as `{key} = \"{example}\"`");
            self.error(rate.span(), format!("`{key}` must be positive"), help);
        }
        if let Some(share) = spec.kinetic.as_ref().filter(|k| !(*k.get_ref() > 0.0 && *k.get_ref() <= 1.0)) {
            let message = "`kinetic` is a share of the largest kinetic energy since inertia began to act";
            self.error(share.span(), message, "between 0 and 1, such as `kinetic = 1e-3`; the default is 1");
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
    fn masses(&mut self, key: &Range<usize>) {
        for (name, body) in &self.scene.bodies {
            for (_, material, place) in body.materials() {
                if self.scene.materials.get(material).is_none_or(|m| m.density.is_some()) {
                    continue;
                }
                self.conflict(
                    &place,
                    format!("body `{name}` has inertia, and its material `{material}` has no density"),
                    "add `density = \"2700 kg/m^3\"` to the material",
                    (key, "the inertia"),
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
    fn unsupported(&mut self, key: &Range<usize>) {
        let scene = self.scene;
        let here = (key, "the inertia");
        if scene.time.path == Path::Condensed {
            self.error(
                key.clone(),
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
                "interface `{name}` enforces contact by multipliers, which oscillate between bodies with inertia"
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
