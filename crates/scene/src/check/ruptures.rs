//! Faults through cycles whose ruptures have mass: the stepper "auto" in a scene with faults.

use super::Checker;
use super::apart::{PROCESSES, process};
use crate::model::{Fault, Spanned, Stepper};

impl Checker<'_> {
    /// True if the scene has faults and the stepper is "auto".
    pub(super) fn has_ruptures(&self) -> bool {
        *self.scene.time.stepper.get_ref() == Stepper::Auto && !self.scene.faults.is_empty()
    }

    /// Checks what goes together with ruptures.
    pub(super) fn ruptures(&mut self) {
        let scene = self.scene;
        self.stability();
        if let Some(medium) = &scene.medium {
            self.conflict(
                &medium.material.span(),
                "waves run in bodies, and `[medium]` is rock without bodies",
                "a body with `mesh.fault` around the fault, or `stepper = \"fault-ode\"`",
                (&scene.time.stepper.span(), "the stepper"),
            );
        }
        for fault in scene.faults.values() {
            self.direction_with_mass(fault);
            self.without_company(fault);
        }
    }

    /// Refuses what a fault cannot do in ruptures with mass.
    fn without_company(&mut self, fault: &Fault) {
        let changes = fault.normal_changes.as_ref().map(Spanned::span);
        // An opening in antiplane motion is refused as such.
        let keys = PROCESSES.into_iter().filter(|key| *key != "opening" || !self.is_antiplane());
        let places = keys.filter_map(|key| Some((key, process(fault, key)?)));
        let places: Vec<_> = places.chain(changes.map(|place| ("normal_changes", place))).collect();
        for (key, place) in places {
            self.conflict(
                &place,
                format!("`{key}` of a fault whose ruptures have mass"),
                "remove it, or use `stepper = \"fault-ode\"`, whose ruptures have no mass",
                (&self.scene.time.stepper.span(), "the stepper"),
            );
        }
    }
}
