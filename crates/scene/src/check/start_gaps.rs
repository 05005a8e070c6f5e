//! Start gaps of interfaces that differ from those of the meshes.

use super::Checker;
use super::interfaces::is_tied;
use crate::model::Interface;

impl Checker<'_> {
    pub(super) fn start_gaps(&mut self, name: &str, interface: &Interface) {
        let Interface { adjust, clearance, .. } = interface;
        if let Some(clearance) = clearance {
            let gap = clearance.get_ref().0;
            if !(gap >= 0.0 && gap.is_finite()) {
                self.error(
                    clearance.span(),
                    format!("the `clearance` of interface `{name}` must not be negative"),
                    "it is a gap, such as `clearance = \"10 um\"`; bodies that are to press each other overlap in their meshes",
                );
            }
            if let Some(adjust) = adjust {
                let message = format!(
                    "interface `{name}` starts in contact by `adjust`, and with a gap by `clearance`"
                );
                let help = "keep one of the two: `adjust` is a clearance of 0";
                self.conflict(&clearance.span(), message, help, (&adjust.span(), "and here"));
            }
            if let Some(stress) = interface.initial_stress.as_ref().filter(|s| *s.get_ref() && gap > 0.0) {
                let message = format!(
                    "interface `{name}` starts open by `clearance`, and pressed by the initial stress"
                );
                let help = "an open interface has no tractions: remove `clearance`, or `initial_stress`";
                self.conflict(&clearance.span(), message, help, (&stress.span(), "and here"));
            }
        }
        let key = adjust.as_ref().map(|a| (a.span(), "adjust"));
        let given = key.or(clearance.as_ref().map(|c| (c.span(), "clearance")));
        if let (Some((place, key)), Some(law)) = (given, interface.law.as_ref().filter(|l| is_tied(l))) {
            let message = format!("interface `{name}` is tied, and `{key}` has no effect on it");
            let help = "tied points stay as far apart as they start, without stress: remove it";
            self.conflict(&place, message, help, (&law.span(), "the law"));
        }
    }
}
