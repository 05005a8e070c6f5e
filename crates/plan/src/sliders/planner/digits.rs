//! Tolerances below the digits of the unknowns.

use crate::reading::scene::slider::SliderScene;
use crate::sliders::Plan;
use asperity_run::Warning;

/// Rounding of an unknown, in units of its last digit, up to which steps gain from a tighter tolerance.
const DIGITS: f64 = 8.0;

/// Warns of a tolerance below what the digits of the unknowns resolve.
pub(super) fn unresolved(scene: &SliderScene, plan: &mut Plan) {
    let problem = &plan.problem;
    let sizes = problem.start.iter().zip(problem.system.scales()).map(|(value, scale)| value.abs() / scale);
    let largest = sizes.fold(0.0, f64::max);
    let least = DIGITS * f64::EPSILON * largest;
    let Some(asked) = scene.time.tolerance.as_ref().filter(|asked| *asked.get_ref() < least) else { return };
    let message = format!(
        "`tolerance` is {:e}, and an unknown of {largest:.3} has digits to {:.0e}: friction over a and states are not resolved to it",
        asked.get_ref(),
        f64::EPSILON * largest
    );
    let help = format!("steps below {least:.0e} are shorter and no better");
    plan.warnings.push(Warning::at(asked.span(), message, help));
}
