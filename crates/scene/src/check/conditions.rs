//! Stages and their conditions: references, and contradictions between conditions on the same nodes.

use super::course::Course;
use super::interfaces::is_tied;
use super::starts::PresentLoads;
use super::{AXES, Checker};
use crate::diagnostic::Diagnostic;
use crate::model::{Condition, Loading, Motion, Pace, RotationSpec, Spanned, Stage, TimeSeries};
use crate::suggestions::suggest;
use std::collections::BTreeMap;
use std::ops::Range;

/// A prescribed component of a set.
#[derive(Clone, Debug)]
struct Entry {
    set: String,
    axis: usize,
    motion: Motion,
    place: Range<usize>,
    symmetry: bool,
}

/// Kind of the entries of a table.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// Displacements or loads, which do not jump.
    Values,
    /// Rates, which may.
    Rates,
}

impl Kind {
    /// True if an entry may not follow one at the time before it.
    fn disordered(self, before: f64, time: f64) -> bool {
        if self == Self::Rates { time < before } else { time <= before }
    }
}

/// Prescribed components, carried from stage to stage.
#[derive(Default)]
struct PrescribedComponents {
    entries: BTreeMap<(String, usize), Entry>,
    /// Displacement of each component that has been prescribed; `None` if unknown, as after a release.
    present: BTreeMap<(String, usize), Option<f64>>,
    /// Pairs of sets, with the axis, whose contradiction has been reported.
    told: Vec<(String, String, usize)>,
}

impl PrescribedComponents {
    /// Displacement of a component at the start of a stage, if known.
    fn start(&self, entry: &Entry, first: bool) -> Option<f64> {
        let key = (entry.set.clone(), entry.axis);
        self.present.get(&key).copied().unwrap_or(first.then_some(0.0))
    }

    /// Courses of two entries at their shared nodes. If the start of one entry is unknown, that of the other is used.
    fn courses(&self, a: &Entry, b: &Entry, (first, duration): (bool, f64)) -> (Course, Course) {
        let (from_a, from_b) = (self.start(a, first), self.start(b, first));
        (
            Course::new(&a.motion, from_a.or(from_b), duration),
            Course::new(&b.motion, from_b.or(from_a), duration),
        )
    }

    /// Ends a stage. Targets that have been reached are held from now on.
    fn settle(&mut self, first: bool, duration: f64) {
        let ends: Vec<_> = self
            .entries
            .iter()
            .map(|(key, entry)| {
                let course = Course::new(&entry.motion, self.start(entry, first), duration);
                (key.clone(), course.at(duration))
            })
            .collect();
        self.present.extend(ends);
        for entry in self.entries.values_mut() {
            entry.motion = entry.motion.clone().carried_on();
        }
    }
}

/// Admissible excess of a table past the end of its stage, relative to the duration: rounding of decimal input.
const ROUNDING: f64 = 1e-9;
/// Largest number of equal steps, a thousand times that of a long run. More are a typing error.
const MOST_STEPS: usize = 10_000_000;

