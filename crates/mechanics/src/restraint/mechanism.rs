//! Motions of several parts of bodies that leave all contacts as they are.
//!
//! The unknowns are the amplitudes of the rigid motions of all parts that their conditions do not hold. A row states what a
//! condition or a closed contact resists: for contact, the motion of the slave against the master, along the normal, and in all
//! directions with friction. A vector that all rows annihilate is a motion that nothing resists. Contact counts as if it held in
//! tension too, so that a motion is free whichever points are open.

use super::rigid::{FREE, Frame, Row, condition_rows, free_motion, modes, name_of_mode, project, rigid, row};
use crate::{Model, PlannedInterface, Stage, bounds};
use asperity_fem::kinematics::Idealisation;
use asperity_fem::mesh::MeshFace;
use nalgebra::DMatrix;

/// Amplitude relative to the largest below which a part rests, and two motions are the same. It exceeds what a pivot of [`FREE`]
/// leaves of a motion, its square root.
const SAME: f64 = 1e-4;

/// True for the points of an interface that are closed, by the numbers of the interface and of the point.
pub(super) type ClosureTest<'a> = &'a dyn Fn(usize, usize) -> bool;

/// Faces whose normals contact holds.
#[derive(Clone, Copy)]
pub(super) enum Reach<'a> {
    /// Those of the slave, at its closed points.
    SlaveFaces(ClosureTest<'a>),
    /// Those of the master, all of them.
    MasterFaces,
}

/// Interfaces, and what closes them.
#[derive(Clone, Copy)]
pub(super) struct Contact<'a> {
    pub interfaces: &'a [PlannedInterface],
    pub reach: Reach<'a>,
}

/// A motion that nothing resists.
pub(super) struct Mechanism {
    /// Numbers of the parts that move, ascending.
    pub moving: Vec<usize>,
    /// Description of the motion of the first, or of all if they move as one.
    pub motion: String,
    pub as_one: bool,
}

/// Finds a motion that nothing resists in a stage. `parts` has the nodes of each part, ascending.
pub(super) fn find<const D: usize>(
    model: &Model<D>,
    stage: &Stage,
    parts: &[&[usize]],
    contact: Contact<'_>,
) -> Option<Mechanism> {
    let system = System::new(model, stage, parts, contact);
    let amplitudes = null_vector(system.gram.clone(), &system.scales())?;
    let motions: Vec<Row> = (0..parts.len()).map(|p| system.motion(p, &amplitudes)).collect();
    let size = |m: &Row| m.iter().fold(0.0, |most: f64, a| most.max(a.abs()));
    let largest = motions.iter().map(size).fold(0.0, f64::max);
    let moving: Vec<usize> = (0..parts.len()).filter(|&p| size(&motions[p]) > SAME * largest).collect();
    let common = common_motions(model, parts, &moving, &motions);
    let as_one = common.iter().all(|m| is_same(m, &common[0]));
    let shown = if as_one { &common[0] } else { &motions[*moving.first()?] };
    Some(Mechanism { motion: described::<D>(shown, model.idealisation), moving, as_one })
}

/// Amplitudes of the moving parts in one common frame.
fn common_motions<const D: usize>(
    model: &Model<D>,
    parts: &[&[usize]],
    moving: &[usize],
    motions: &[Row],
) -> Vec<Row> {
    let nodes: Vec<usize> = moving.iter().flat_map(|&p| parts[p].iter().copied()).collect();
    let Frame { centre, size } = Frame::new(model, &nodes);
    let seen = |p: usize| {
        let own = Frame::new(model, parts[p]);
        // Displacement component `axis` at the centre, moved by the common size along `towards`.
        let at = |axis: usize, towards: Option<usize>| {
            let mut x = centre;
            towards.into_iter().for_each(|c| x[c] += size);
            row(own.place(&x), axis).iter().zip(&motions[p]).map(|(r, a)| r * a).sum::<f64>()
        };
        let turn = |axis: usize, along: usize| at(axis, Some(along)) - at(axis, None);
        let turns: Vec<f64> = match D {
            2 => vec![turn(1, 0)],
            _ => (0..D).map(|k| turn((k + 2) % D, (k + 1) % D)).collect(),
        };
        (0..D).map(|axis| at(axis, None)).chain(turns).collect()
    };
    moving.iter().map(|&p| seen(p)).collect()
}

