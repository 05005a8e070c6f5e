//! Forces of linear elastic bodies, K u, without an assembled matrix: the product of each step of explicit dynamics.
//!
//! Cells are divided into pieces of fixed size that lie close together, so that a piece finds its displacements in the cache. A piece
//! writes the forces of its own nodes, and a second pass adds the pieces that share a node, in order: the result does not depend on
//! the number of threads. Nodes of grids are computed row by row instead ([`stencil`]), and cells whose nodes are all of these
//! belong to no piece. Within a piece cells are treated in groups:
//! - constant-strain simplices by their gradients ([`simplex`], [`tetrahedra`]);
//! - cells of equal shape by one stiffness matrix, several cells at once ([`product`]);
//! - other cells by a matrix each.

mod displacements;
mod partial;
mod partition;
mod piece;
mod product;
mod runs;
mod shapes;
mod simplex;
mod stable;
mod stencil;
mod tetrahedra;

pub use displacements::Displacements;
pub use stable::{HighestFrequency, highest_frequency};

use crate::block::LinearBlock;
use crate::mesh::Mesh;
use partial::Partial;
use piece::{Piece, Room};
use rayon::prelude::*;
use shapes::Shapes;
use stencil::Stencils;

/// Forces K u of the linear blocks of a mesh. Degree of freedom = node * components + component.
#[derive(Clone, Debug)]
pub struct MatrixFree {
    components: usize,
    stencils: Stencils,
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
        let classes = runs::classes_of(mesh, blocks);
        let runs = runs::find(mesh, components, blocks, &classes);
        let stencils = Stencils::new(mesh.nodes.len(), components, &runs);
        let regular = runs.nodes(mesh.nodes.len());
        let mut pieces = Vec::new();
        let (mut cells, mut matrices) = (0, 0);
        for (k, (block, classes)) in blocks.iter().zip(classes).enumerate() {
            let (Some(block), Some((shape, first))) = (block, classes) else { continue };
            let shapes = Shapes::from_block(block, shape, first);
            cells += mesh.blocks[k].len();
            matrices += shapes.matrices();
            let parts = partition::pieces(mesh, k, &regular);
            let piece = |part: &Vec<usize>| Piece::new(mesh, k, &shapes, &regular, part);
            let made: Vec<Piece> = parts.par_iter().map(piece).collect();
            pieces.extend(made);
        }
        let starts = place(mesh.nodes.len(), &mut pieces);
        let length: usize = pieces.iter().map(|p| p.nodes().len() * components).sum();
        Self { components, stencils, pieces, partial: Partial::new(length), starts, cells, matrices }
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

    /// Computes the forces at displacements; [`MatrixFree::force`] reads them.
    pub fn evaluate(&mut self, u: &Displacements<'_>) {
        match self.components {
            1 => self.evaluate_of::<1>(u),
            2 => self.evaluate_of::<2>(u),
            _ => self.evaluate_of::<3>(u),
        }
    }

    fn evaluate_of<const C: usize>(&mut self, u: &Displacements<'_>) {
        self.stencils.evaluate::<C>(u);
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
        let mut force = self.stencils.force_of::<C>(node);
        let others = self.partial.sum::<C>(self.starts[node], self.starts[node + 1]);
        force.iter_mut().zip(others).for_each(|(force, other)| *force += other);
        force
    }

    /// Reads the forces on as many nodes from `first` on at the last evaluation \[N, or N/m of thickness\].
    #[inline(always)]
    pub fn read<const C: usize>(&self, first: usize, forces: &mut [[f64; C]]) {
        self.stencils.read(first, forces);
        let starts = &self.starts[first..first + forces.len() + 1];
        if starts[0] == starts[forces.len()] {
            return;
        }
        for (force, bounds) in forces.iter_mut().zip(starts.windows(2)) {
            let others = self.partial.sum::<C>(bounds[0], bounds[1]);
            force.iter_mut().zip(others).for_each(|(force, other)| *force += other);
        }
    }

    /// Writes K u.
    pub fn apply(&mut self, u: &[f64], forces: &mut [f64]) {
        self.evaluate(&Displacements::plain(u));
        for (node, force) in forces.chunks_exact_mut(self.components).enumerate() {
            for (component, force) in force.iter_mut().enumerate() {
                *force = self.force(node, component);
            }
        }
    }

    /// Memory \[bytes\].
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.pieces_bytes() + self.stencils.bytes() + self.partial.len() * size_of::<f64>()
    }

    /// Bytes that an evaluation reads and writes besides displacements if each value moves once, forces once in and once out \[bytes\].
    #[must_use]
    pub fn moved(&self) -> usize {
        self.pieces_bytes() + 2 * size_of::<f64>() * (self.partial.len() + self.stencils.forces())
    }

    /// Memory of the pieces without forces \[bytes\].
    fn pieces_bytes(&self) -> usize {
        self.pieces.iter().map(Piece::bytes).sum::<usize>() + self.starts.len() * size_of::<u32>()
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
