//! Choice between the condensed and the full system.

use super::assembly::Assembly;
use super::{Path, PlannedInterface};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Method, Path as PathChoice, Scene};
use asperity_contact::Sliding;
use asperity_mechanics::{Model, Stage, solver};

/// Chooses the condensed or the full system for a scene.
///
/// # Errors
/// [`Diagnostic`] if the scene requests one that cannot be used.
pub fn choose<const D: usize>(assembly: &Assembly<'_, D>) -> Result<Path, Diagnostic> {
    let Assembly { scene, model, interfaces, stages, .. } = assembly;
    let refuse = |message: String| {
        let help = "use `path = \"auto\"` or `path = \"full\"`";
        Err(Diagnostic::at(scene.time.stepper.span(), message, help))
    };
    match (scene.time.path, not_linear(model)) {
        _ if scene.solver.method() == Method::Iterative => Ok(Path::Full),
        (PathChoice::Full, _) => Ok(Path::Full),
        _ if scene.inertia().is_some() => Ok(Path::Full),
        (PathChoice::Condensed, _) if interfaces.is_empty() => {
            refuse("the condensed path needs an interface".into())
        }
        (PathChoice::Condensed, Some(why)) => {
            refuse(format!("the condensed path needs linear bodies, but {why}"))
        }
        (PathChoice::Auto, Some(_)) => Ok(Path::Full),
        (PathChoice::Auto, None) if interfaces.is_empty() || too_wide(model, interfaces, stages) => {
            Ok(Path::Full)
        }
        (_, None) => Ok(Path::Condensed),
    }
}

/// True if the full system is better under finite sliding, where a master may be much larger than the contact.
fn too_wide<const D: usize>(model: &Model<D>, interfaces: &[PlannedInterface], stages: &[Stage]) -> bool {
    let kept: usize = solver::retained(model, interfaces, stages).iter().map(Vec::len).sum();
    finite(interfaces) && kept > WIDEST
}

/// True if an interface has finite sliding.
pub fn finite(interfaces: &[PlannedInterface]) -> bool {
    interfaces.iter().any(|i| i.sliding == Sliding::Finite)
}

/// Number of interface degrees of freedom up to which the dense factors of the interface cost less per iteration than sparse factors of bodies with
/// that many on their surfaces (half a million unknowns in 2D, a hundred thousand in 3D). Dense factors of this size take some seconds.
const WIDEST: usize = 3000;

/// First body that is not linear, with the reason.
pub fn not_linear<const D: usize>(model: &Model<D>) -> Option<String> {
    model.bodies.iter().find_map(|b| b.nonlinear.map(|why| format!("in body `{}` {why}", b.name)))
}

/// Reason why the full system is solved.
pub fn full_because<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    interfaces: &[PlannedInterface],
) -> String {
    let why = match (scene.time.path, not_linear(model)) {
        (PathChoice::Full, _) => "the scene asks for it".to_string(),
        _ if scene.inertia().is_some() => "mass acts on all degrees of freedom".into(),
        (_, Some(why)) => why,
        _ if interfaces.is_empty() => "there is no interface to condense onto".into(),
        _ if scene.solver.method() == Method::Iterative => "the iterative method does not condense".into(),
        _ if !finite(interfaces) => "condensed bodies need more memory than is allowed".into(),
        _ => format!("the sides of finite sliding have more than {WIDEST} degrees of freedom"),
    };
    format!("full: {why}")
}
