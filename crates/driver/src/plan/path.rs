//! The choice between the condensed and the full system.

use super::{Path, PlannedInterface};
use crate::diagnostic::Diagnostic;
use crate::scene::model::{Method, Path as PathChoice, Scene};
use asperity_contact::Sliding;
use asperity_mechanics::{Model, solver};

/// Chooses the path of a scene.
///
/// # Errors
/// [`Diagnostic`] where the scene asks for one that does not serve it.
pub fn choose<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    interfaces: &[PlannedInterface],
) -> Result<Path, Diagnostic> {
    let refuse = |message: String| {
        let help = "use `path = \"auto\"` or `path = \"full\"`";
        Err(Diagnostic::at(scene.time.stepper.span(), message, help))
    };
    match (scene.time.path, not_linear(model)) {
        _ if scene.solver.method() == Method::Iterative => Ok(Path::Full),
        (PathChoice::Full, _) => Ok(Path::Full),
        (PathChoice::Condensed, _) if interfaces.is_empty() => {
            refuse("the condensed path needs an interface".into())
        }
        (PathChoice::Condensed, Some(why)) => {
            refuse(format!("the condensed path needs linear bodies, but {why}"))
        }
        (PathChoice::Auto, Some(_)) => Ok(Path::Full),
        (PathChoice::Auto, None) if interfaces.is_empty() || too_wide(model, interfaces) => Ok(Path::Full),
        (_, None) => Ok(Path::Condensed),
    }
}

/// True if all bodies together are the better system under finite sliding, whose masters may be much larger than what is in contact.
fn too_wide<const D: usize>(model: &Model<D>, interfaces: &[PlannedInterface]) -> bool {
    let kept: usize = solver::retained(model, interfaces).iter().map(Vec::len).sum();
    finite(interfaces) && kept > WIDEST
}

/// True if an interface slides by any distance.
pub fn finite(interfaces: &[PlannedInterface]) -> bool {
    interfaces.iter().any(|i| i.sliding == Sliding::Finite)
}

/// Degrees of freedom of an interface up to which its dense factors, some seconds for this many, cost less in each iteration than sparse
/// factors of bodies that have them on their surfaces: half a million unknowns in the plane, a hundred thousand in space.
const WIDEST: usize = 3000;

/// The first body that is not linear, and why.
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
        (_, Some(why)) => why,
        _ if interfaces.is_empty() => "there is no interface to condense onto".into(),
        _ if scene.solver.method() == Method::Iterative => "the iterative method does not condense".into(),
        _ => format!("the sides of finite sliding have more than {WIDEST} degrees of freedom"),
    };
    format!("full: {why}")
}
