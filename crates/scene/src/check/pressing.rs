//! Faults whose bodies are pressed in a stage before they slide.

use super::Checker;
use crate::model::{Fault, Motion, Scene, Spanned, Stage, Stepper};
use crate::suggestions::suggest;

/// The stage that presses bodies before their faults slide, if the scene has one.
#[must_use]
pub fn stage(scene: &Scene) -> Option<&Stage> {
    let cycles = !scene.faults.is_empty() && *scene.time.stepper.get_ref() != Stepper::Explicit;
    (cycles && scene.stages.len() > 1).then(|| &scene.stages[0])
}

impl Checker<'_> {
    /// Checks the stages of a scene with faults that slide through cycles: the last is theirs, and one before it may press the bodies.
    pub(super) fn stages_of_faults(&mut self, fault: &Fault) {
        let scene = self.scene;
        if let Some(third) = scene.stages.get(2) {
            self.error(
                third.duration.span(),
                format!(
                    "a scene with faults has one stage, or one that presses the bodies and one in which the faults slide; found {}",
                    scene.stages.len()
                ),
                "motions that change with time are tables",
            );
        }
        for name in
            scene.stages.iter().skip(usize::from(scene.stages.len() > 1)).flat_map(|s| &s.frictionless)
        {
            self.error(
                name.span(),
                "a fault is frictionless in a stage in which it slides by its law",
                "`frictionless` is for a stage before, in which the bodies are pressed",
            );
        }
        let Some(pressing) = stage(scene) else { return };
        if self.is_antiplane() || scene.medium.is_some() {
            let what = if self.is_antiplane() {
                "in antiplane motion, where bodies move out of the plane only"
            } else {
                "in homogeneous rock without bodies"
            };
            self.conflict(
                &pressing.duration.span(),
                format!("stage `{}` presses nothing {what}", pressing.name),
                "one stage, and `normal` at the fault",
                (&fault.span(), "a fault"),
            );
        }
        self.springs_while_pressing(pressing);
        for name in &pressing.frictionless {
            if !scene.faults.contains_key(name.get_ref()) {
                let known = scene.faults.keys().map(String::as_str);
                self.error(
                    name.span(),
                    format!("there is no fault `{}`", name.get_ref()),
                    suggest(name.get_ref(), "faults", known),
                );
            }
        }
    }

    /// Refuses springs in a stage that presses: nothing slides yet, and a spring would only carry what its load point prescribes.
    fn springs_while_pressing(&mut self, pressing: &Stage) {
        for condition in &pressing.conditions {
            let c = condition.get_ref();
            let motions = [&c.x, &c.y, &c.z].into_iter().flatten();
            for motion in motions.filter(|m| matches!(m.get_ref(), Motion::Spring { .. })) {
                self.error(
                    motion.span(),
                    format!(
                        "a spring loads a side in stage `{}`, in which faults do not slide yet",
                        pressing.name
                    ),
                    "hold the side there: the spring of the next stage takes over the force",
                );
            }
        }
    }

    /// Refuses tractions of a fault that a pressing stage determines.
    pub(super) fn tractions_beside_pressing(
        &mut self,
        normal: Option<std::ops::Range<usize>>,
        fault: &Fault,
    ) {
        if self.is_antiplane() || self.scene.medium.is_some() {
            return;
        }
        let Some(pressing) = stage(self.scene) else { return };
        let sides = [&fault.minus, &fault.plus].map(|side| self.scene.body_of(side));
        let stress = sides.into_iter().flatten().find_map(|b| b.initial_stress.as_ref());
        let keys = [("normal", normal), ("initial_stress", stress.map(Spanned::span))];
        for (key, place) in keys.into_iter().filter_map(|(key, place)| Some((key, place?))) {
            self.conflict(
                &place,
                format!(
                    "`{key}` is given together with stage `{}`, which determines the same traction",
                    pressing.name
                ),
                format!("remove `{key}`, or the stage"),
                (&pressing.duration.span(), "the stage"),
            );
        }
    }
}
