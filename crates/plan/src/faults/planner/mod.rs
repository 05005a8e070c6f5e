//! Plans a scene with faults: the problem to integrate and the method.

mod assemble;
mod backslip;
mod bends;
mod body_faults;
mod body_samples;
mod cells;
pub(crate) mod checks;
mod condensation;
mod condensation_refusals;
mod condensed;
mod coulomb;
pub mod cover;
mod diffusion;
mod fault_faces;
mod fault_resolution;
pub mod fields;
mod floor;
mod heat;
mod history;
mod injection;
mod junctions;
mod loaded_bodies;
mod medium;
mod mirror;
mod operator;
pub mod patches;
mod place;
mod placed_point;
mod plates;
mod point;
mod points;
mod pressing;
mod prestress;
mod pulses;
mod radiation;
mod receivers;
mod remarks;
mod requests;
mod rock;
mod sense;
mod side_conditions;
pub mod spacing;
mod start_doubts;
mod steady;
mod up_direction;
mod weight;
mod wells;

pub(crate) use assemble::views;
pub(crate) use backslip::fastest as fastest_plates;
pub(crate) use fault_faces::FaultFaces;
pub(crate) use fault_resolution::resolved;
pub use place::places;
pub(crate) use placed_point::{PlacedPoint, in_space, slides};
pub(crate) use points::all_points;
pub(crate) use pulses::{doubts as pulse_doubts, pulses};
pub(crate) use remarks::Remarks;
pub(crate) use requests::nothing_slides;

use super::plan::Plan;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Kinematics, Scene};
use crate::shared::setup::Setups;
use asperity_cycles::operator::Form;
use operator::OperatorSource;

/// Plans a scene whose stepper is "fault-ode".
///
/// # Errors
/// [`Diagnostic`] with the place in the scene.
pub fn plan(scene: &Scene) -> Result<Plan, Diagnostic> {
    plan_with(scene, Form::Fitting)
}

/// Plans such a scene with set-ups that are kept.
///
/// # Errors
/// [`Diagnostic`] with the place in the scene.
pub fn plan_beside(scene: &Scene, setups: &Setups) -> Result<Plan, Diagnostic> {
    plan_of_kind(scene, OperatorSource { form: Form::Fitting, setups })
}

/// Plans such a scene with the operator in the given form.
///
/// # Errors
/// [`Diagnostic`] with the place in the scene.
pub fn plan_with(scene: &Scene, form: Form) -> Result<Plan, Diagnostic> {
    plan_of_kind(scene, OperatorSource { form, setups: &Setups::none() })
}

fn plan_of_kind(scene: &Scene, source: OperatorSource<'_>) -> Result<Plan, Diagnostic> {
    match scene.kinematics.get_ref() {
        Kinematics::Antiplane | Kinematics::PlaneStrain => plan_in::<2>(scene, source),
        Kinematics::ThreeD => plan_in::<3>(scene, source),
        other => Err(Diagnostic::at(
            scene.kinematics.span(),
            format!("faults in {} are not integrated yet", other.words()),
            "\"antiplane\", \"plane-strain\" and \"3d\" are",
        )),
    }
}

fn plan_in<const D: usize>(scene: &Scene, source: OperatorSource<'_>) -> Result<Plan, Diagnostic> {
    match &scene.medium {
        Some(medium) => rock::plan::<D>(scene, medium, source),
        None => body_faults::plan::<D>(scene, source),
    }
}
