//! Initial tractions on an interface due to the initial stress of the bodies.
//!
//! With the stress σ and the outward normal n of the slave, the force per area on the slave is σn. Both sides must give the same.

use super::SHARE;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Interface as Spec, Scene};
use crate::shared::entry::Entry;
use crate::shared::initial_stress;
use crate::shared::model::{self, Body, Model};
use asperity_fem::mesh::{Side, nodes_of_sides};
use asperity_fem::surface;
use asperity_mechanics::{InitialTractions, coordinates};

/// Largest relative difference of the nodal forces of both sides that count as balanced: rounding of stresses given in a scene.
const BALANCED: f64 = 1e-6;

/// Initial tractions of an interface that has them.
///
/// # Errors
/// [`Diagnostic`] if a body has no initial stress, or if both bodies exert different tractions.
pub fn initial_tractions<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    Entry { name, spec }: Entry<'_, Spec>,
    slave: &[Side],
) -> Result<Option<InitialTractions>, Diagnostic> {
    let Some(key) = spec.initial_stress.as_ref().filter(|key| *key.get_ref()) else { return Ok(None) };
    let master = model::sides(model, &spec.master)?;
    let body = |set: &str| model.body_of(set).map(|b| &model.bodies[b]);
    let (Some(own), Some(other)) = (body(spec.slave.get_ref()), body(spec.master.get_ref())) else {
        return Ok(None);
    };
    let field = |body: &Body<D>| {
        initial_stress::body_field(scene, &body.name).ok_or_else(|| {
            let message = format!(
                "interface `{name}` starts with an initial stress, and body `{}` has none",
                body.name
            );
            Diagnostic::at(key.span(), message, "both bodies need an `initial_stress`")
        })
    };
    let (here, there) = (field(own)?, field(other)?);
    let space = model.idealisation;
    let forces = surface::integrate(&model.mesh, slave, space, |point, value| {
        value.copy_from_slice(&here.traction(&point.position, &point.normal));
    });
    let beyond = surface::integrate(&model.mesh, slave, space, |point, value| {
        value.copy_from_slice(&there.traction(&point.position, &point.normal));
    });
    let normals =
        surface::integrate(&model.mesh, slave, space, |point, value| value.copy_from_slice(&point.normal));
    let areas = surface::areas(&model.mesh, slave, space);
    let largest = forces.iter().chain(&beyond).map(|(_, f)| f.abs()).fold(0.0, f64::max);
    let mut both = forces.iter().zip(&beyond);
    if let Some(((dof, a), (_, b))) = both.find(|(a, b)| (a.1 - b.1).abs() > BALANCED * largest) {
        let at = coordinates::in_words(&model.mesh.nodes[dof / D]);
        return Err(Diagnostic::at(
            key.span(),
            format!(
                "the initial stresses of bodies `{}` and `{}` exert different tractions on interface `{name}`: forces along {} on the node at {at} are {a:.4e} \
                 and {b:.4e}",
                own.name,
                other.name,
                ["x", "y", "z"][dof % D]
            ),
            "what one body exerts the other bears: give both the same stress there, or remove `initial_stress` from the interface",
        ));
    }
    let masters = nodes_of_sides(&model.mesh, master);
    let nodes = nodes_of_sides(&model.mesh, slave).into_iter().enumerate();
    // Both lists are ordered by node, with one entry per component.
    let points = nodes.filter(|(_, n)| masters.binary_search(n).is_err()).map(|(k, node)| {
        let entry = |list: &[(usize, f64)]| -> [f64; D] { std::array::from_fn(|c| list[k * D + c].1) };
        let normal = entry(&normals);
        let size = normal.iter().map(|n| n * n).sum::<f64>().sqrt();
        let unit: [f64; D] = normal.map(|n| if size > 0.0 { n / size } else { 0.0 });
        let area = areas[&node];
        let padded = |v: [f64; D]| std::array::from_fn(|c| v.get(c).copied().unwrap_or(0.0));
        let at = here.traction(&model.mesh.nodes[node], &unit);
        // A corner of a six-node triangle has no tributary area, hence no mean.
        let mean = if area > 0.0 { entry(&forces).map(|f| f / area) } else { at };
        (padded(at), padded(mean))
    });
    let reach = SHARE * model.element_size(own, slave);
    Ok(Some(InitialTractions { points: points.collect(), reach }))
}
