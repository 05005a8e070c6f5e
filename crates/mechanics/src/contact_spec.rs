//! Interfaces of a plan in the form of the contact crate.

use super::interface::{Measure, PlannedInterface, interface_nodes};
use super::{Model, Stepping};
use asperity_contact::{InterfaceSpec, MeasureKind, Segment, SlavePoint, SurfaceNode};
use asperity_fem::kinematics::Idealisation;
use asperity_fem::mesh::MeshFace;

/// Rate below which a forward step counts a point as at rest, relative to the largest prescribed rate (the floor of limit r8).
const RATE_FLOOR: f64 = 1e-12;

/// Specification of an interface for the contact crate. Multipliers that are unknowns are numbered from `unknowns`.
#[must_use]
pub fn spec<const D: usize>(
    model: &Model<D>,
    stepping: &Stepping,
    planned: &PlannedInterface,
    number: &[usize],
    largest_rate: f64,
    unknowns: usize,
) -> InterfaceSpec<D> {
    let labels = interface_nodes(planned);
    let local = |node: usize| labels.partition_point(|&n| n < node);
    let nodes = labels
        .iter()
        .map(|&n| SurfaceNode { position: model.mesh.nodes[n], dof: number[n * D], label: n })
        .collect();
    let segments = |faces: &[MeshFace]| -> Vec<Segment> {
        let segment = |face: &MeshFace| Segment {
            kind: face.kind,
            nodes: face.nodes.iter().map(|&n| local(n)).collect(),
        };
        faces.iter().map(segment).collect()
    };
    InterfaceSpec {
        name: planned.name.clone(),
        nodes,
        slave: planned.slave.iter().map(|&(n, area)| SlavePoint { node: local(n), area }).collect(),
        master: segments(&planned.master_faces),
        measure: match planned.measure {
            Measure::NodeToPoint => MeasureKind::NodeToPoint,
            Measure::Mortar => MeasureKind::Mortar {
                faces: segments(&planned.slave_faces),
                axisymmetric: model.idealisation == Idealisation::Axisymmetric,
                mirrors: planned.mirrors.clone(),
            },
        },
        sliding: planned.sliding,
        smoothing: planned.smoothed.then(asperity_contact::Smoothing::default),
        fixed_normal: None,
        enforcement: planned.enforced.declared(unknowns),
        normal_penalty: planned.normal_penalty,
        tangential_penalty: planned.tangential_penalty,
        young_per_size: planned.young_per_size,
        law: planned.law.clone(),
        scale: model.scale,
        rate_floor: RATE_FLOOR * largest_rate,
        rate_bounds: stepping.bounds,
        label_rate: planned.law.as_ref().filter(|l| !l.has_elastic_domain()).map(|_| largest_rate),
    }
}
