//! Initial tractions on an interface due to the initial stress of the bodies.
//!
//! With the stress σ and the outward normal n of the slave, the force per area on the slave is σn. Both sides must give the same.

use super::SHARE;
use super::surfaces::{BodySurface, FacingSurfaces};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Interface as Spec, Scene};
use crate::shared::entry::Entry;
use crate::shared::initial_stress;
use crate::shared::model::Model;
use asperity_fem::mesh::{Side, nodes_of_sides};
use asperity_fem::surface;
use asperity_mechanics::{InitialTractions, StressField, coordinates};

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
    surfaces: &FacingSurfaces<'_, D>,
) -> Result<Option<InitialTractions>, Diagnostic> {
    let Some(key) = spec.initial_stress.as_ref().filter(|key| *key.get_ref()) else { return Ok(None) };
    let stress = |surface: &BodySurface<'_, D>| {
        let body = &surface.body.name;
        initial_stress::body_field(scene, body).ok_or_else(|| {
            let message =
                format!("interface `{name}` starts with an initial stress, and body `{body}` has none");
            Diagnostic::at(key.span(), message, "all bodies of the interface need an `initial_stress`")
        })
    };
    let slave = StressedSurface::new(model, &surfaces.slave, stress(&surfaces.slave)?);
    for master in &surfaces.masters {
        let Some(Mismatch { dof, by_slave: a, by_master: b }) = slave.mismatch(&stress(master)?) else {
            continue;
        };
        let at = coordinates::in_words(&model.mesh.nodes[dof / D]);
        return Err(Diagnostic::at(
            key.span(),
            format!(
                "the initial stresses of bodies `{}` and `{}` exert different tractions on interface `{name}`: forces along {} on the node at {at} are {a:.4e} \
                 and {b:.4e}",
                surfaces.slave.body.name,
                master.body.name,
                ["x", "y", "z"][dof % D]
            ),
            "what one body exerts the other bears: give both the same stress there, or remove `initial_stress` from the interface",
        ));
    }
    let reach = SHARE * surfaces.slave.cell_size(model);
    Ok(Some(InitialTractions { points: slave.tractions(&surfaces.master_sides()), reach }))
}

/// Values at nodes of a surface, by degrees of freedom.
type NodalValues = Vec<(usize, f64)>;

/// A force on a degree of freedom that is not the same by the stresses of both bodies.
struct Mismatch {
    dof: usize,
    by_slave: f64,
    by_master: f64,
}

/// The slave surface under the initial stress of its body.
struct StressedSurface<'m, const D: usize> {
    model: &'m Model<D>,
    surface: &'m BodySurface<'m, D>,
    stress: StressField,
    /// Forces that the stress exerts.
    forces: NodalValues,
}

impl<'m, const D: usize> StressedSurface<'m, D> {
    fn new(model: &'m Model<D>, surface: &'m BodySurface<'m, D>, stress: StressField) -> Self {
        let forces = forces(model, surface, &stress);
        Self { model, surface, stress, forces }
    }

    /// First force that another stress would exert otherwise.
    fn mismatch(&self, other: &StressField) -> Option<Mismatch> {
        let beyond = forces(self.model, self.surface, other);
        let largest = self.forces.iter().chain(&beyond).map(|(_, f)| f.abs()).fold(0.0, f64::max);
        let mut both = self.forces.iter().zip(&beyond);
        let found = both.find(|(a, b)| (a.1 - b.1).abs() > BALANCED * largest);
        found.map(|(a, b)| Mismatch { dof: a.0, by_slave: a.1, by_master: b.1 })
    }

    /// Tractions at its nodes and their means over the areas of these; of nodes that both sides share there are none.
    fn tractions(&self, masters: &[Side]) -> Vec<([f64; 3], [f64; 3])> {
        let Self { model, surface, stress, forces } = self;
        let normals = surface::integrate(&model.mesh, surface.sides, model.idealisation, |point, value| {
            value.copy_from_slice(&point.normal);
        });
        let areas = surface::areas(&model.mesh, surface.sides, model.idealisation);
        let masters = nodes_of_sides(&model.mesh, masters);
        let nodes = nodes_of_sides(&model.mesh, surface.sides).into_iter().enumerate();
        // Both lists are ordered by node, with one entry per component.
        let points = nodes.filter(|(_, n)| masters.binary_search(n).is_err()).map(|(k, node)| {
            let entry = |list: &NodalValues| -> [f64; D] { std::array::from_fn(|c| list[k * D + c].1) };
            let normal = entry(&normals);
            let size = normal.iter().map(|n| n * n).sum::<f64>().sqrt();
            let unit: [f64; D] = normal.map(|n| if size > 0.0 { n / size } else { 0.0 });
            let area = areas[&node];
            let padded = |v: [f64; D]| std::array::from_fn(|c| v.get(c).copied().unwrap_or(0.0));
            let at = stress.traction(&model.mesh.nodes[node], &unit);
            // A corner of a six-node triangle has no tributary area, hence no mean.
            let mean = if area > 0.0 { entry(forces).map(|f| f / area) } else { at };
            (padded(at), padded(mean))
        });
        points.collect()
    }
}

/// Forces on a surface with the normal of its body under a stress.
fn forces<const D: usize>(
    model: &Model<D>,
    surface: &BodySurface<'_, D>,
    stress: &StressField,
) -> NodalValues {
    surface::integrate(&model.mesh, surface.sides, model.idealisation, |point, value| {
        value.copy_from_slice(&stress.traction(&point.position, &point.normal));
    })
}
