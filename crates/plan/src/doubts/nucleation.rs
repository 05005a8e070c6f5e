//! Surfaces too short for slip to nucleate on them.

use asperity_run::Warning;
use asperity_scene::lengths::brief;
use std::ops::Range;

/// Nucleation length over the extent of what slides above which a unit is probably wrong: units differ by a thousand, while small
/// specimens that creep on purpose have lengths of some tens of their size.
const LONG: f64 = 100.0;

/// The same for a fault in rock whose events are asked for. Estimates of the length differ by less. A spring may make all of a
/// specimen unstable at once, rock does not.
const LONG_IN_ROCK: f64 = 2.0;

/// Warning about a surface on which slip nucleates over `length`, if what slides of it reaches over `extent` only \[m\]. `rock` is true if
/// events are asked for on a fault that rock alone drives.
#[must_use]
pub fn nucleation(
    surface: &str,
    place: Range<usize>,
    [length, extent]: [f64; 2],
    rock: bool,
) -> Option<Warning> {
    let long = if rock { LONG_IN_ROCK } else { LONG };
    (extent > 0.0 && length > long * extent).then(|| {
        let message = format!(
            "slip nucleates over {} on {surface}, {:.3e} times the {} over which it slides: it creeps or follows its loads, and no event begins",
            brief(length),
            length / extent,
            brief(extent)
        );
        Warning::at(place, message, "check the units of `l` or `d_c`, of `normal` and of `young`; or a longer surface")
    })
}