fn is_same(a: &Row, b: &Row) -> bool {
    let largest = b.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= SAME * largest)
}

/// Name of the mode with the largest amplitude.
fn described<const D: usize>(motion: &Row, idealisation: Idealisation) -> String {
    let largest = rigid::<D>(idealisation).max_by(|&i, &j| motion[i].abs().total_cmp(&motion[j].abs()));
    name_of_mode::<D>(largest.unwrap_or(0))
}

/// Gram matrix of the rows of all parts that conditions do not hold.
struct System<'a, const D: usize> {
    model: &'a Model<D>,
    /// Frame of each part.
    frames: Vec<Frame<D>>,
    /// Part of each node.
    part: Vec<usize>,
    /// First unknown of each part; `None` if conditions hold it.
    first: Vec<Option<usize>>,
    gram: DMatrix<f64>,
}

/// A row as pairs of an unknown and a value.
type SparseRow = Vec<(usize, f64)>;

impl<'a, const D: usize> System<'a, D> {
    fn new(model: &'a Model<D>, stage: &Stage, parts: &[&[usize]], contact: Contact<'_>) -> Self {
        let conditions: Vec<Vec<Row>> =
            parts.iter().map(|nodes| condition_rows(model, nodes, stage)).collect();
        let mut unknowns = 0;
        let mut first = Vec::new();
        for rows in &conditions {
            let free = free_motion::<D>(rows, model.idealisation).is_some();
            first.push(free.then_some(unknowns));
            unknowns += if free { rigid::<D>(model.idealisation).len() } else { 0 };
        }
        let mut part = vec![0; model.mesh.nodes.len()];
        for (p, nodes) in parts.iter().enumerate() {
            nodes.iter().for_each(|&n| part[n] = p);
        }
        let frames = parts.iter().map(|nodes| Frame::new(model, nodes)).collect();
        let mut system = Self { model, frames, part, first, gram: DMatrix::zeros(unknowns, unknowns) };
        if unknowns == 0 {
            return system;
        }
        for (p, rows) in conditions.into_iter().enumerate() {
            system.add(&rows.into_iter().map(|row| system.entries(p, &row, 1.0)).collect::<Vec<_>>());
        }
        for (k, interface) in contact.interfaces.iter().enumerate() {
            system.add(&system.contact_rows(interface, interface.rubs(stage), k, contact.reach));
        }
        system
    }

    /// Adds rows with equal weights whose sum is one, so that few rows count as much as many.
    fn add(&mut self, rows: &[SparseRow]) {
        for row in rows {
            for &(i, a) in row {
                row.iter().for_each(|&(j, b)| self.gram[(i, j)] += a * b / rows.len() as f64);
            }
        }
    }

    /// Entries of a row of rigid motions of a part.
    fn entries(&self, part: usize, row: &Row, factor: f64) -> SparseRow {
        let Some(first) = self.first[part] else { return Vec::new() };
        let own = rigid::<D>(self.model.idealisation).map(|mode| factor * row[mode]);
        own.enumerate().map(|(k, value)| (first + k, value)).collect()
    }

    /// Rows of the motion of slave against master at the nodes of the faces of an interface.
    fn contact_rows(
        &self,
        interface: &PlannedInterface,
        friction: bool,
        number: usize,
        reach: Reach<'_>,
    ) -> Vec<SparseRow> {
        let (faces, others) = match reach {
            Reach::SlaveFaces(_) => (&interface.slave_faces, &interface.master_faces),
            Reach::MasterFaces => (&interface.master_faces, &interface.slave_faces),
        };
        let closed = |node: usize| match reach {
            Reach::MasterFaces => true,
            Reach::SlaveFaces(closed) => {
                interface.slave.binary_search_by_key(&node, |s| s.0).is_ok_and(|p| closed(number, p))
            }
        };
        let partners = self.partners(others);
        let mut rows = Vec::new();
        for MeshFace { nodes: face, .. } in faces {
            let normal = self.model.face_normal(face);
            for &node in face.iter().filter(|n| closed(**n)) {
                let own = self.part[node];
                let Some(other) = self.nearest(&partners, node) else { continue };
                if own == other || (self.first[own].is_none() && self.first[other].is_none()) {
                    continue;
                }
                let x = self.model.mesh.nodes[node];
                let directions = |part: usize| -> Vec<Row> {
                    let components = self.frames[part].rows(&x);
                    if friction { components } else { vec![project(&components, &normal)] }
                };
                for (a, b) in directions(own).iter().zip(&directions(other)) {
                    rows.push([self.entries(own, a, 1.0), self.entries(other, b, -1.0)].concat());
                }
            }
        }
        rows
    }

