//! Values that have no effect in combination with others.

use super::Checker;
use crate::defaults;
use crate::model::{Spanned, Stage, Stepper};
use std::collections::BTreeSet;
use std::ops::Range;

/// Share of a step by which equal steps may violate a bound: rounding of durations divided by numbers of steps.
const ROUNDING: f64 = 1e-9;

/// Largest spacing of neighbouring floating-point times, as a share of the first step of a stage. Increments of motions and of
/// time differ by this share.
const RESOLVED: f64 = 0.01;

/// Laws with a characteristic slip, to which `zeta` applies.
const WITH_LENGTH: [&str; 2] = ["slip-weakening", "rate-and-state"];
/// Laws that depend on the slip rate, to which `rate_change` applies.
const WITH_RATE: [&str; 2] = ["rate", "rate-and-state"];

/// A given key: its name and position.
type Key = (&'static str, Range<usize>);

fn key<T>(name: &'static str, given: Option<&Spanned<T>>) -> Option<Key> {
    given.map(|g| (name, g.span()))
}

impl Checker<'_> {
    pub(super) fn unused(&mut self) {
        for stage in &self.scene.stages {
            self.equal_steps(stage);
        }
        if !self.has_waves() {
            self.resolution();
        }
        self.materials_of_no_body();
        let of_faults = matches!(*self.scene.time.stepper.get_ref(), Stepper::FaultOde | Stepper::Explicit);
        if !of_faults && !self.has_ruptures() {
            self.without_adaption();
            self.beside_defaults();
            self.without_interface();
            self.without_law();
        }
    }

    /// Checks the equal steps of a stage against the bounds of `[time]`, which they would override.
    fn equal_steps(&mut self, stage: &Stage) {
        let Some(steps) = stage.steps.as_ref().filter(|s| *s.get_ref() > 0) else { return };
        let (duration, n) = (stage.duration.get_ref().0, *steps.get_ref() as f64);
        let length = duration / n;
        let time = &self.scene.time;
        if let Some(most) = time.max_step.as_ref().filter(|m| length > m.get_ref().0 * (1.0 + ROUNDING)) {
            let (name, bound) = (&stage.name, most.get_ref().0);
            let message = format!(
                "the {n} equal steps of stage `{name}` are {length:?} s long, longer than `max_step`, {bound:?} s"
            );
            let least = (duration / bound * (1.0 - ROUNDING)).ceil();
            let help = format!("`steps = {least}` or more, or leave `steps` out, and the steps are adapted");
            self.conflict(&steps.span(), message, help, (&most.span(), "the largest step"));
        }
        if let Some(least) = time.min_step.as_ref().filter(|m| length < m.get_ref().0 * (1.0 - ROUNDING)) {
            let (name, bound) = (&stage.name, least.get_ref().0);
            let message = format!(
                "the {n} equal steps of stage `{name}` are {length:?} s long, shorter than `min_step`, {bound:?} s"
            );
            let help = "take fewer `steps`, or a smaller `min_step`";
            self.conflict(&steps.span(), message, help, (&least.span(), "the smallest step"));
        }
    }

    /// Refuses stages whose steps are lost in the rounding of their start time, as times count from the start of the run. Those
    /// of faults count from the start of their own stage.
    fn resolution(&mut self) {
        if !self.scene.faults.is_empty() {
            return;
        }
        let mut start = 0.0;
        let first_step = self.scene.time.first_step.as_ref().map(|f| f.get_ref().0);
        for (index, stage) in self.scene.stages.iter().enumerate() {
            let duration = stage.duration.get_ref().0;
            let first = match &stage.steps {
                Some(steps) => duration / (*steps.get_ref()).max(1) as f64,
                None => first_step.unwrap_or(defaults::FIRST_STEP * duration).min(duration),
            };
            let apart = f64::EPSILON * start;
            if index > 0 && first > 0.0 && apart > RESOLVED * first {
                let before = &self.scene.stages[index - 1];
                let message = format!(
                    "stage `{}` begins at {start:e} s, where neighbouring times are {apart:.1e} s apart: its first step of {first:.1e} s is lost in \
                     rounding",
                    stage.name
                );
                let help = "times count from the start of the run: shorten the stages before it, or make a run of its own";
                self.conflict(
                    &stage.duration.span(),
                    message,
                    help,
                    (&before.duration.span(), "the stage before"),
                );
                return;
            }
            start += duration;
        }
    }

    fn materials_of_no_body(&mut self) {
        let of_bodies = self.scene.bodies.values().flat_map(|body| body.materials().map(|m| m.1));
        let of_medium = self.scene.medium.iter().map(|medium| medium.material.get_ref().as_str());
        let used: BTreeSet<&str> = of_bodies.chain(of_medium).collect();
        for (name, material) in self.scene.materials.iter().filter(|m| !used.contains(m.0.as_str())) {
            let message = format!("no body is made of the material `{name}`");
            self.warn(material.young.span(), message, "name it as the `material` of a body, or remove it");
        }
    }

    /// Reports keys of adaptive steps if the steps of all stages are equal.
    fn without_adaption(&mut self) {
        let (stages, time) = (&self.scene.stages, &self.scene.time);
        if stages.is_empty() || stages.iter().any(|s| s.steps.is_none()) {
            return;
        }
        let keys = [
            key("tolerance", time.tolerance.as_ref()),
            key("friction_tolerance", time.friction_tolerance.as_ref()),
            key("course_tolerance", time.course_tolerance.as_ref()),
            key("first_step", time.first_step.as_ref()),
        ];
        for (name, place) in keys.into_iter().flatten() {
            let message =
                format!("`{name}` is about steps that are adapted, and every stage has equal `steps`");
            self.warn(place, message, format!("remove `{name}`, or the `steps` of a stage"));
        }
    }

    /// Reports first and smallest steps that would be overridden by defaults of other bounds.
    fn beside_defaults(&mut self) {
        let time = &self.scene.time;
        let adaptive = self.scene.stages.iter().filter(|s| s.steps.is_none());
        let longest = adaptive.map(|s| s.duration.get_ref().0).fold(0.0, f64::max);
        if longest <= 0.0 {
            return;
        }
        let largest = defaults::LARGEST_STEP * longest;
        if let (Some(first), None) = (&time.first_step, &time.max_step)
            && first.get_ref().0 > largest * (1.0 + ROUNDING)
        {
            let message = format!(
                "`first_step` is {:?} s, but no step is longer than {largest:?} s, a twentieth of its stage",
                first.get_ref().0
            );
            self.warn(first.span(), message, "give `max_step` as well, or a shorter first step");
        }
        if let (Some(least), None) = (&time.min_step, &time.first_step)
            && least.get_ref().0 > defaults::FIRST_STEP * longest * (1.0 + ROUNDING)
        {
            let message = format!(
                "`min_step` is {:?} s, but the first step of each stage is a thousandth of it, {:?} s at most",
                least.get_ref().0,
                defaults::FIRST_STEP * longest
            );
            self.warn(least.span(), message, "give `first_step` as well, or a smaller `min_step`");
        }
    }

    /// Reports keys about slip in a scene without interfaces.
    fn without_interface(&mut self) {
        let time = &self.scene.time;
        if !self.scene.interfaces.is_empty() {
            return;
        }
        let keys = [
            key("tolerance", time.tolerance.as_ref()),
            key("friction_tolerance", time.friction_tolerance.as_ref()),
            key("rule", time.rule.as_ref()),
            key("rate_change", time.rate_change.as_ref()),
            key("zeta", time.zeta.as_ref()),
        ];
        for (name, place) in keys.into_iter().flatten() {
            let message = format!("`{name}` is about slip, and the scene has no interface");
            self.warn(
                place,
                message,
                format!("remove `{name}`; the length of steps is bounded by `max_step`, or given by `steps`"),
            );
        }
    }

    /// Reports keys that bound a quantity that no law of the scene has.
    fn without_law(&mut self) {
        let time = &self.scene.time;
        if self.scene.interfaces.is_empty() {
            return;
        }
        let laws = self.scene.interfaces.values().filter_map(|i| i.law.as_ref()?.get_ref().kind.as_ref());
        let kinds: Vec<&str> = laws.map(|k| k.get_ref().as_str()).collect();
        let keys = [
            (key("zeta", time.zeta.as_ref()), "characteristic slip", &WITH_LENGTH[..]),
            (key("rate_change", time.rate_change.as_ref()), "slip rate", &WITH_RATE[..]),
            (key("friction_tolerance", time.friction_tolerance.as_ref()), "slip rate", &WITH_RATE[..]),
            (key("slip_rate_limit", time.slip_rate_limit.as_ref()), "slip rate", &WITH_RATE[..]),
        ];
        for (given, what, owners) in keys {
            let Some((name, place)) = given.filter(|_| !kinds.iter().any(|k| owners.contains(k))) else {
                continue;
            };
            let message =
                format!("`{name}` is a bound on the {what} of a law, and no law of the scene has one");
            self.warn(place, message, format!("remove `{name}`; laws with one are {}", owners.join(" and ")));
        }
    }
}
