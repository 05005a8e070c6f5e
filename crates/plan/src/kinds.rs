//! Plans of scenes by the kind of run: the one place where kinds part.

use crate::bodies::{self, AnyPlan};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Scene, Stepper};
use crate::shared::setup::Setups;
use crate::{dynamics, faults};

/// Plan of a scene with bodies, by kind.
#[derive(Debug)]
pub enum ScenePlan {
    /// Stages of bodies and interfaces.
    Bodies(Box<AnyPlan>),
    /// Faults over earthquake cycles.
    Faults(Box<faults::Plan>),
    /// Bodies with mass, whose faults radiate waves.
    Dynamic(Box<dynamics::AnyPlan>),
}

/// Plans a scene of any of these kinds.
///
/// # Errors
/// [`Diagnostic`] with the position in the scene.
pub fn plan_scene(scene: &Scene) -> Result<ScenePlan, Diagnostic> {
    plan_beside(scene, &Setups::none())
}

/// Plans a scene of any of these kinds. Set-ups of faults that take long are kept, and read where they were kept before.
///
/// # Errors
/// [`Diagnostic`] with the position in the scene.
pub fn plan_beside(scene: &Scene, setups: &Setups) -> Result<ScenePlan, Diagnostic> {
    Ok(if *scene.time.stepper.get_ref() == Stepper::Explicit {
        ScenePlan::Dynamic(Box::new(dynamics::plan(scene)?))
    } else if scene.faults.is_empty() {
        ScenePlan::Bodies(Box::new(bodies::plan(scene)?))
    } else {
        let mut plan = faults::plan_beside(scene, setups)?;
        if *scene.time.stepper.get_ref() == Stepper::Auto {
            let (ruptures, doubts) = dynamics::ruptures(scene, &plan)?;
            plan.ruptures = Some(ruptures);
            plan.warnings.extend(doubts);
        }
        ScenePlan::Faults(Box::new(plan))
    })
}
