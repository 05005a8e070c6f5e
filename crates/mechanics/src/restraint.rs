//! Restraint of every body, and of every part of a split body: by its conditions, by symmetry, or by contact alone.
//!
//! A rigid motion is free if no fixed degree of freedom resists it. It is refused if no interface of the body could hold it in
//! any stage either. Contact passes motions on: bodies that it joins are held together only if a condition holds one of them.

use super::{Model, PlannedInterface, Stage};
use asperity_fem::kinematics::Idealisation;
use asperity_fem::mesh::MeshFace;
use nalgebra::DMatrix;
use std::ops::Range;

/// Eigenvalue of the Gram matrix of constraints, relative to the largest, below which a motion is free. It exceeds the rounding
/// of a sum over at most 1e6 rows of order one.
const FREE: f64 = 1e-9;

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
    /// Bodies that contact joins and that move as one, ascending; empty if the part moves alone.
    pub together: Vec<usize>,
}

/// True for the points of an interface that are closed, by the numbers of the interface and of the point.
type ClosureTest<'a> = &'a dyn Fn(usize, usize) -> bool;

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
                Motion { body, node: nodes[0], stage, motion, together }
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
    match stages.iter().find_map(|stage| moving_as_one(model, stage, interfaces, &|_, _| true)) {
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
    let alone = parts(model).find_map(|(body, nodes)| {
        let mut rows = condition_rows(model, nodes, stage);
        rows.extend(closed_rows(model, nodes, stage, interfaces, closed));
        let motion = free_motion::<D>(&rows, model.idealisation)?;
        Some(Motion { body, node: nodes[0], stage: stage.name.clone(), motion, together: Vec::new() })
    });
    alone.or_else(|| moving_as_one(model, stage, interfaces, closed))
}

/// Parts of all bodies.
fn parts<const D: usize>(model: &Model<D>) -> impl Iterator<Item = (usize, &Vec<usize>)> {
    model.bodies.iter().enumerate().flat_map(|(b, body)| body.parts.iter().map(move |p| (b, p)))
}

/// The first motion of parts that closed interfaces join which no condition resists.
fn moving_as_one<const D: usize>(
    model: &Model<D>,
    stage: &Stage,
    interfaces: &[PlannedInterface],
    closed: ClosureTest<'_>,
) -> Option<Motion> {
    let parts: Vec<(usize, &Vec<usize>)> = parts(model).collect();
    let mut group: Vec<usize> = (0..parts.len()).collect();
    for (k, interface) in interfaces.iter().enumerate() {
        if !(0..interface.slave.len()).any(|point| closed(k, point)) {
            continue;
        }
        let joined: Vec<usize> = (0..parts.len()).filter(|&p| touches(parts[p].1, interface)).collect();
        let groups: Vec<usize> = joined.iter().map(|&p| group[p]).collect();
        let Some(&first) = groups.iter().min() else { continue };
        group.iter_mut().filter(|g| groups.contains(g)).for_each(|g| *g = first);
    }
    (0..parts.len()).find_map(|first| {
        let members: Vec<usize> = (0..parts.len()).filter(|&p| group[p] == first).collect();
        if members.len() < 2 {
            return None;
        }
        let mut nodes: Vec<usize> = members.iter().flat_map(|&p| parts[p].1.iter().copied()).collect();
        nodes.sort_unstable();
        let motion = free_motion::<D>(&condition_rows(model, &nodes, stage), model.idealisation)?;
        let mut together: Vec<usize> = members.iter().map(|&p| parts[p].0).collect();
        together.dedup();
        let (body, node) = (parts[first].0, parts[first].1[0]);
        Some(Motion { body, node, stage: stage.name.clone(), motion, together })
    })
}

/// True if a part has faces of an interface.
fn touches(nodes: &[usize], interface: &PlannedInterface) -> bool {
    let mut faces = interface.slave_faces.iter().chain(&interface.master_faces);
    faces.any(|face| nodes.binary_search(&face.nodes[0]).is_ok())
}

/// Rows held by the closed points of the interfaces of a part.
fn closed_rows<const D: usize>(
    model: &Model<D>,
    nodes: &[usize],
    stage: &Stage,
    interfaces: &[PlannedInterface],
    closed: ClosureTest<'_>,
) -> Vec<Row> {
    let position = centred(model, nodes);
    let mut rows = Vec::new();
    for (k, interface) in interfaces.iter().enumerate().filter(|(_, i)| touches(nodes, i)) {
        let friction = interface.law.is_some() && !stage.frictionless.contains(&interface.name);
        for (_, &(node, _)) in interface.slave.iter().enumerate().filter(|(p, _)| closed(k, *p)) {
            let components: Vec<Row> = (0..D).map(|axis| row(position(node), axis)).collect();
            let face = interface.slave_faces.iter().find(|face| face.nodes.contains(&node));
            match face {
                Some(face) if !friction => rows.push(project(&components, &model.face_normal(&face.nodes))),
                _ => rows.extend(components),
            }
        }
    }
    rows
}

/// Rigid modes at a point, one entry per mode: translations, followed by rotations about the body's centre.
type Row = Vec<f64>;

fn modes<const D: usize>() -> usize {
    D * (D + 1) / 2
}

/// Range of the modes without strain. About an axis of revolution it is the translation along the axis alone; in antiplane
/// motion it is the only translation.
fn rigid<const D: usize>(idealisation: Idealisation) -> Range<usize> {
    match idealisation {
        Idealisation::Axisymmetric => 1..2,
        Idealisation::Antiplane => 0..1,
        _ => 0..modes::<D>(),
    }
}

