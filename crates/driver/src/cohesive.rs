//! Spacing of the points of an interface of bodies beside the cohesive zone of its friction.
//!
//! The zone is as long as f_n is small ([`crate::fault::Ground`]), and f_n is known once bodies are pressed: the plan says up to which f_n the points
//! resolve it. Where loads alone press a flat interface their mean is known before, and judged then. Otherwise a run stops where a point slides
//! under so much that less than one point stands on the zone, and the end of each stage warns of less than three.

use crate::fault::{ENOUGH, FEW};
use crate::warning::Warning;
use asperity_mechanics::Resolved;

/// Content of the plan.
#[must_use]
pub fn remark(resolved: &Resolved, interface: &str) -> String {
    format!(
        "interface `{interface}`: points at most {:.4e} m apart are three to the cohesive zone under {:.4} MPa of normal traction, and one under {:.4} MPa",
        resolved.spacing,
        resolved.one / ENOUGH / 1e6,
        resolved.one / 1e6
    )
}

/// A warning where the largest normal traction \[Pa\] at the end of a stage leaves too few points.
#[must_use]
pub fn warning(resolved: &Resolved, interface: &str, stage: &str, largest: f64) -> Option<Warning> {
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

/// Expression of three points.
#[must_use]
pub fn enough(resolved: &Resolved, normal: f64) -> String {
    format!("points {:.4e} m apart give three", resolved.spacing * resolved.one / normal / ENOUGH)
}
