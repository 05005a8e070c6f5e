//! Place where the state or the rates of a fault are not finite.

use asperity_mechanics::coordinates;
use asperity_plan::faults::Plan;

/// The first point with a state, or with tractions that slip causes, that are no numbers; `None` if all are finite.
pub(super) fn place(plan: &Plan, unknowns: &[f64]) -> Option<String> {
    let (operator, points) = (&plan.problem.fault.operator, plan.points.len());
    if let Some(at) = unknowns.iter().position(|v| !v.is_finite()) {
        return Some(format!("the state at {} is {}", describe_point(plan, at % points)?, unknowns[at]));
    }
    let slip = vec![1.0; points * operator.components()];
    let (shear, normal) = (operator.shear_of(&slip), operator.normal_of(&slip));
    let at = shear.iter().chain(&normal).position(|v| !v.is_finite())?;
    let point = describe_point(plan, at % points)?;
    Some(format!(
        "the tractions that slip causes at {point} are not finite: cells of faults lie on each other there"
    ))
}

/// Fault and position of a point.
fn describe_point(plan: &Plan, point: usize) -> Option<String> {
    let view = plan.points.get(point)?;
    let fault = plan.faults.iter().find(|f| f.points.contains(&point))?;
    Some(format!("the point of fault `{}` at {}", fault.name, coordinates::in_words(&view.at)))
}
