//! Plans of scenes by the kind of run: the one place where kinds part.

use crate::diagnostic::Diagnostic;
use crate::plan::{self, AnyPlan};
use crate::scene::model::{Scene, Stepper};
use crate::setup::Setups;
use crate::{dynamic, fault};

/// Plan of a scene with bodies, by kind.
#[derive(Debug)]
pub enum ScenePlan {
    /// Stages of bodies and interfaces.
    Bodies(Box<AnyPlan>),
    /// Faults over earthquake cycles.
    Faults(Box<fault::Plan>),
    /// Bodies with mass, whose faults radiate waves.
    Dynamic(Box<dynamic::AnyPlan>),
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
        ScenePlan::Dynamic(Box::new(dynamic::plan(scene)?))
    } else if scene.faults.is_empty() {
        ScenePlan::Bodies(Box::new(plan::plan(scene)?))
    } else {
        let mut plan = fault::plan_beside(scene, setups)?;
        if *scene.time.stepper.get_ref() == Stepper::Auto {
            let (ruptures, doubts) = dynamic::ruptures(scene, &plan)?;
            plan.ruptures = Some(ruptures);
            plan.warnings.extend(doubts);
        }
        ScenePlan::Faults(Box::new(plan))
    })
}
