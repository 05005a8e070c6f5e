//! Damping that is far from what rock radiates.

use asperity_run::Warning;
use std::ops::Range;

/// Factor by which a damping may differ from that of radiation. Studies vary it by a factor of a few; a unit that is left out makes
/// a million.
const FAR: f64 = 10.0;

/// Warning about a damping `given` \[Pa s/m\] of a surface whose points radiate `radiated`, as far as densities are known.
#[must_use]
pub fn damping(
    surface: &str,
    place: Range<usize>,
    given: f64,
    radiated: impl IntoIterator<Item = Option<f64>>,
) -> Option<Warning> {
    let known = radiated.into_iter().flatten();
    let range = known.fold(None, |range: Option<[f64; 2]>, z| {
        Some(range.map_or([z; 2], |[low, high]| [low.min(z), high.max(z)]))
    });
    let [least, most] = range?;
    let off = if given < least { least / given } else { given / most };
    (given > 0.0 && off > FAR).then(|| {
        let message = format!(
            "the damping of {surface} is {given:e} Pa s/m, and its rock radiates {least:.4e} Pa s/m, G/(2 c_s): slip rates in events go with its inverse"
        );
        let help = "`damping = \"radiation\"`, or check the unit, such as `damping = \"4.6 MPa s/m\"`";
        Warning::at(place, message, help)
    })
}