/// Displacement component `axis` at `x` of every rigid mode. Lengths are in units of the body size.
fn row<const D: usize>(x: [f64; D], axis: usize) -> Row {
    let mut row = vec![0.0; modes::<D>()];
    row[axis] = 1.0;
    if D == 2 {
        row[2] = if axis == 0 { -x[1] } else { x[0] };
    } else {
        // Rotation about axis k displaces component i by ε_ikj ω_k x_j.
        let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
        row[3 + j] = x[k];
        row[3 + k] = -x[j];
    }
    row
}

fn centred<const D: usize>(model: &Model<D>, nodes: &[usize]) -> impl Fn(usize) -> [f64; D] {
    let points: Vec<[f64; D]> = nodes.iter().map(|&n| model.mesh.nodes[n]).collect();
    let (min, max) = super::model::bounds(&points);
    let size = (0..D).map(|c| max[c] - min[c]).fold(0.0, f64::max);
    move |node| std::array::from_fn(|c| (model.mesh.nodes[node][c] - 0.5 * (min[c] + max[c])) / size)
}

fn condition_rows<const D: usize>(model: &Model<D>, nodes: &[usize], stage: &Stage) -> Vec<Row> {
    let position = centred(model, nodes);
    let components = model.idealisation.components();
    let pulled = stage.springs.iter().flat_map(|s| &s.dofs);
    let held = stage.fixed.iter().chain(pulled).filter(|&&d| nodes.binary_search(&(d / components)).is_ok());
    if model.idealisation == Idealisation::Antiplane {
        return held.map(|_| vec![1.0]).collect();
    }
    held.map(|&d| row(position(d / components), d % components)).collect()
}

/// Rows held by contact, which constrains the normal of each face. Friction also constrains the tangents.
fn contact_rows<const D: usize>(
    model: &Model<D>,
    nodes: &[usize],
    stage: &Stage,
    interfaces: &[PlannedInterface],
) -> Vec<Row> {
    let position = centred(model, nodes);
    let mut rows = Vec::new();
    for interface in interfaces {
        let friction = interface.law.is_some() && !stage.frictionless.contains(&interface.name);
        for MeshFace { nodes: face, .. } in interface.slave_faces.iter().chain(&interface.master_faces) {
            if nodes.binary_search(&face[0]).is_err() {
                continue;
            }
            let normal = model.face_normal(face);
            for &node in face {
                let components: Vec<Row> = (0..D).map(|axis| row(position(node), axis)).collect();
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

fn project(components: &[Row], normal: &[f64]) -> Row {
    let mut sum = vec![0.0; components[0].len()];
    for (component, n) in components.iter().zip(normal) {
        for (s, c) in sum.iter_mut().zip(component) {
            *s += n * c;
        }
    }
    sum
}

/// Description of a rigid motion that no row constrains, if there is one.
fn free_motion<const D: usize>(rows: &[Row], idealisation: Idealisation) -> Option<String> {
    let rigid = rigid::<D>(idealisation);
    let m = rigid.len();
    let mut gram = DMatrix::<f64>::zeros(m, m);
    for row in rows {
        let row = &row[rigid.clone()];
        for i in 0..m {
            for j in 0..m {
                gram[(i, j)] += row[i] * row[j];
            }
        }
    }
    let eigen = gram.symmetric_eigen();
    let largest = eigen.eigenvalues.max();
    let (k, &smallest) = eigen.eigenvalues.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1))?;
    if largest > 0.0 && smallest > FREE * largest {
        return None;
    }
    let mode = eigen.eigenvectors.column(k);
    let dominant = (0..m).max_by(|&i, &j| mode[i].abs().total_cmp(&mode[j].abs()))?;
    Some(match idealisation {
        Idealisation::Antiplane => "translation in z".into(),
        _ => name_of_mode::<D>(rigid.start + dominant),
    })
}

fn name_of_mode<const D: usize>(mode: usize) -> String {
    const AXES: [&str; 3] = ["x", "y", "z"];
    if mode < D {
        format!("translation in {}", AXES[mode])
    } else if D == 2 {
        "rotation in the plane".into()
    } else {
        format!("rotation about {}", AXES[mode - 3])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_fem::kinematics::Idealisation::{Antiplane, Axisymmetric, PlaneStrain};

    #[test]
    fn rows_of_three_dimensions_are_those_of_a_rotation() {
        // ω × x for ω = e_z is (-y, x, 0).
        let x = [0.3, 0.7, -0.2];
        assert_eq!((0..3).map(|i| row(x, i)[5]).collect::<Vec<_>>(), vec![-0.7, 0.3, 0.0]);
        assert_eq!((0..3).map(|i| row(x, i)[3]).collect::<Vec<_>>(), vec![0.0, 0.2, 0.7]);
    }

    #[test]
    fn a_line_of_rollers_leaves_the_translation_along_it() {
        let rows: Vec<Row> = [-0.5, 0.0, 0.5].iter().map(|&y| row([0.0, y], 0)).collect();
        assert_eq!(free_motion::<2>(&rows, PlaneStrain).as_deref(), Some("translation in y"));
        let held: Vec<Row> = rows.into_iter().chain([row([0.0, 0.5], 1)]).collect();
        assert_eq!(free_motion::<2>(&held, PlaneStrain), None);
    }

    #[test]
    fn about_an_axis_only_the_translation_along_it_is_rigid() {
        let radial = vec![row([0.5, 0.1], 0)];
        assert_eq!(free_motion::<2>(&radial, Axisymmetric).as_deref(), Some("translation in y"));
        assert_eq!(free_motion::<2>(&[row([0.5, 0.1], 1)], Axisymmetric), None);
    }

    #[test]
    fn in_antiplane_motion_one_node_holds_a_body() {
        assert_eq!(free_motion::<2>(&[], Antiplane).as_deref(), Some("translation in z"));
        assert_eq!(free_motion::<2>(&[vec![1.0]], Antiplane), None);
    }
}
