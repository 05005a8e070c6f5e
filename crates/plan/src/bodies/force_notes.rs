//! Forces on sets whose edge belongs to an interface: they include what contact exerts there.

use crate::reading::scene::model::Scene;
use crate::shared::model::{Model, sets};
use asperity_mechanics::PlannedInterface;
use std::collections::BTreeSet;

/// Nodes of both sides of an interface.
fn touching(planned: &PlannedInterface) -> BTreeSet<usize> {
    let slave = planned.slave.iter().map(|point| point.0);
    slave.chain(planned.master_faces.iter().flat_map(|face| face.nodes.iter().copied())).collect()
}

/// Notes about forces to which contact contributes at some nodes of their sets.
pub fn notes<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    interfaces: &[PlannedInterface],
) -> Vec<String> {
    let mut all = Vec::new();
    for (name, spec) in &scene.output.forces {
        let set = spec.get_ref().set.get_ref();
        let Some(nodes) = sets::find_nodes(model, set) else { continue };
        for planned in interfaces {
            let touching = touching(planned);
            let common = nodes.iter().filter(|node| touching.contains(node)).count();
            // A side that is all contact is asked for its force.
            if common > 0 && common < nodes.len() {
                all.push(format!(
                    "force `{name}` on `{set}` includes what interface `{}` exerts at {common} of its {} nodes, and is not the reaction alone",
                    planned.name,
                    nodes.len()
                ));
            }
        }
    }
    all
}
