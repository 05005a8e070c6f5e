//! Forces of linear elastic bodies, K u, without an assembled matrix: the product of each step of explicit dynamics.
//!
//! Cells are divided into pieces of fixed size that lie close together, so that a piece finds its displacements in the cache. A piece
//! writes the forces of its own nodes, and a second pass adds the pieces that share a node, in order: the result does not depend on
//! the number of threads. Within a piece cells are treated in groups:
//! - constant-strain simplices by their gradients ([`simplex`]);
//! - cells of equal shape by one stiffness matrix, several cells at once ([`product`]);
//! - other cells by a matrix each.

mod partition;
mod piece;
mod product;
mod shapes;
mod simplex;
mod stable;

pub use stable::{Highest, highest_frequency};

use crate::block::LinearBlock;
use crate::mesh::Mesh;
use piece::Piece;
use rayon::prelude::*;
use shapes::Shapes;

/// Forces K u of the linear blocks of a mesh. Degree of freedom = node * components + component.
#[derive(Clone, Debug)]
pub struct MatrixFree {
    components: usize,
    pieces: Vec<Piece>,
    /// Forces of the nodes of all pieces, piece by piece.
    partial: Vec<f64>,
    /// Start of the entries of each node in `entries`; one more than there are nodes.
    starts: Vec<u32>,
    /// Positions in `partial` of the first component of each node, in the order of the pieces.
    entries: Vec<u32>,
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
            let piece = |part: &Vec<usize>| Piece::new(mesh, (k, components), &shapes, part);
            let made: Vec<Piece> = parts.par_iter().map(piece).collect();
            pieces.extend(made);
        }
        let (starts, entries) = entries(mesh.nodes.len(), components, &pieces);
        let length = pieces.iter().map(|p| p.nodes().len() * components).sum();
        Self { components, pieces, partial: vec![0.0; length], starts, entries, cells, matrices }
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
        let components = self.components;
        let mut rest = self.partial.as_mut_slice();
        let mut work = Vec::with_capacity(self.pieces.len());
        for piece in &self.pieces {
            let (own, after) = std::mem::take(&mut rest).split_at_mut(piece.nodes().len() * components);
            work.push((piece, own));
            rest = after;
        }
        work.into_par_iter().for_each(|(piece, forces)| piece.forces(u, forces));
    }

    /// Force on a component of a node at the last evaluation \[N, or N/m of thickness\].
    #[inline]
    #[must_use]
    pub fn force(&self, node: usize, component: usize) -> f64 {
        let entries = &self.entries[self.starts[node] as usize..self.starts[node + 1] as usize];
        entries.iter().map(|&e| self.partial[e as usize + component]).sum()
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
        own + self.partial.len() * size_of::<f64>()
            + (self.starts.len() + self.entries.len()) * size_of::<u32>()
    }
}

/// Positions of the forces of each node among those of all pieces.
fn entries(nodes: usize, components: usize, pieces: &[Piece]) -> (Vec<u32>, Vec<u32>) {
    let mut starts = vec![0_u32; nodes + 1];
    let all = || pieces.iter().flat_map(Piece::nodes);
    all().for_each(|&node| starts[node as usize + 1] += 1);
    for k in 0..nodes {
        starts[k + 1] += starts[k];
    }
    let mut next = starts.clone();
    let mut entries = vec![0_u32; starts[nodes] as usize];
    for (k, &node) in all().enumerate() {
        let at = &mut next[node as usize];
        entries[*at as usize] = (k * components) as u32;
        *at += 1;
    }
    (starts, entries)
}

#[cfg(test)]
mod tests;
