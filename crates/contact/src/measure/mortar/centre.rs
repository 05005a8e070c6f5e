//! Middles of faces of eight nodes, which have no node there.
//!
//! Such a face is divided into quadrilaterals that meet in its middle, as one of nine nodes is. With mid-nodes in the middles of
//! straight edges these are the images of its quarters, which triangles between mid-nodes are not. The position of the middle is the
//! one its shape functions give it: half the sum of the mid-nodes minus a quarter of the corners'. Middles are numbered after the
//! nodes of the interface.

use crate::SegmentKind;
use crate::spec::Segment;
use crate::vector::axpy;

/// Values of the shape functions of a face of eight nodes in its middle.
const SHARES: [f64; 8] = [-0.25, -0.25, -0.25, -0.25, 0.5, 0.5, 0.5, 0.5];

/// Middles of faces of eight nodes.
#[derive(Clone, Debug)]
pub(super) struct Centres {
    /// Number of nodes of the interface.
    nodes: usize,
    /// Nodes of the face of each middle.
    faces: Vec<[usize; 8]>,
}

impl Centres {
    /// Middles of an interface of this many nodes, none yet.
    pub(super) fn new(nodes: usize) -> Self {
        Self { nodes, faces: Vec::new() }
    }

    /// Adds the middle of a face with its position, if it has eight nodes. Returns its number.
    pub(super) fn add<const D: usize>(&mut self, face: &Segment, x: &mut Vec<[f64; D]>) -> Option<usize> {
        if face.kind != SegmentKind::Quad8 {
            return None;
        }
        self.faces.push(std::array::from_fn(|k| face.nodes[k]));
        x.push(self.mean(self.nodes + self.faces.len() - 1, x));
        Some(x.len() - 1)
    }

    /// Positions of nodes, with those of the middles after them.
    pub(super) fn extended<const D: usize>(&self, x: &[[f64; D]]) -> Vec<[f64; D]> {
        let mut out = x.to_vec();
        out.resize(self.nodes + self.faces.len(), [0.0; D]);
        self.follow(&mut out);
        out
    }

    /// Moves the middles to where the nodes are.
    pub(super) fn follow<const D: usize>(&self, x: &mut [[f64; D]]) {
        for number in self.nodes..self.nodes + self.faces.len() {
            x[number] = self.mean(number, x);
        }
    }

    /// Value of a field `v` of the nodes at a node or middle.
    pub(super) fn mean<const D: usize>(&self, number: usize, v: &[[f64; D]]) -> [f64; D] {
        let Some(face) = self.face(number) else { return v[number] };
        let mut out = [0.0; D];
        face.iter().zip(SHARES).for_each(|(&n, c)| axpy(&mut out, c, &v[n]));
        out
    }

    /// Nodes of the face of a middle; `None` for a node.
    fn face(&self, number: usize) -> Option<&[usize; 8]> {
        number.checked_sub(self.nodes).map(|k| &self.faces[k])
    }
}

/// Local numbers of the nodes of a face of this kind whose motion moves its node `slot`, or the middle after them, with their shares.
pub(super) fn movers(kind: SegmentKind, slot: usize) -> impl Iterator<Item = (usize, f64)> {
    let middle = kind == SegmentKind::Quad8 && slot == 8;
    let own = (!middle).then_some((slot, 1.0));
    own.into_iter().chain(SHARES.into_iter().enumerate().take(if middle { 8 } else { 0 }))
}
