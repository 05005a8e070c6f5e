//! Warnings about the results of a run of bodies.

use super::report::InterfaceResult;
use asperity_contact::TOUCH;
use asperity_mechanics::PlannedInterface;
use asperity_run::Warning;

/// Traction of a point that touches without load \[Pa\]: its penalty times the rounding of its gap in a scene of this size \[m\].
#[must_use]
pub fn rounding(interface: &PlannedInterface, scale: f64) -> f64 {
    TOUCH * scale * interface.normal_penalty
}

/// Warnings about interfaces that transmitted nothing at the end of any stage, in a scene of size `scale` \[m\].
#[must_use]
pub fn never_pressed(
    interfaces: &[PlannedInterface],
    scale: f64,
    results: &[InterfaceResult],
) -> Vec<Warning> {
    let doubt = |interface: &PlannedInterface| {
        let own = || results.iter().filter(|r| r.interface == interface.name);
        let floor = rounding(interface, scale);
        // Means over all points: a few that touch press nothing.
        let idle = |r: &InterfaceResult| {
            let [open, stick, slip] = r.status.map(|points| points as f64);
            let traction = r.mean_normal_traction.abs().max(r.mean_shear_traction.abs());
            traction * (stick + slip) <= floor * (open + stick + slip)
        };
        // Tractions of a bond may cancel.
        let bonded = interface.law.as_ref().is_some_and(|law| law.bonded());
        let what = if own().all(|r| r.status[1] + r.status[2] == 0) {
            "was open at the end of every stage and transmitted nothing"
        } else if !bonded && own().all(idle) {
            "was pressed by nothing at the end of every stage: its sides touch without traction"
        } else {
            return None;
        };
        Some(Warning::at(
            0..0,
            format!("interface `{}` {what}", interface.name),
            "is the gap at the start right, and do the bodies move towards each other?",
        ))
    };
    let mut sorted: Vec<_> = interfaces.iter().collect();
    sorted.sort_unstable_by_key(|interface| &interface.name);
    sorted.into_iter().filter_map(doubt).collect()
}

/// Warning about a stage that ends in an unstable equilibrium.
pub fn unstable(stage: &str) -> Warning {
    let message = format!(
        "stage `{stage}` ends in an unstable equilibrium: the stiffness of its bodies is not positive definite, as beyond buckling or \
         collapse, and what they would do instead depends on the least disturbance"
    );
    Warning::at(
        0..0,
        message,
        "less load, a displacement in the place of a load, shorter steps that follow the other branch, or `inertia`",
    )
}
