//! Ruptures that are forced to begin.

use super::Checker;
use crate::model::Fault;

/// The law whose friction a forced rupture weakens.
const LAW: &str = "slip-weakening";

impl Checker<'_> {
    /// Checks the forced rupture of a fault.
    pub(super) fn forced(&mut self, fault: &Fault) {
        let Some(forced) = &fault.forced_rupture else { return };
        let kind = fault.law.get_ref().kind.as_ref();
        if let Some(kind) = kind.filter(|kind| kind.get_ref() != LAW) {
            self.conflict(
                &forced.centre.span(),
                format!("`forced_rupture` of a fault with a law of kind \"{}\"", kind.get_ref()),
                "`kind = \"slip-weakening\"`, whose friction it lets fall; or start the rupture by `pulses`",
                (&kind.span(), "the law"),
            );
        }
        let axes: Vec<usize> = (0..self.dimension()).collect();
        self.count(&forced.centre, "centre", &axes);
        for (key, place, value, example) in [
            ("radius", forced.radius.span(), forced.radius.get_ref().0, "4 km"),
            ("speed", forced.speed.span(), forced.speed.get_ref().0, "2425 m/s"),
            ("duration", forced.duration.span(), forced.duration.get_ref().0, "0.5 s"),
        ] {
            if !(value > 0.0 && value.is_finite()) {
                let help = format!("such as `{key} = \"{example}\"`");
                self.error(place, format!("`{key}` of a forced rupture must be positive"), help);
            }
        }
    }
}
