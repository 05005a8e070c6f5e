//! Descriptions of free motions by bodies, positions and components instead of equations.

use super::Model;
use super::coordinates::in_words;
use asperity_fem::FemError;
use asperity_fem::multifrontal::FreeMode;

/// Names of the axes.
const AXES: [&str; 3] = ["x", "y", "z"];

/// Describes why a system was not solved. `node_of` gives the mesh node and component of a degree of freedom of the error.
pub(crate) fn unsolved<const D: usize>(
    model: &Model<D>,
    error: &FemError,
    node_of: impl Fn(usize) -> (usize, usize),
) -> String {
    let Some(pivot) = error.pivot() else { return error.to_string() };
    let (node, component) = node_of(pivot.equation);
    let axis = AXES[model.idealisation.axis(component)];
    let at = in_words(&model.mesh.nodes[node]);
    let body = model.bodies.iter().find(|b| b.nodes.contains(&node));
    let body = body.map_or(String::new(), |b| format!(" of body `{}`", b.name));
    format!(
        "the system is {}: the motion in {axis} of the node at {at}{body} is not held (pivot {:.1e}, diagonal {:.1e})",
        if error.is_singular() { "singular" } else { "not positive definite" },
        pivot.pivot,
        pivot.diagonal
    )
}

/// Describes a motion out of the model that nothing stops, in a scene whose bodies touch or not.
pub(crate) fn adrift<const D: usize>(
    model: &Model<D>,
    node: usize,
    component: usize,
    touches: bool,
) -> String {
    let axis = AXES[model.idealisation.axis(component)];
    let body = model.bodies.iter().find(|b| b.nodes.contains(&node));
    let body = body.map_or(String::new(), |b| format!(" of body `{}`", b.name));
    // Without contact a body moves so where it is at its limit load, or its cells are crushed.
    let why = if touches {
        "contact and friction do not hold it against the loads"
    } else {
        "the body yields or collapses under the loads"
    };
    format!(
        "nothing resists the motion in {axis} of the node at {}{body}: {why}",
        in_words(&model.mesh.nodes[node])
    )
}

/// Describes a motion that nothing resists. `nodes` gives the mesh node of each node of the system.
pub(crate) fn motion<const D: usize>(model: &Model<D>, mode: &FreeMode<D>, nodes: &[usize]) -> String {
    let moving: Vec<usize> = mode.nodes.iter().map(|&n| nodes[n]).collect();
    let bodies = model.bodies.iter().filter(|b| moving.iter().any(|n| b.nodes.contains(n)));
    let names: Vec<String> = bodies.map(|b| format!("`{}`", b.name)).collect();
    let noun = if names.len() == 1 { "body" } else { "bodies" };
    format!("{noun} {} {}", names.join(", "), mode.motion())
}
