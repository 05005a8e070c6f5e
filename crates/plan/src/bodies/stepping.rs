//! Time stepper of a scene and its step control.

use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Rule, Scene, Spanned, Stepper};
use crate::shared::loading::courses;
use asperity_contact::{TOUCH, TimeRule};
use asperity_friction::law::RateBounds;
use asperity_mechanics::{Control, Stage, Stepping, timing};
use asperity_output::bodies::FieldSchedule;
use asperity_scene::defaults;

/// Kind of laws with a state variable.
const RATE_AND_STATE: &str = "rate-and-state";

/// Shares of a stage that the step control takes are those that the keys show.
const _: () = assert!(
    timing::FIRST == defaults::FIRST_STEP
        && timing::LARGEST == defaults::LARGEST_STEP
        && timing::SMALLEST == defaults::SMALLEST_STEP
        && timing::LEAST == defaults::LEAST_STEP
);

/// Chooses the stepper of a scene.
///
/// # Errors
/// [`Diagnostic`] for the stepper of faults, which bodies alone cannot use.
pub fn choose(scene: &Scene) -> Result<Stepping, Diagnostic> {
    let time = &scene.time;
    let rule = match rule(scene) {
        Rule::BackwardEuler => TimeRule::BackwardEuler,
        Rule::Bdf2 => TimeRule::Bdf2,
    };
    Ok(match time.stepper.get_ref() {
        Stepper::Implicit | Stepper::Auto => {
            let bounds = RateBounds { zeta: f64::INFINITY, log_rate: f64::INFINITY };
            Stepping { rule, bounds, drift: None }
        }
        Stepper::StaticExplicit => {
            let usual = if evolves(scene) { defaults::RATE_DRIFT } else { defaults::DRIFT };
            let drift = time.drift.as_ref().map_or(usual, |d| *d.get_ref());
            let bounds = RateBounds {
                zeta: time.zeta.as_ref().map_or(defaults::ZETA, |z| *z.get_ref()),
                log_rate: time.rate_change.as_ref().map_or(defaults::RATE_CHANGE, |r| *r.get_ref()),
            };
            Stepping { rule, bounds, drift: Some(drift) }
        }
        Stepper::FaultOde => {
            let help = "add `[faults.NAME]`, or use \"implicit\" or \"static-explicit\"";
            let message = "the stepper \"fault-ode\" integrates faults, and the scene has none";
            return Err(Diagnostic::at(time.stepper.span(), message, help));
        }
        Stepper::Explicit => {
            let help = "\"implicit\" or \"static-explicit\"";
            let message = "the stepper \"explicit\" has no steps without inertia";
            return Err(Diagnostic::at(time.stepper.span(), message, help));
        }
    })
}

/// Rule for the slip rate.
#[must_use]
pub fn rule(scene: &Scene) -> Rule {
    let usual = if evolves(scene) { Rule::Bdf2 } else { Rule::BackwardEuler };
    scene.time.rule.as_ref().map_or(usual, |r| *r.get_ref())
}

/// True if an interface has a rate-and-state law.
fn evolves(scene: &Scene) -> bool {
    let mut kinds = scene.interfaces.values().filter_map(|i| i.law.as_ref()?.get_ref().kind.as_ref());
    kinds.any(|kind| kind.get_ref() == RATE_AND_STATE)
}

/// Checks that the tolerance of slip is no less than the rounding of positions in a scene of size `scale` \[m\].
///
/// # Errors
/// [`Diagnostic`] at the tolerance.
pub fn resolvable(scene: &Scene, scale: f64) -> Result<(), Diagnostic> {
    let rounding = TOUCH * scale;
    match scene.time.tolerance.as_ref().filter(|given| given.get_ref().0 < rounding) {
        Some(given) => Err(Diagnostic::at(
            given.span(),
            format!(
                "`tolerance` = {:e} m is less than the rounding of positions, {rounding:.1e} m here: no step is short enough",
                given.get_ref().0
            ),
            "left out, 2e-5 of the largest travel of a stage is taken",
        )),
        None => Ok(()),
    }
}

/// Step control of a scene with these stages.
pub fn control(scene: &Scene, stages: &[Stage]) -> Control {
    let time = &scene.time;
    let travel = stages.iter().map(Stage::driven).fold(0.0, f64::max);
    // Without motion there is no displacement to compare slip with; static-explicit steps use the R-minimum rule.
    let adapts = travel > 0.0 && matches!(time.stepper.get_ref(), Stepper::Implicit | Stepper::Auto);
    let usual = if adapts { defaults::SLIP_TOLERANCE * travel } else { f64::INFINITY };
    // Without a state variable errors of friction do not persist, so the error as points begin to slip one by one need not be small.
    let accuracy = if evolves(scene) { defaults::FRICTION_TOLERANCE } else { f64::INFINITY };
    Control {
        tolerance: time.tolerance.as_ref().map_or(usual, |t| t.get_ref().0),
        friction: time.friction_tolerance.as_ref().map_or(accuracy, |t| *t.get_ref()),
        first_step: time.first_step.as_ref().map(|t| t.get_ref().0),
        max_step: time.max_step.as_ref().map(|t| t.get_ref().0),
        min_step: time.min_step.as_ref().map(|t| t.get_ref().0),
        course: courses::tolerance(scene),
        imposed: time.imposed.clone(),
        outputs: outputs(scene, stages),
    }
}

/// Times of fields and profiles whose number the scene gives. Those that nobody asked for come at the next step.
fn outputs(scene: &Scene, stages: &[Stage]) -> Vec<f64> {
    let number = |asked: &Option<Spanned<usize>>| asked.as_ref().map_or(0, |n| *n.get_ref());
    let (fields, profiles) = (number(&scene.output.fields), number(&scene.output.profiles));
    let ends: Vec<f64> = stages.iter().map(|stage| stage.end).collect();
    FieldSchedule { fields, profiles }.times(&ends)
}
