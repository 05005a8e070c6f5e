//! Plans a scene with faults: the problem to integrate and the method.

mod apart;
mod asked;
mod assemble;
mod backslip;
mod bends;
mod between_bodies;
mod cells;
pub(crate) mod checks;
mod condensation;
mod condensed;
mod coulomb;
pub mod cover;
mod diffusion;
pub mod fields;
mod floor;
mod heated;
mod held;
mod history;
mod injection;
mod loaded;
mod medium;
mod meet;
mod meshed;
mod mirror;
mod operator;
pub mod patches;
mod place;
mod placed;
mod plates;
mod point;
mod points;
mod pressing;
mod prestress;
mod pulses;
mod radiation;
mod receivers;
mod remarks;
mod resolved;
mod rock;
mod sampled;
mod sense;
mod start_doubts;
mod steady;
mod untouched;
mod upright;
mod weight;
mod wells;

pub(crate) use asked::nothing_slides;
pub(crate) use assemble::views;
pub(crate) use backslip::fastest as fastest_plates;
pub(crate) use meshed::FaultFaces;
pub use place::places;
pub(crate) use placed::{PlacedPoint, in_space, slides};
pub(crate) use points::all_points;
pub(crate) use pulses::{doubts as pulse_doubts, pulses};
pub(crate) use remarks::Remarks;
pub(crate) use resolved::resolved;

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
        None => between_bodies::plan::<D>(scene, source),
    }
}
