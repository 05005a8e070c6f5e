//! Faults through cycles whose ruptures have mass: the stepper "auto" in a scene with faults.

use super::Checker;
use crate::model::Stepper;

impl Checker<'_> {
    /// True if the scene has faults and the stepper is "auto".
    pub(super) fn has_ruptures(&self) -> bool {
        *self.scene.time.stepper.get_ref() == Stepper::Auto && !self.scene.faults.is_empty()
    }

    /// Checks what goes together with ruptures.
    pub(super) fn ruptures(&mut self) {
        self.stability();
        for fault in self.scene.faults.values() {
            self.direction_with_mass(fault);
        }
    }
}
