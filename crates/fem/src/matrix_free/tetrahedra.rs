//! Forces of constant-strain tetrahedra of any shape, as many cells at once as a vector has numbers.
//!
//! Displacements and forces of a node take four numbers, the last of which is zero: those of as many nodes as a vector has numbers
//! are then transposed in registers, where gathering them one by one would cost more than all products. Gradients are scaled by
//! the square root of the volume, so that `f_a = V σ g_a` needs no volume.

use super::product::WIDE;
use super::simplex;
use crate::mesh::Mesh;
use pulp::bytemuck::{cast_slice, cast_slice_mut};
use pulp::{Simd, WithSimd};

/// Components of a vector, then zero.
pub(super) type Quad = [f64; 4];

/// For each node after the first and each axis the scaled gradients of [`WIDE`] cells.
pub(super) type Gradients = [[f64; WIDE]; 9];

/// Vector with a zero after its components.
#[inline(always)]
pub(super) fn quad<const C: usize>(v: [f64; C]) -> Quad {
    std::array::from_fn(|c| v.get(c).copied().unwrap_or(0.0))
}

/// Scaled gradients of cells of block `k`; missing cells at the end have none.
pub(super) fn gradients<const D: usize>(mesh: &Mesh<D>, k: usize, cells: &[usize]) -> Vec<Gradients> {
    let mut result = vec![[[0.0; WIDE]; 9]; cells.len().div_ceil(WIDE)];
    for (at, &cell) in cells.iter().enumerate() {
        let (gradients, volume) = simplex::gradients(mesh, mesh.blocks[k].cell(cell));
        let scale = volume.sqrt();
        // Columns are nodes.
        for (lanes, gradient) in result[at / WIDE].iter_mut().zip(&gradients) {
            lanes[at % WIDE] = scale * gradient;
        }
    }
    result
}

/// Tetrahedra of a piece, with the displacements of its nodes and the forces on them.
pub(super) struct Tetrahedra<'a> {
    /// Nodes of each cell.
    pub cells: &'a [[u16; 4]],
    /// G and λ \[Pa\].
    pub moduli: (f64, f64),
    pub gradients: &'a [Gradients],
    pub u: &'a [Quad],
    pub forces: &'a mut [Quad],
}

impl WithSimd for Tetrahedra<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        let (whole, rest) = self.cells.as_chunks::<WIDE>();
        let (all, last) = self.gradients.split_at(whole.len());
        for (cells, gradients) in whole.iter().zip(all) {
            self.add(simd, cells, gradients);
        }
        if let Some(gradients) = last.first() {
            // Cells that are missing have no gradients and exert no force, on whatever nodes.
            let mut cells = [[0; 4]; WIDE];
            cells[..rest.len()].copy_from_slice(rest);
            self.add(simd, &cells, gradients);
        }
    }
}

