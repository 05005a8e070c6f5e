//! Surfaces too short for slip to nucleate on them.

use asperity_run::Warning;
use asperity_scene::lengths::brief;
use std::ops::Range;

/// Nucleation length over the extent of what slides above which a unit is probably wrong: units differ by a thousand, while small
/// specimens that creep on purpose have lengths of some tens of their size.
const LONG: f64 = 100.0;

/// Warning about a surface on which slip nucleates over `length`, if what slides of it reaches over `extent` only \[m\].
#[must_use]
pub fn nucleation(surface: &str, place: Range<usize>, length: f64, extent: f64) -> Option<Warning> {
    (extent > 0.0 && length > LONG * extent).then(|| {
        let message = format!(
            "slip nucleates over {} on {surface}, {:.3e} times the {} over which it slides: it creeps or follows its loads, and no event begins",
            brief(length),
            length / extent,
            brief(extent)
        );
        Warning::at(place, message, "check the units of `l` or `d_c`, of `normal` and of `young`; or a longer surface")
    })
}
