//! Start gaps that are not those of the meshes.

use super::Interface;
use crate::shift::GapShift;

impl<const D: usize> Interface<D> {
    /// Subtracts constants from the gaps of all points \[m\]. Must be called before the first step, and before
    /// [`Interface::press`].
    pub fn shift(&mut self, by: &[f64]) {
        let mut partings = Vec::new();
        self.measure.partings(&self.geometry, &mut partings);
        self.shift = Some(GapShift::new(by, &self.geometry.gap, &partings));
        self.enforce();
        self.contact.committed.copy_from_slice(&self.contact.trial);
        self.renew_multipliers();
        self.refresh();
    }

    /// Updates the gaps that contact counts to the geometry last measured.
    pub(crate) fn count_gaps(&mut self) {
        if let Some(shift) = &mut self.shift {
            shift.count(self.measure.as_ref(), &self.geometry);
        }
    }

    /// Gap that contact counts at the geometry last measured.
    pub(crate) fn gap(&self, p: usize) -> f64 {
        self.shift.as_ref().map_or(self.geometry.gap[p], |shift| shift.gap(p))
    }
}