// Loops instead of closures, into which the compiler does not always carry the instructions of the processor.
impl Tetrahedra<'_> {
    /// Adds the forces of [`WIDE`] cells.
    #[inline(always)]
    fn add<S: Simd>(&mut self, simd: S, cells: &[[u16; 4]; WIDE], gradients: &Gradients) {
        for (part, cells) in cells.chunks_exact(S::F64_LANES).enumerate() {
            let mut g = [[simd.splat_f64s(0.0); 3]; 3];
            for (g, lanes) in g.as_flattened_mut().iter_mut().zip(gradients) {
                *g = S::as_simd_f64s(lanes).0[part];
            }
            let forces = self.cell_forces(simd, cells, &g);
            self.scatter(simd, cells, forces);
        }
    }

    /// Forces on the nodes of as many cells as a vector has numbers.
    #[inline(always)]
    fn cell_forces<S: Simd>(&self, simd: S, cells: &[[u16; 4]], g: &[[S::f64s; 3]; 3]) -> [[S::f64s; 3]; 4] {
        let none = simd.splat_f64s(0.0);
        let origin = self.gather(simd, cells, 0);
        let mut strain = [[none; 3]; 3];
        for (a, g) in g.iter().enumerate() {
            let x = self.gather(simd, cells, a + 1);
            for i in 0..3 {
                let difference = simd.sub_f64s(x[i], origin[i]);
                for j in 0..3 {
                    strain[i][j] = simd.mul_add_e_f64s(difference, g[j], strain[i][j]);
                }
            }
        }
        let stress = self.stress(simd, &strain);
        let mut forces = [[none; 3]; 4];
        for (a, g) in g.iter().enumerate() {
            for i in 0..3 {
                let force = dot(simd, &stress[i], g);
                forces[a + 1][i] = force;
                forces[0][i] = simd.sub_f64s(forces[0][i], force);
            }
        }
        forces
    }

    /// `σ = λ tr H I + G (H + Hᵀ)` of gradients H of displacements.
    #[inline(always)]
    fn stress<S: Simd>(&self, simd: S, h: &[[S::f64s; 3]; 3]) -> [[S::f64s; 3]; 3] {
        let (shear, dilatation) = (simd.splat_f64s(self.moduli.0), simd.splat_f64s(self.moduli.1));
        let trace = simd.add_f64s(simd.add_f64s(h[0][0], h[1][1]), h[2][2]);
        let mut stress = [[simd.mul_f64s(dilatation, trace); 3]; 3];
        for i in 0..3 {
            let twice = simd.add_f64s(h[i][i], h[i][i]);
            stress[i][i] = simd.mul_add_e_f64s(shear, twice, stress[i][i]);
            for j in 0..i {
                stress[i][j] = simd.mul_f64s(shear, simd.add_f64s(h[i][j], h[j][i]));
                stress[j][i] = stress[i][j];
            }
        }
        stress
    }

    /// Components of the displacements of a node of each cell.
    #[inline(always)]
    fn gather<S: Simd>(&self, simd: S, cells: &[[u16; 4]], node: usize) -> [S::f64s; 4] {
        let mut by_cells = [simd.splat_f64s(0.0); 4];
        let quads = cast_slice_mut::<S::f64s, Quad>(&mut by_cells);
        for (quad, cell) in quads.iter_mut().zip(cells) {
            *quad = self.u[cell[node] as usize];
        }
        simd.deinterleave_shfl_f64s(by_cells)
    }

    /// Adds the forces on the nodes of each cell, cell by cell: sums do not depend on how many numbers a vector has.
    #[inline(always)]
    fn scatter<S: Simd>(&mut self, simd: S, cells: &[[u16; 4]], forces: [[S::f64s; 3]; 4]) {
        let none = simd.splat_f64s(0.0);
        let mut by_cells = [[none; 4]; 4];
        for (by_cells, [x, y, z]) in by_cells.iter_mut().zip(forces) {
            *by_cells = simd.interleave_shfl_f64s([x, y, z, none]);
        }
        let [first, second, third, fourth] = by_cells.each_ref().map(|v| cast_slice::<S::f64s, Quad>(v));
        let quads = first.iter().zip(second).zip(third.iter().zip(fourth));
        for (nodes, ((first, second), (third, fourth))) in cells.iter().zip(quads) {
            for (&node, quad) in nodes.iter().zip([first, second, third, fourth]) {
                let force = &mut self.forces[node as usize];
                // All four are read before any is written, so that one instruction adds them.
                *force = [force[0] + quad[0], force[1] + quad[1], force[2] + quad[2], force[3] + quad[3]];
            }
        }
    }
}

/// `a·b` of vectors of three components.
#[inline(always)]
fn dot<S: Simd>(simd: S, a: &[S::f64s; 3], b: &[S::f64s; 3]) -> S::f64s {
    let first = simd.mul_f64s(a[0], b[0]);
    simd.mul_add_e_f64s(a[2], b[2], simd.mul_add_e_f64s(a[1], b[1], first))
}