impl Checker<'_> {
    pub(super) fn stages(&mut self) {
        if self.scene.stages.is_empty() {
            self.error(
                self.scene.time.stepper.span(),
                "the scene has no stages",
                "add `[[stages]]` with a `duration`",
            );
        }
        let (mut prescribed, mut loaded) = (PrescribedComponents::default(), PresentLoads::default());
        for (index, stage) in self.scene.stages.iter().enumerate() {
            self.stage(index, stage);
            let mut fresh = Vec::new();
            for condition in &stage.conditions {
                self.condition(stage, condition, &mut fresh);
            }
            self.twice(stage, &fresh);
            for entry in &fresh {
                let present = prescribed.start(entry, index == 0);
                self.begins(stage, &entry.set, entry.axis, &entry.motion, &entry.place, present);
                self.speed(stage, (&entry.set, entry.axis), &entry.motion, &entry.place, present);
                prescribed.entries.insert((entry.set.clone(), entry.axis), entry.clone());
            }
            self.loads_begin(stage, &mut loaded);
            let duration = stage.duration.get_ref().0;
            self.shared_nodes(stage, &fresh, &mut prescribed, (index == 0, duration));
            self.loads(stage, &prescribed);
            self.absorbing(stage);
            prescribed.settle(index == 0, duration);
        }
    }

    fn stage(&mut self, index: usize, stage: &Stage) {
        let name = &stage.name;
        if stage.duration.get_ref().0 <= 0.0 {
            self.error(
                stage.duration.span(),
                format!("the duration of stage `{name}` must be positive"),
                "such as `duration = \"10 s\"`",
            );
        }
        if self.scene.stages[..index].iter().any(|s| s.name == *name) {
            self.error(
                stage.duration.span(),
                format!("there are two stages named `{name}`"),
                "results are named after stages: give each its own name",
            );
        }
        if let Some(steps) = stage.steps.as_ref().filter(|s| *s.get_ref() == 0) {
            self.error(
                steps.span(),
                "`steps` must be at least 1",
                "or leave it out, and the steps are adapted",
            );
        }
        if name.trim().is_empty() {
            self.error(stage.duration.span(), "a stage has no name", "such as `name = \"press\"`");
        }
        if let Some(steps) = stage.steps.as_ref().filter(|s| *s.get_ref() > MOST_STEPS) {
            self.too_many(steps, "steps", MOST_STEPS);
        }
        // Those of a stage that presses faults are faults.
        for interface in stage.frictionless.iter().filter(|_| self.scene.faults.is_empty()) {
            if !self.scene.interfaces.contains_key(interface.get_ref()) {
                let known = self.scene.interfaces.keys().map(String::as_str);
                self.error(
                    interface.span(),
                    format!("there is no interface `{}`", interface.get_ref()),
                    suggest(interface.get_ref(), "interfaces", known),
                );
            }
            let law = self.scene.interfaces.get(interface.get_ref()).and_then(|i| i.law.as_ref());
            if let Some(law) = law.filter(|law| is_tied(law)) {
                self.conflict(
                    &interface.span(),
                    format!("interface `{}` is tied and has no friction to leave out", interface.get_ref()),
                    "remove it from `frictionless`",
                    (&law.span(), "the law"),
                );
            }
            let form = law.and_then(|law| law.get_ref().form.as_ref());
            if let Some(form) = form.filter(|form| form.get_ref() == "bare") {
                self.warn(
                    form.span(),
                    format!(
                        "the bare logarithm has no value at rest, and interface `{}` may rest when it begins to resist after stage `{}`",
                        interface.get_ref(),
                        stage.name
                    ),
                    "`form = \"regularised\"` is regular at rest",
                );
            }
        }
    }

    fn condition(&mut self, stage: &Stage, condition: &Spanned<Condition>, fresh: &mut Vec<Entry>) {
        let c = condition.get_ref();
        let Some(set) = &c.set else {
            self.error(
                condition.span(),
                format!("a condition of stage `{}` names no set", stage.name),
                "add `set = \"body.side\"`",
            );
            return;
        };
        let side = self.set(set);
        let symmetric = c.symmetry.as_ref().is_some_and(|s| *s.get_ref());
        let motions = [&c.x, &c.y, &c.z];
        let moved = motions.iter().any(|m| m.is_some()) || symmetric || c.rotate.is_some();
        if !moved && c.traction.is_none() && c.pressure.is_none() && c.absorbing.is_none() {
            self.error(
                condition.span(),
                format!("the condition on `{}` prescribes nothing", set.get_ref()),
                "add a motion such as `x = 0`, `symmetry = true`, a `traction` or a `pressure`",
            );
        }
        for (axis, motion) in motions.into_iter().enumerate() {
            let Some(motion) = motion else { continue };
            if !self.motions().contains(&axis) {
                continue;
            }
            match motion.get_ref() {
                Motion::Table(points) => self.table(points, motion.span(), stage, Kind::Values),
                Motion::Rate(Pace::Table(points)) | Motion::Spring { rate: Pace::Table(points), .. } => {
                    self.table(points, motion.span(), stage, Kind::Rates);
                    self.ramps(points, motion.span());
                }
                _ => {}
            }
            let (motion, place) = (motion.get_ref().clone(), motion.span());
            fresh.push(Entry { set: set.get_ref().clone(), axis, motion, place, symmetry: false });
        }
        if let Some(rotate) = &c.rotate {
            self.rotation(set, rotate, fresh);
        }
        if let (true, Some((_, axis, _)), Some(symmetry)) =
            (symmetric && !self.is_antiplane(), side, &c.symmetry)
        {
            let (motion, place) = (Motion::Fixed(0.0), symmetry.span());
            fresh.push(Entry { set: set.get_ref().clone(), axis, motion, place, symmetry: true });
        }
        self.load_values(stage, c);
    }

    /// Checks a rotation, which only bodies with finite strain can follow.
    fn rotation(&mut self, set: &Spanned<String>, rotate: &Spanned<RotationSpec>, fresh: &mut Vec<Entry>) {
        let spec = rotate.get_ref();
        let plane = self.dimension() == 2;
        self.count(&spec.about, "about", &(0..self.dimension()).collect::<Vec<_>>());
        match (&spec.axis, plane) {
            (Some(axis), false) if !axis.get_ref().iter().map(|a| a * a).sum::<f64>().is_normal() => {
                self.error(
                    axis.span(),
                    "the axis of the rotation has no direction",
                    "such as `axis = [0, 0, 1]`",
                );
            }
            (None, false) => self.error(
                rotate.span(),
                "a rotation in three dimensions needs an axis",
                "add its direction, such as `axis = [0, 0, 1]`",
            ),
            _ => {}
        }
        let body = set.get_ref().split('.').next().and_then(|b| Some((b, self.scene.bodies.get(b)?)));
        if let Some((name, _)) = body.filter(|(_, b)| !b.is_finite()) {
            self.error(
                rotate.span(),
                format!("body `{name}` has small strain, which takes a rotation for deformation"),
                format!("add `strain = \"finite\"` to body `{name}`"),
            );
        }
        for axis in 0..self.dimension() {
            let (set, motion, place) = (set.get_ref().clone(), spec.motion(), rotate.span());
            fresh.push(Entry { set, axis, motion, place, symmetry: false });
        }
    }

    fn load_values(&mut self, stage: &Stage, c: &Condition) {
        if let Some(traction) = &c.traction {
            self.count(traction, "traction", &self.motions());
        }
        let tractions = c.traction.iter().flat_map(|t| t.get_ref().iter().map(|l| (l, t.span())));
        let pressures = c.pressure.iter().map(|p| (p.get_ref(), p.span()));
        for (loading, place) in tractions.chain(pressures) {
            if let Loading::Table(points) = loading {
                self.table(points, place, stage, Kind::Values);
            }
        }
    }

    /// Checks that a table lies within its stage. Values past the end would be lost silently, or taken as reached.
    fn table(&mut self, points: &TimeSeries, place: Range<usize>, stage: &Stage, kind: Kind) {
        let duration = stage.duration.get_ref().0;
        if points.len() < 2 {
            self.error(
                place,
                format!("a table needs at least 2 points, found {}", points.len()),
                "such as `table = [[\"0 s\", 0], [\"10 s\", \"1 mm\"]]`",
            );
        } else if let Some(w) = points.windows(2).find(|w| kind.disordered(w[0].0, w[1].0)) {
            self.error(
                place,
                format!("the times of the table do not increase: {:?} s follows {:?} s", w[1].0, w[0].0),
                "times count from the start of the stage and increase",
            );
        } else if let Some(w) = points.windows(3).find(|w| w[2].0 == w[0].0) {
            self.error(
                place,
                format!("the table has three entries at {:?} s", w[0].0),
                "a step of a rate has two: the rate before and the one after",
            );
        } else if let Some((time, _)) = points.first().filter(|p| p.0 < 0.0) {
            self.error(
                place,
                format!("the table begins at {time:?} s, before its stage"),
                "times count from the start of the stage: begin at 0",
            );
        } else if let Some((time, _)) = points.last().filter(|p| p.0 > duration * (1.0 + ROUNDING)) {
            let message = format!(
                "the table extends to {time:?} s, but stage `{}` ends after {duration:?} s",
                stage.name
            );
            let help = match points.file() {
                Some(_) => {
                    "`from` takes the part of a record that belongs to the stage, such as `from = 0`; or lengthen the stage"
                }
                None => {
                    "times count from the start of the stage: end the table with it, or lengthen the stage"
                }
            };
            self.errors
                .push(Diagnostic::at(place, message, help).and(stage.duration.span(), "the stage ends"));
        }
    }

    /// Refuses rates that change gradually on faults, whose loads change at constant rates between two entries.
    fn ramps(&mut self, points: &[(f64, f64)], place: Range<usize>) {
        let ramp = points.windows(2).find(|w| w[1].0 > w[0].0 && w[1].1 != w[0].1);
        if let Some(w) = ramp.filter(|_| !self.scene.faults.is_empty() && !self.has_waves()) {
            self.error(
                place,
                format!("the rate changes gradually from {:?} s to {:?} s, and loads of faults change in steps of their rates", w[0].0, w[1].0),
                "two entries at one time make a step: `[[\"0 s\", \"1 um/s\"], [\"10 s\", \"1 um/s\"], [\"10 s\", \"3 um/s\"]]`",
            );
        }
    }

    /// Reports components and loads of a set that are prescribed twice in a stage.
    fn twice(&mut self, stage: &Stage, fresh: &[Entry]) {
        for (i, second) in fresh.iter().enumerate() {
            let Some(first) = fresh[..i].iter().find(|f| f.set == second.set && f.axis == second.axis) else {
                continue;
            };
            let (set, axis, name) = (&second.set, AXES[second.axis], &stage.name);
            let (before, after) =
                if first.place.start > second.place.start { (second, first) } else { (first, second) };
            let (message, help) = if first.symmetry != second.symmetry {
                (
                    format!("`{set}` has symmetry and a motion in {axis}, its normal, in stage `{name}`"),
                    format!("symmetry is `{axis} = 0`: remove one of the two"),
                )
            } else {
                let message = format!("{axis} of `{set}` is prescribed twice in stage `{name}`");
                (message, "remove one of the two".into())
            };
            self.conflict(&after.place, message, help, (&before.place, "and here"));
        }
        let mut seen: Vec<((&str, &str), Range<usize>)> = Vec::new();
        for condition in &stage.conditions {
            let c = condition.get_ref();
            let Some(set) = &c.set else { continue };
            let traction = c.traction.as_ref().map(|t| ("traction", t.span()));
            let pressure = c.pressure.as_ref().map(|p| ("pressure", p.span()));
            for (what, place) in traction.into_iter().chain(pressure) {
                let key = (set.get_ref().as_str(), what);
                if let Some((_, before)) = seen.iter().find(|s| s.0 == key) {
                    let message =
                        format!("the {what} on `{}` is prescribed twice in stage `{}`", key.0, stage.name);
                    self.conflict(&place, message, "remove one of the two", (before, "and here"));
                }
                seen.push((key, place));
            }
        }
    }

    /// Reports sides of a body that meet at an edge or corner and prescribe different motions of its nodes.
    fn shared_nodes(
        &mut self,
        stage: &Stage,
        fresh: &[Entry],
        prescribed: &mut PrescribedComponents,
        (first, duration): (bool, f64),
    ) {
        let mut found = Vec::new();
        for (i, entry) in fresh.iter().enumerate() {
            for other in prescribed.entries.values().filter(|o| self.share_component(entry, o)) {
                // If both entries of a pair are new in this stage, the pair is reported once, at the later entry.
                let later = fresh[i + 1..].iter().any(|f| f.set == other.set && f.axis == other.axis);
                let pair = (
                    entry.set.clone().min(other.set.clone()),
                    entry.set.clone().max(other.set.clone()),
                    entry.axis,
                );
                let (a, b) = prescribed.courses(other, entry, (first, duration));
                if !later && !a.agrees(&b, duration) && !prescribed.told.contains(&pair) {
                    found.push((pair, entry, other.clone(), (a, b)));
                }
            }
        }
        for (pair, entry, other, (a, b)) in found {
            let (set, axis, name) = (&entry.set, AXES[entry.axis], &stage.name);
            prescribed.told.push(pair);
            let message = format!(
                "`{}` and `{set}` share nodes and prescribe {axis} there differently in stage `{name}`",
                other.set
            );
            let help = format!(
                "`{}` prescribes {}, `{set}` {}: say the same on both, or release one with `{axis} = \"free\"`",
                other.set,
                a.words(),
                b.words()
            );
            self.conflict(&entry.place, message, help, (&other.place, "and here"));
        }
    }

    /// True if two entries prescribe the same component of common nodes.
    fn share_component(&self, a: &Entry, b: &Entry) -> bool {
        let free = a.motion == Motion::Free || b.motion == Motion::Free;
        a.axis == b.axis && !free && self.meet(&a.set, &b.set)
    }

    /// True if two sides belong to the same body and share an edge or corner.
    fn meet(&self, a: &str, b: &str) -> bool {
        match (self.block_side(a), self.block_side(b)) {
            (Some((a, i, _)), Some((b, j, _))) => a == b && i != j,
            _ => false,
        }
    }

    /// Reports loads on components with prescribed motion, which would have no effect.
    fn loads(&mut self, stage: &Stage, prescribed: &PrescribedComponents) {
        for condition in &stage.conditions {
            let c = condition.get_ref();
            let Some(set) = &c.set else { continue };
            let mut loaded: Vec<(usize, &str, Range<usize>)> = Vec::new();
            if let Some(t) = &c.traction {
                let entries = self.motions().into_iter().zip(t.get_ref());
                let acting = entries.filter(|(_, l)| **l != Loading::Fixed(0.0));
                loaded.extend(acting.map(|(axis, _)| (axis, "traction", t.span())));
            }
            if let (Some(p), Some((_, axis, _))) = (&c.pressure, self.block_side(set.get_ref())) {
                loaded.push((axis, "pressure", p.span()));
            }
            for (axis, what, place) in loaded {
                let entry = prescribed.entries.get(&(set.get_ref().clone(), axis));
                let Some(entry) = entry.filter(|e| e.motion != Motion::Free) else { continue };
                let (set, axis) = (set.get_ref(), AXES[axis]);
                let message = format!(
                    "`{set}` has both a {what} and a prescribed motion in {axis} in stage `{}`, so the {what} would \
                     do nothing",
                    stage.name
                );
                let help = format!(
                    "remove one of the two; `{axis} = \"free\"` releases a motion of an earlier stage"
                );
                self.conflict(&place, message, help, (&entry.place, "the motion"));
            }
        }
    }
}
