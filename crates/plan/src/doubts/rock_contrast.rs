//! Waves along a surface between unlike rocks.

use asperity_run::Warning;
use std::ops::Range;

/// Relative difference of moduli below which both sides are the same rock: rounding of given values.
const SAME: f64 = 1e-6;

/// Warning about a fault between rocks whose shear moduli differ by the share `contrast`, and whose friction follows the normal
/// traction at once: slip changes normal traction there, and the problem is ill-posed (Ranjith & Rice 2001; Cochard & Rice 2000).
#[must_use]
pub fn unlike(fault: &str, place: Range<usize>, contrast: f64, delays: bool) -> Option<Warning> {
    // Half the relative difference is that over the sum.
    (contrast > SAME).then(|| {
        let message = format!(
            "the rocks at fault `{fault}` differ by {:.1} % in shear modulus, and friction follows the normal traction at once: slip on every wavelength \
             may grow, and results depend on the cells",
            2e2 * contrast
        );
        let help = match delays {
            true => "`normal_delay = { length = \"0.2 m\", rate = \"1 m/s\" }` at the fault, and compare two sizes of cells",
            false => "compare two sizes of cells; only the stepper \"explicit\" has a `normal_delay`",
        };
        Warning::at(place, message, help)
    })
}
