//! Restraint of every body, and of every part of a split body: by its conditions, by symmetry, or by contact alone.
//!
//! A rigid motion is free if no fixed degree of freedom resists it. It is refused if no interface of the body could hold it in
//! any stage either. Contact passes motions on: bodies that it joins are held only if they cannot move in any combination
//! that leaves all contacts as they are.

mod mechanism;
mod rigid;

use super::{Model, PlannedInterface, Stage};
use asperity_fem::mesh::MeshFace;
use mechanism::{ClosureTest, Contact, Mechanism, Reach};
use rigid::{Frame, Row, condition_rows, free_motion, project};

/// Motion of a part of a body in a stage.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// Number of the body.
    pub body: usize,
    /// First node of the part.
    pub node: usize,
    /// Name of the stage.
    pub stage: String,
    /// Description of the motion.
    pub motion: String,
    /// Bodies that contact joins and that move together, ascending; empty if the part moves alone.
    pub together: Vec<usize>,
    /// True if those that move together do so as one rigid body, without motion against each other.
    pub as_one: bool,
}

/// Checks all bodies in all stages. Returns the motions that are held by contact alone.
///
/// # Errors
/// The first motion that nothing resists.
pub fn check<const D: usize>(
    model: &Model<D>,
    stages: &[Stage],
    interfaces: &[PlannedInterface],
) -> Result<Vec<Motion>, Motion> {
    let mut held = Vec::new();
    for (body, nodes) in parts(model) {
        for stage in stages {
            let found = |motion| {
                let (stage, together) = (stage.name.clone(), Vec::new());
                Motion { body, node: nodes[0], stage, motion, together, as_one: false }
            };
            let mut rows = condition_rows(model, nodes, stage);
            let Some(motion) = free_motion::<D>(&rows, model.idealisation) else { continue };
            rows.extend(contact_rows(model, nodes, stage, interfaces));
            if let Some(loose) = free_motion::<D>(&rows, model.idealisation) {
                return Err(found(loose));
            }
            held.push(found(motion));
        }
    }
    // What holds at the normals of one side alone is no hold: flat faces let a curved partner slide along them.
    let reaches = [Reach::SlaveFaces(&|_, _| true), Reach::MasterFaces];
    match stages.iter().find_map(|stage| reaches.iter().find_map(|r| mechanism(model, stage, interfaces, *r)))
    {
        Some(loose) => Err(loose),
        None => Ok(held),
    }
}

/// The first motion that nothing resists while only some points of the interfaces are closed.
#[must_use]
pub fn parted<const D: usize>(
    model: &Model<D>,
    stage: &Stage,
    interfaces: &[PlannedInterface],
    closed: ClosureTest<'_>,
) -> Option<Motion> {
    mechanism(model, stage, interfaces, Reach::SlaveFaces(closed))
}

/// Parts of all bodies.
fn parts<const D: usize>(model: &Model<D>) -> impl Iterator<Item = (usize, &Vec<usize>)> {
    model.bodies.iter().enumerate().flat_map(|(b, body)| body.parts.iter().map(move |p| (b, p)))
}

/// A motion of some parts that nothing resists.
fn mechanism<const D: usize>(
    model: &Model<D>,
    stage: &Stage,
    interfaces: &[PlannedInterface],
    reach: Reach<'_>,
) -> Option<Motion> {
    let parts: Vec<(usize, &Vec<usize>)> = parts(model).collect();
    let nodes: Vec<&[usize]> = parts.iter().map(|(_, nodes)| nodes.as_slice()).collect();
    let Mechanism { moving, motion, as_one } =
        mechanism::find(model, stage, &nodes, Contact { interfaces, reach })?;
    let first = *moving.first()?;
    let mut together: Vec<usize> = moving.iter().map(|&p| parts[p].0).collect();
    together.dedup();
    if moving.len() == 1 {
        together.clear();
    }
    let (body, node) = (parts[first].0, parts[first].1[0]);
    Some(Motion { body, node, stage: stage.name.clone(), motion, together, as_one })
}

/// Rows held by contact, which constrains the normal of each face. Friction also constrains the tangents.
fn contact_rows<const D: usize>(
    model: &Model<D>,
    nodes: &[usize],
    stage: &Stage,
    interfaces: &[PlannedInterface],
) -> Vec<Row> {
    let frame = Frame::new(model, nodes);
    let mut rows = Vec::new();
    for interface in interfaces {
        let friction = interface.rubs(stage);
        for MeshFace { nodes: face, .. } in interface.slave_faces.iter().chain(&interface.master_faces) {
            if nodes.binary_search(&face[0]).is_err() {
                continue;
            }
            let normal = model.face_normal(face);
            for &node in face {
                let components = frame.rows(&model.mesh.nodes[node]);
                if friction {
                    rows.extend(components);
                } else {
                    rows.push(project(&components, &normal));
                }
            }
        }
    }
    rows
}
