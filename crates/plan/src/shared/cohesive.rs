//! Point spacing of an interface between bodies, compared with the cohesive zone of its friction.
//!
//! The length of the zone is inversely proportional to f_n ([`crate::shared::resolution::Ground`]), and f_n is known only once the bodies are pressed. The
//! checks of the plan therefore state the f_n under which one point is left. If loads alone press a flat interface, the mean f_n is known in advance and is
//! checked in the plan. Otherwise a run stops if a point slides under an f_n so large that the zone holds less than one point. The end of each stage
//! warns if the zone holds fewer than three.

use crate::shared::resolution::{ENOUGH, FEW};
use asperity_mechanics::ZoneResolution;
use asperity_run::Warning;

/// Warning if the largest normal traction \[Pa\] at the end of a stage leaves too few points.
#[must_use]
pub fn warning(resolved: &ZoneResolution, interface: &str, stage: &str, largest: f64) -> Option<Warning> {
    let points = resolved.one / largest;
    (largest > 0.0 && points < FEW).then(|| {
        Warning::at(
            resolved.place.clone(),
            format!(
                "interface `{interface}` is pressed with up to {:.4} MPa at the end of stage `{stage}`, where {points:.2} points stand on the cohesive zone: fronts of slip follow the \
                 mesh",
                largest / 1e6
            ),
            enough(resolved, largest),
        )
    })
}

/// Advice on the spacing that gives three points.
#[must_use]
pub fn enough(resolved: &ZoneResolution, normal: f64) -> String {
    format!("points {:.4e} m apart give three", resolved.spacing * resolved.one / normal / ENOUGH)
}