    /// Parts with faces of one side, each with the bounds of these faces.
    fn partners(&self, faces: &[MeshFace]) -> Vec<(usize, [[f64; D]; 2])> {
        let mut nodes: Vec<Vec<[f64; D]>> = vec![Vec::new(); self.frames.len()];
        for &node in faces.iter().flat_map(|face| &face.nodes) {
            nodes[self.part[node]].push(self.model.mesh.nodes[node]);
        }
        let own = nodes.iter().enumerate().filter(|(_, nodes)| !nodes.is_empty());
        own.map(|(part, nodes)| (part, <[_; 2]>::from(bounds(nodes)))).collect()
    }

    /// Part whose faces are closest to a node, by their bounds.
    fn nearest(&self, partners: &[(usize, [[f64; D]; 2])], node: usize) -> Option<usize> {
        let x = self.model.mesh.nodes[node];
        let distance = |[min, max]: &[[f64; D]; 2]| -> f64 {
            (0..D).map(|c| (min[c] - x[c]).max(x[c] - max[c]).max(0.0).powi(2)).sum()
        };
        partners.iter().min_by(|a, b| distance(&a.1).total_cmp(&distance(&b.1))).map(|p| p.0)
    }

    /// Largest diagonal entry of the part of each unknown.
    fn scales(&self) -> Vec<f64> {
        let each = rigid::<D>(self.model.idealisation).len();
        let largest = |k: usize| (k..k + each).map(|i| self.gram[(i, i)]).fold(0.0, f64::max);
        (0..self.gram.nrows()).map(|i| largest(i / each * each)).collect()
    }

    /// Amplitudes of all modes of a part.
    fn motion(&self, part: usize, amplitudes: &[f64]) -> Row {
        let mut motion = vec![0.0; modes::<D>()];
        if let Some(first) = self.first[part] {
            let own = rigid::<D>(self.model.idealisation).enumerate();
            own.for_each(|(k, mode)| motion[mode] = amplitudes[first + k]);
        }
        motion
    }
}

/// A vector that a positive semidefinite matrix annihilates. The last unknowns are eliminated first, so that it moves as few parts
/// as it may, and translates them rather than turning them.
fn null_vector(mut a: DMatrix<f64>, scales: &[f64]) -> Option<Vec<f64>> {
    let n = a.nrows();
    let mut held = vec![true; n];
    for k in (0..n).rev() {
        let pivot = a[(k, k)];
        held[k] = pivot > FREE * scales[k];
        if !held[k] {
            continue;
        }
        for i in 0..k {
            let factor = a[(i, k)] / pivot;
            if factor != 0.0 {
                (0..k).for_each(|j| a[(i, j)] -= factor * a[(k, j)]);
            }
        }
    }
    let free = held.iter().position(|h| !h)?;
    let mut x = vec![0.0; n];
    x[free] = 1.0;
    for k in free + 1..n {
        if held[k] {
            x[k] = -(free..k).map(|i| a[(k, i)] * x[i]).sum::<f64>() / a[(k, k)];
        }
    }
    Some(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_null_vector_is_annihilated_and_absent_if_the_matrix_is_regular() {
        // Two equal springs in a row, free at both ends, and one that holds the end.
        let chain = DMatrix::from_row_slice(3, 3, &[1.0, -1.0, 0.0, -1.0, 2.0, -1.0, 0.0, -1.0, 1.0]);
        assert_eq!(null_vector(chain.clone(), &[2.0; 3]), Some(vec![1.0; 3]));
        let held = chain + DMatrix::from_partial_diagonal(3, 3, &[1.0]);
        assert_eq!(null_vector(held, &[2.0; 3]), None);
    }
}
