//! Doubt about slave nodes at the rim of what faces the master.
//!
//! In node-to-point contact a slave node with a partner acts with its whole tributary area, also with the part of it on faces that
//! reach beyond the master. An edge that lies on an edge then carries as much as half a row of faces, although no area faces.

use super::PlannedInterface;
use super::start_gaps::MeasuredGaps;
use crate::reading::scene::model::Interface as Spec;
use asperity_mechanics::Measure;
use asperity_run::Warning;
use std::collections::BTreeSet;

/// Share of the area that faces the master above which such nodes are reported: most of what carries is then not known to face.
/// With n faces across the master it is about 2/n in the plane, so that four are enough.
const SHARE: f64 = 0.5;

/// Warning about nodes that count area beyond the master.
pub fn doubt(planned: &PlannedInterface, spec: &Spec, measured: &MeasuredGaps) -> Option<Warning> {
    if planned.measure != Measure::NodeToPoint {
        return None;
    }
    let points: BTreeSet<usize> = planned.slave.iter().map(|point| point.0).collect();
    let facing: BTreeSet<usize> = measured.facing.iter().map(|point| planned.slave[point.point].0).collect();
    let beyond = |node: &usize| points.contains(node) && !facing.contains(node);
    let faces = planned.slave_faces.iter().filter(|face| face.nodes.iter().any(beyond));
    let rim: BTreeSet<usize> = faces.flat_map(|face| face.nodes.iter().copied()).collect();
    let all: f64 = measured.facing.iter().map(|point| point.area).sum();
    let on_rim = measured.facing.iter().filter(|point| rim.contains(&planned.slave[point.point].0));
    let share = on_rim.map(|point| point.area).sum::<f64>() / all;
    (share > SHARE).then(|| {
        let message = format!(
            "{:.0} % of the area that faces the master of interface `{}` belongs to slave nodes whose faces reach beyond it, and \
             node-to-point contact counts all of a node's area",
            100.0 * share,
            planned.name
        );
        let help = "choose `measure = \"mortar\"`, which integrates over what faces, or the smaller side as the slave, or smaller cells";
        Warning::at(spec.slave.span(), message, help)
    })
}
