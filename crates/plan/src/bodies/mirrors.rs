//! Planes of symmetry through the slave points of mortar interfaces.
//!
//! A scene that models one half holds the nodes of the plane across it. Where the plane ends both sides of an interface, its slave
//! nodes there do not move across it against the master ([`Mirror`]).

use super::PlannedInterface;
use super::assembly::Assembly;
use super::start_gaps::slave_normals;
use asperity_contact::Mirror;
use asperity_fem::kinematics::Idealisation;
use asperity_mechanics::{Measure, Model, Motion, Stage, bounds};

/// Distance from a plane over the size of the scene that is rounding of coordinates.
const FLAT: f64 = 1e-9;

/// Component of a unit normal across a plane up to which a slave face meets it at a right angle: half the turn of a facet of a circle, of
/// which five or more go to a radian.
const UPRIGHT: f64 = 0.1;

/// Finds the planes of symmetry of all mortar interfaces.
pub fn apply<const D: usize>(assembly: &mut Assembly<'_, D>) {
    if assembly.interfaces.iter().all(|i| i.measure != Measure::Mortar) {
        return;
    }
    let supports = Supports::new(&assembly.model, &assembly.stages);
    for planned in assembly.interfaces.iter_mut().filter(|i| i.measure == Measure::Mortar) {
        planned.mirrors = supports.mirrors(planned);
    }
}

/// Degrees of freedom that conditions hold.
struct Supports<'a, const D: usize> {
    model: &'a Model<D>,
    /// Degrees of freedom that do not move in any stage.
    still: Vec<bool>,
    /// Nodes of which a component is free in every stage.
    free: Vec<bool>,
}

impl<'a, const D: usize> Supports<'a, D> {
    fn new(model: &'a Model<D>, stages: &[Stage]) -> Self {
        let mut still = vec![!stages.is_empty(); model.dofs()];
        let mut prescribed = vec![false; model.dofs()];
        for stage in stages {
            let mut held = vec![false; model.dofs()];
            for (dofs, motion) in &stage.motions {
                dofs.iter().for_each(|&dof| prescribed[dof] = true);
                if matches!(motion, Motion::Hold) || matches!(motion, Motion::Fixed(value) if *value == 0.0) {
                    dofs.iter().for_each(|&dof| held[dof] = true);
                }
            }
            stage.turning.iter().flat_map(|set| &set.dofs).for_each(|&dof| held[dof] = false);
            still.iter_mut().zip(held).for_each(|(still, held)| *still &= held);
        }
        let free = prescribed.chunks(D).map(|node| node.contains(&false)).collect();
        Self { model, still, free }
    }

    /// Planes of symmetry through each slave point of an interface; empty if there are none.
    fn mirrors(&self, planned: &PlannedInterface) -> Vec<Mirror> {
        let planes = self.planes(planned);
        if planes.is_empty() {
            return Vec::new();
        }
        let normals = slave_normals(self.model, planned);
        // Tractions of an initial stress are those on the normals of the faces themselves.
        let tilt = if planned.pressed.is_some() { FLAT } else { UPRIGHT };
        let of = |&(node, _): &(usize, f64)| {
            let normal = &normals[&node];
            let size = normal.iter().map(|n| n * n).sum::<f64>().sqrt();
            let upright = |axis: usize| normal[axis].abs() < tilt * size;
            let through = |axis: usize| {
                let here = planes.iter().any(|&(a, place)| a == axis && self.is_at(node, axis, place));
                here && self.free[node] && self.rests(node, axis) && upright(axis)
            };
            Mirror(std::array::from_fn(through))
        };
        planned.slave.iter().map(of).collect()
    }

    /// Planes that end the slave body and the master, by the axes normal to them and their places. The master's nodes there do not move
    /// across them.
    fn planes(&self, planned: &PlannedInterface) -> Vec<(usize, f64)> {
        let slave = planned.slave.first().map(|point| point.0);
        let Some(body) = self.model.bodies.iter().find(|b| slave.is_some_and(|node| b.nodes.contains(&node)))
        else {
            return Vec::new();
        };
        let (min, max) = bounds(&self.model.mesh.nodes[body.nodes.clone()]);
        let ends = (0..D).flat_map(|axis| [(axis, min[axis], 1.0), (axis, max[axis], -1.0)]);
        let master = || planned.master_faces.iter().flat_map(|face| &face.nodes).copied();
        let ended = ends.filter(|&(axis, place, inward)| {
            let on = |node: usize| self.is_at(node, axis, place);
            let within = |node: usize| inward * (self.model.mesh.nodes[node][axis] - place) > 0.0;
            master().any(on)
                && master().all(|node| if on(node) { self.rests(node, axis) } else { within(node) })
        });
        ended.map(|(axis, place, _)| (axis, place)).collect()
    }

    /// True if a node's motion along an axis vanishes by a condition or on the axis of revolution.
    fn rests(&self, node: usize, axis: usize) -> bool {
        let on_axis = self.model.idealisation == Idealisation::Axisymmetric && axis == 0;
        self.still[node * D + axis] || (on_axis && self.is_at(node, axis, 0.0))
    }

    fn is_at(&self, node: usize, axis: usize, place: f64) -> bool {
        (self.model.mesh.nodes[node][axis] - place).abs() <= FLAT * self.model.scale
    }
}
