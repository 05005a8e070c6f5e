//! Bodies with mass, whose faults radiate waves: the stepper "explicit".

use super::{AXES, Checker};
use crate::model::{Body, Condition, Fault, PointSpec, SlipSpec, Spanned, Stage, Stepper};
use crate::suggestions::suggest;
use std::ops::Range;

/// Largest fraction of the stable step.
const MOST: f64 = 1.0;

impl Checker<'_> {
    /// True if the stepper is "explicit".
    pub(super) fn has_waves(&self) -> bool {
        *self.scene.time.stepper.get_ref() == Stepper::Explicit
    }

    /// Checks a scene with the stepper "explicit".
    pub(super) fn explicit(&mut self) {
        self.parts();
        self.masses_of_waves();
        self.stability();
        let scene = self.scene;
        for fault in scene.faults.values() {
            self.creep_with_mass(fault);
            self.direction_with_mass(fault);
            self.start_with_mass(fault);
            self.delay(fault);
        }
        self.same_for_all();
        for (name, spec) in &scene.output.seismograms {
            self.seismogram(name, spec);
        }
        let amounts = [
            ("sampling", scene.output.sampling.as_ref().map(|t| (t.span(), t.get_ref().0)), "10 ms"),
            ("rupture_rate", scene.output.rupture_rate.as_ref().map(|v| (v.span(), v.get_ref().0)), "1 mm/s"),
        ];
        for (key, given, example) in amounts {
            let Some((place, value)) = given else { continue };
            if !(value > 0.0 && value.is_finite()) {
                let help = format!("such as `{key} = \"{example}\"`");
                self.error(place, format!("`{key}` must be positive"), help);
            }
        }
    }

    /// Checks that the scene has one stage.
    fn parts(&mut self) {
        let scene = self.scene;
        if let Some(second) = scene.stages.get(1) {
            self.error(
                second.duration.span(),
                format!("a scene with the stepper \"explicit\" has one stage, found {}", scene.stages.len()),
                "motions and loads that change with time are tables",
            );
        }
    }

    /// Refuses creep at a rate: between bodies with mass, parts of a fault are locked at most.
    fn creep_with_mass(&mut self, fault: &Fault) {
        let rate = fault.creep.as_ref().map(|creep| &creep.rate).filter(|rate| rate.get_ref().0 != 0.0);
        if let Some(rate) = rate {
            self.conflict(
                &rate.span(),
                "`creep` of a fault between bodies with mass",
                "remove it: at `rate = 0` a part of the fault is locked",
                (&self.scene.time.stepper.span(), "the stepper"),
            );
        }
    }

    /// Checks that all bodies have mass.
    fn masses_of_waves(&mut self) {
        let scene = self.scene;
        let used = |body: &Body| -> Vec<(String, Range<usize>)> {
            body.materials().map(|(_, name, place)| (name.to_string(), place)).collect()
        };
        let mut told: Vec<String> = Vec::new();
        for (name, place) in scene.bodies.values().flat_map(used) {
            let Some(material) = scene.materials.get(&name).filter(|m| m.density.is_none()) else { continue };
            if told.contains(&name) {
                continue;
            }
            self.conflict(
                &material.young.span(),
                format!("material `{name}` has no density, and bodies have inertia here"),
                "such as `density = \"2670 kg/m^3\"`",
                (&place, "a body of this material"),
            );
            told.push(name);
        }
    }

    /// Checks the length of steps and the viscosity.
    pub(super) fn stability(&mut self) {
        let time = &self.scene.time;
        if let Some(courant) = time.courant.as_ref().filter(|c| !(*c.get_ref() > 0.0 && *c.get_ref() <= MOST))
        {
            self.error(
                courant.span(),
                format!(
                    "steps of {} times the stable step: longer ones than that grow without bound",
                    courant.get_ref()
                ),
                "between 0 and 1, such as `courant = 0.5`",
            );
        }
        if let Some(viscosity) =
            time.viscosity.as_ref().filter(|v| !(*v.get_ref() >= 0.0 && v.get_ref().is_finite()))
        {
            self.error(
                viscosity.span(),
                "`viscosity` must not be negative",
                "such as `viscosity = 0.1`, the time of viscosity over the step; 0 for none",
            );
        }
    }

    /// Checks that slip in space may turn: nothing holds it along the rake.
    pub(super) fn direction_with_mass(&mut self, fault: &Fault) {
        let free = fault.slip.as_ref().is_some_and(|s| *s.get_ref() == SlipSpec::Free);
        if self.in_space() && !free {
            let place = fault.slip.as_ref().map_or_else(|| fault.span(), Spanned::span);
            self.error(
                place,
                "slip of bodies with mass follows the shear traction, in any direction of the fault",
                "add `slip = \"free\"` to the fault",
            );
        }
    }

    /// Checks that the shear traction at the start is given, and that no weight presses the fault.
    fn start_with_mass(&mut self, fault: &Fault) {
        let scene = self.scene;
        let bodies = [&fault.minus, &fault.plus].map(|side| scene.body_of(side));
        let stressed = bodies.iter().flatten().any(|b| b.initial_stress.is_some());
        let follows = fault.fields.state.is_some();
        let [minus, plus] = bodies;
        let other = plus.filter(|plus| !minus.is_some_and(|minus| std::ptr::eq(minus, *plus)));
        minus.into_iter().chain(other).for_each(|body| self.yields_from_its_stress(body, fault));
        if fault.shear.is_none() && !fault.has_shear_along() && !stressed && !follows {
            self.error(
                fault.span(),
                "the fault has no `shear`, and bodies with mass start from given tractions",
                "such as `shear = \"70 MPa\"`, `profiles.shear`, or an `initial_stress` of its bodies",
            );
        }
        if let Some(gravity) = scene.bodies.values().find_map(|b| b.gravity.as_ref()) {
            self.error(
                gravity.span(),
                "`gravity` of bodies with mass and faults: the weight is part of the state at the start",
                "leave it out, and give `normal` and `shear` of the fault, or an `initial_stress`",
            );
        }
    }

    /// Refuses a body that yields beside a fault and starts without the stress that loads the fault: it would yield too late, and
    /// then without end.
    fn yields_from_its_stress(&mut self, body: &Body, fault: &Fault) {
        if body.initial_stress.is_some() {
            return;
        }
        let plastic = body.materials().find_map(|(_, name, _)| {
            let spec = self.scene.materials.get(name)?.plasticity.as_ref()?;
            Some((name.to_string(), spec.span()))
        });
        let Some((name, place)) = plastic else { return };
        self.conflict(
            &place,
            format!("`{name}` yields beside a fault, and its body starts without stress"),
            "give the bodies beside the fault the `initial_stress` that loads it, such as [\"-120 MPa\", \"-120 MPa\", \"70 MPa\"], instead of its `normal` and `shear`, and start the rupture by `pulses`",
            (&fault.span(), "the fault"),
        );
    }

    /// Checks the delay of the normal traction.
    fn delay(&mut self, fault: &Fault) {
        let Some(delay) = &fault.normal_delay else { return };
        let positive = |v: f64| v > 0.0 && v.is_finite();
        if !(positive(delay.get_ref().length.0) && positive(delay.get_ref().rate.0)) {
            self.error(
                delay.span(),
                "`length` and `rate` of a delay must be positive",
                "such as `normal_delay = { length = \"0.2 m\", rate = \"1 m/s\" }`",
            );
        }
    }

    /// Checks what all faults of a scene share.
    fn same_for_all(&mut self) {
        let scene = self.scene;
        let Some(first) = scene.faults.values().next() else { return };
        let opens = |f: &Fault| f.opening.as_ref().is_some_and(|o| *o.get_ref());
        let delay = |f: &Fault| f.normal_delay.as_ref().map(|d| (d.get_ref().length.0, d.get_ref().rate.0));
        for other in scene.faults.values() {
            let key = if opens(other) != opens(first) {
                "opening"
            } else if delay(other) != delay(first) {
                "normal_delay"
            } else {
                continue;
            };
            self.conflict(
                &other.span(),
                format!("the faults of a scene differ in `{key}`"),
                format!("give all of them the same `{key}`"),
                (&first.span(), "another fault"),
            );
        }
    }

    /// Checks the pulses of a fault.
    pub(super) fn pulses(&mut self, fault: &Fault) {
        let axes: Vec<usize> = (0..self.dimension()).collect();
        for pulse in &fault.pulses {
            self.count(&pulse.centre, "centre", &axes);
            if !pulse.traction.get_ref().0.is_finite() {
                self.error(
                    pulse.traction.span(),
                    "`traction` must be finite",
                    "such as `traction = \"25 MPa\"`",
                );
            }
            for (key, place, value, example) in [
                ("radius", pulse.radius.span(), pulse.radius.get_ref().0, "3 km"),
                ("duration", pulse.duration.span(), pulse.duration.get_ref().0, "1 s"),
            ] {
                if !(value > 0.0 && value.is_finite()) {
                    let help = format!("such as `{key} = \"{example}\"`");
                    self.error(place, format!("`{key}` of a pulse must be positive"), help);
                }
            }
        }
    }

    fn seismogram(&mut self, name: &str, spec: &Spanned<PointSpec>) {
        /// Characters of the code of a station in miniSEED.
        const MOST: usize = 5;
        let capital = |b: u8| b.is_ascii_uppercase() || b.is_ascii_digit();
        if !((1..=MOST).contains(&name.len()) && name.bytes().all(capital)) {
            self.error(
                spec.span(),
                format!("`{name}` cannot be the code of a station"),
                "one to five capital letters and digits, such as `ST01`",
            );
        }
        let PointSpec { body, at } = spec.get_ref();
        if !self.scene.bodies.contains_key(body.get_ref()) {
            let known = self.scene.bodies.keys().map(String::as_str);
            self.error(
                body.span(),
                format!("there is no body `{}`", body.get_ref()),
                suggest(body.get_ref(), "bodies", known),
            );
        }
        self.count(at, "at", &(0..self.dimension()).collect::<Vec<_>>());
    }

    /// Reports absorbing sides and are prescribed or loaded as well. Between ruptures an absorbing side may be.
    pub(super) fn absorbing(&mut self, stage: &Stage) {
        if self.has_ruptures() {
            return;
        }
        let absorbs = |c: &&Spanned<Condition>| c.get_ref().absorbing.as_ref().is_some_and(|a| *a.get_ref());
        for condition in stage.conditions.iter().filter(absorbs) {
            let Condition { set: Some(set), absorbing: Some(absorbing), .. } = condition.get_ref() else {
                continue;
            };
            let on_set = |c: &&Spanned<Condition>| {
                c.get_ref().set.as_ref().map(Spanned::get_ref) == Some(set.get_ref())
            };
            for other in stage.conditions.iter().filter(on_set) {
                let c = other.get_ref();
                let mut acts: Vec<(&str, Range<usize>)> = Vec::new();
                for (axis, motion) in AXES.into_iter().zip([&c.x, &c.y, &c.z]) {
                    acts.extend(motion.as_ref().map(|m| (axis, m.span())));
                }
                acts.extend(c.symmetry.as_ref().map(|s| ("symmetry", s.span())));
                acts.extend(c.traction.as_ref().map(|t| ("traction", t.span())));
                acts.extend(c.pressure.as_ref().map(|p| ("pressure", p.span())));
                for (what, place) in acts {
                    self.conflict(
                        &absorbing.span(),
                        format!("`{}` absorbs waves and has a condition `{what}` as well", set.get_ref()),
                        "an absorbing side moves as the waves move it: remove one of the two",
                        (&place, "the other condition"),
                    );
                }
            }
        }
    }
}
