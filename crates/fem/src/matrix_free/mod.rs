//! Forces of linear elastic bodies, K u, without an assembled matrix: the product of each step of explicit dynamics.
//!
//! Cells are divided into pieces of fixed size that lie close together, so that a piece finds its displacements in the cache. A piece
//! writes the forces of its own nodes, and a second pass adds the pieces that share a node, in order: the result does not depend on
//! the number of threads. Within a piece cells are treated in groups:
//! - constant-strain simplices by their gradients ([`simplex`]);
//! - cells of equal shape by one stiffness matrix, several cells at once ([`product`]);
//! - other cells by a matrix each.

mod partial;
mod partition;
mod piece;
mod product;
mod shapes;
mod simplex;
mod stable;

pub use stable::{Highest, highest_frequency};

use crate::block::LinearBlock;
use crate::mesh::Mesh;
use partial::Partial;
use piece::{Piece, Room};
use rayon::prelude::*;
use shapes::Shapes;

/// Forces K u of the linear blocks of a mesh. Degree of freedom = node * components + component.
#[derive(Clone, Debug)]
pub struct MatrixFree {
    components: usize,
    pieces: Vec<Piece>,
    /// Forces of the pieces on each node, in the order of the pieces.
    partial: Partial,
    /// Start of the entries of each node in `partial`; one more than there are nodes.
    starts: Vec<u32>,
    cells: usize,
    matrices: usize,
}

impl MatrixFree {
    /// Prepares the products. `blocks` holds the linear block for each block of cells of the mesh, and `None` where a block is not
    /// linear; those cells exert no force here.
    #[must_use]
    pub fn new<const D: usize>(
        mesh: &Mesh<D>,
        components: usize,
        blocks: &[Option<&LinearBlock<D>>],
    ) -> Self {
        let mut pieces = Vec::new();
        let (mut cells, mut matrices) = (0, 0);
        for (k, block) in blocks.iter().enumerate() {
            let Some(block) = block else { continue };
            let shapes = Shapes::of(mesh, k, block);
            cells += mesh.blocks[k].len();
            matrices += shapes.matrices();
            let parts = partition::pieces(mesh, k);
            let piece = |part: &Vec<usize>| Piece::new(mesh, k, &shapes, part);
            let made: Vec<Piece> = parts.par_iter().map(piece).collect();
            pieces.extend(made);
        }
        let starts = place(mesh.nodes.len(), &mut pieces);
        let length: usize = pieces.iter().map(|p| p.nodes().len() * components).sum();
        Self { components, pieces, partial: Partial::new(length), starts, cells, matrices }
    }

    /// Number of cells.
    #[must_use]
    pub fn cells(&self) -> usize {
        self.cells
    }

    /// Number of stiffness matrices kept; 0 where gradients serve.
    #[must_use]
    pub fn matrices(&self) -> usize {
        self.matrices
    }

    /// Computes the forces at displacements `u` \[m\]; [`MatrixFree::force`] reads them.
    pub fn evaluate(&mut self, u: &[f64]) {
        match self.components {
            1 => self.evaluate_of::<1>(u),
            2 => self.evaluate_of::<2>(u),
            _ => self.evaluate_of::<3>(u),
        }
    }

    fn evaluate_of<const C: usize>(&self, u: &[f64]) {
        self.pieces.par_iter().for_each_init(Room::default, |room, piece| {
            piece.forces::<C>(u, room);
            self.partial.write::<C>(piece.slots(), &room.forces);
        });
    }

    /// Force on a component of a node at the last evaluation \[N, or N/m of thickness\].
    #[inline]
    #[must_use]
    pub fn force(&self, node: usize, component: usize) -> f64 {
        match self.components {
            1 => self.force_of::<1>(node)[component],
            2 => self.force_of::<2>(node)[component],
            _ => self.force_of::<3>(node)[component],
        }
    }

    /// Forces on a node of C components at the last evaluation.
    #[inline]
    #[must_use]
    pub fn force_of<const C: usize>(&self, node: usize) -> [f64; C] {
        self.partial.sum(self.starts[node], self.starts[node + 1])
    }

    /// Writes K u.
    pub fn apply(&mut self, u: &[f64], forces: &mut [f64]) {
        self.evaluate(u);
        for (node, force) in forces.chunks_exact_mut(self.components).enumerate() {
            for (component, force) in force.iter_mut().enumerate() {
                *force = self.force(node, component);
            }
        }
    }

    /// Memory \[bytes\].
    #[must_use]
    pub fn bytes(&self) -> usize {
        let own: usize = self.pieces.iter().map(Piece::bytes).sum();
        own + self.partial.len() * size_of::<f64>() + self.starts.len() * size_of::<u32>()
    }
}

/// Gives each node of each piece its entry, node by node and in the order of the pieces; returns the first entry of each node.
fn place(nodes: usize, pieces: &mut [Piece]) -> Vec<u32> {
    let mut starts = vec![0_u32; nodes + 1];
    let all = pieces.iter().flat_map(Piece::nodes);
    all.for_each(|&node| starts[node as usize + 1] += 1);
    for k in 0..nodes {
        starts[k + 1] += starts[k];
    }
    let mut next = starts.clone();
    for piece in pieces {
        piece.place(|&node| {
            let entry = next[node as usize];
            next[node as usize] += 1;
            entry
        });
    }
    starts
}

#[cfg(test)]
mod tests;
