//! Cells of a piece, with the numbers of its nodes and the forces on them.

use super::product::{self, WIDE};
use super::shapes::Shapes;
use super::simplex;
use crate::element::MOST_NODES;
use crate::mesh::Mesh;
use nalgebra::SMatrix;
use pulp::{Arch, Simd, WithSimd};

/// Most degrees of freedom of a cell.
const MOST: usize = 3 * MOST_NODES;

/// Cells that lie close together.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    /// Nodes, ascending.
    nodes: Vec<u32>,
    groups: Vec<Group>,
    /// Nodes of a cell.
    corners: usize,
    components: usize,
}

/// Cells that are treated alike.
#[derive(Clone, Debug)]
struct Group {
    /// Nodes of the cells among those of the piece, cell by cell.
    connectivity: Vec<u16>,
    kind: Kind,
}

#[derive(Clone, Debug)]
enum Kind {
    /// Moduli (G, λ), then for each [`WIDE`] cells their gradients and volumes.
    Simplex { moduli: (f64, f64), gradients: Vec<[f64; WIDE]> },
    /// One matrix for all cells.
    Shared(Vec<f64>),
    /// One matrix for each cell.
    Own(Vec<f64>),
}

impl Piece {
    /// Piece of the given cells of block `k`, with so many components of displacement.
    pub fn new<const D: usize>(
        mesh: &Mesh<D>,
        (k, components): (usize, usize),
        shapes: &Shapes,
        cells: &[usize],
    ) -> Self {
        let block = &mesh.blocks[k];
        let mut nodes: Vec<u32> =
            cells.iter().flat_map(|&cell| block.cell(cell).iter().map(|&n| n as u32)).collect();
        nodes.sort_unstable();
        nodes.dedup();
        let local = |cell: usize| {
            let numbered = block.cell(cell).iter().map(|&n| nodes.binary_search(&(n as u32)));
            numbered.map(|n| n.map_or(0, |n| n as u16)).collect::<Vec<u16>>()
        };
        let connectivity = |cells: &[usize]| cells.iter().flat_map(|&cell| local(cell)).collect();
        let corners = block.kind.nodes();
        let groups = match shapes {
            Shapes::Simplex { shear, dilatation } => {
                let gradients = gradients(mesh, k, cells);
                let kind = Kind::Simplex { moduli: (*shear, *dilatation), gradients };
                vec![Group { connectivity: connectivity(cells), kind }]
            }
            Shapes::Shared { matrices, shape, size } => {
                let length = size * size;
                let group = |(shape, cells): (u32, Vec<usize>)| Group {
                    connectivity: connectivity(&cells),
                    kind: Kind::Shared(matrices[shape as usize * length..][..length].to_vec()),
                };
                by_shape(shape, cells).into_iter().map(group).collect()
            }
            Shapes::Own { matrices, size } => {
                let length = size * size;
                let own = cells.iter().flat_map(|&cell| matrices[cell * length..][..length].iter().copied());
                let kind = Kind::Own(own.collect());
                vec![Group { connectivity: connectivity(cells), kind }]
            }
        };
        Self { nodes, groups, corners, components }
    }

    /// Nodes, ascending.
    pub fn nodes(&self) -> &[u32] {
        &self.nodes
    }

    /// Memory \[bytes\].
    pub fn bytes(&self) -> usize {
        let of_group = |g: &Group| {
            let numbers = match &g.kind {
                Kind::Simplex { gradients, .. } => gradients.len() * WIDE,
                Kind::Shared(matrix) | Kind::Own(matrix) => matrix.len(),
            };
            2 * g.connectivity.len() + 8 * numbers
        };
        4 * self.nodes.len() + self.groups.iter().map(of_group).sum::<usize>()
    }

    /// Writes the forces of the cells on the nodes of the piece at displacements `u` of all nodes.
    pub fn forces(&self, u: &[f64], forces: &mut [f64]) {
        Arch::new().dispatch(Evaluation { piece: self, u, forces });
    }
}

/// Cells of each shape, ascending.
fn by_shape(shape: &[u32], cells: &[usize]) -> Vec<(u32, Vec<usize>)> {
    let mut sorted = cells.to_vec();
    sorted.sort_by_key(|&cell| (shape[cell], cell));
    let groups = sorted.chunk_by(|a, b| shape[*a] == shape[*b]);
    groups.map(|group| (shape[group[0]], group.to_vec())).collect()
}

/// Gradients and volumes of simplices, [`WIDE`] cells after [`WIDE`]; missing cells at the end have no volume.
fn gradients<const D: usize>(mesh: &Mesh<D>, k: usize, cells: &[usize]) -> Vec<[f64; WIDE]> {
    let stride = D * D + 1;
    let mut result = vec![[0.0; WIDE]; cells.len().div_ceil(WIDE) * stride];
    for (at, &cell) in cells.iter().enumerate() {
        let nodes = mesh.blocks[k].cell(cell);
        let origin = &mesh.nodes[nodes[0]];
        let edges = SMatrix::<f64, D, D>::from_fn(|a, i| mesh.nodes[nodes[a + 1]][i] - origin[i]);
        // Rows of the inverse are axes, columns nodes; an inverted cell was refused when the block was made.
        let inverse = edges.try_inverse().unwrap_or_else(|| edges.map(|_| f64::NAN));
        let factorial = if D == 2 { 2.0 } else { 6.0 };
        let lanes = &mut result[at / WIDE * stride..][..stride];
        for a in 0..D {
            for j in 0..D {
                lanes[a * D + j][at % WIDE] = inverse[(j, a)];
            }
        }
        lanes[D * D][at % WIDE] = crate::block::determinant(&edges) / factorial;
    }
    result
}

struct Evaluation<'a> {
    piece: &'a Piece,
    u: &'a [f64],
    forces: &'a mut [f64],
}

impl WithSimd for Evaluation<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { piece, u, forces } = self;
        forces.fill(0.0);
        for group in &piece.groups {
            match &group.kind {
                Kind::Simplex { moduli, gradients } => {
                    simplices(piece, group, (*moduli, gradients), u, forces)
                }
                Kind::Shared(matrix) => shared(simd, piece, group, matrix, u, forces),
                Kind::Own(matrices) => own(piece, group, matrices, u, forces),
            }
        }
    }
}

/// Gathers the displacements of up to [`WIDE`] cells, degree of freedom by degree of freedom.
#[inline(always)]
fn gather(piece: &Piece, cells: &[u16], u: &[f64], x: &mut [[f64; WIDE]]) {
    let components = piece.components;
    for (l, cell) in cells.chunks_exact(piece.corners).enumerate() {
        for (a, &node) in cell.iter().enumerate() {
            let at = piece.nodes[node as usize] as usize * components;
            for (c, value) in u[at..at + components].iter().enumerate() {
                x[a * components + c][l] = *value;
            }
        }
    }
}

/// Adds the forces of up to [`WIDE`] cells.
#[inline(always)]
fn scatter(piece: &Piece, cells: &[u16], y: &[[f64; WIDE]], forces: &mut [f64]) {
    let components = piece.components;
    for (l, cell) in cells.chunks_exact(piece.corners).enumerate() {
        for (a, &node) in cell.iter().enumerate() {
            let at = node as usize * components;
            for (c, force) in forces[at..at + components].iter_mut().enumerate() {
                *force += y[a * components + c][l];
            }
        }
    }
}

#[inline(always)]
fn shared<S: Simd>(simd: S, piece: &Piece, group: &Group, k: &[f64], u: &[f64], forces: &mut [f64]) {
    let n = piece.corners * piece.components;
    let (mut x, mut y) = ([[0.0; WIDE]; MOST], [[0.0; WIDE]; MOST]);
    for cells in group.connectivity.chunks(WIDE * piece.corners) {
        gather(piece, cells, u, &mut x);
        product::shared(simd, k, n, x.as_flattened(), y.as_flattened_mut());
        scatter(piece, cells, &y, forces);
    }
}

#[inline(always)]
fn own(piece: &Piece, group: &Group, matrices: &[f64], u: &[f64], forces: &mut [f64]) {
    let components = piece.components;
    let n = piece.corners * components;
    let (mut x, mut y) = ([0.0; MOST], [0.0; MOST]);
    for (cell, k) in group.connectivity.chunks_exact(piece.corners).zip(matrices.chunks_exact(n * n)) {
        for (x, &node) in x.chunks_exact_mut(components).zip(cell) {
            x.copy_from_slice(&u[piece.nodes[node as usize] as usize * components..][..components]);
        }
        product::own(k, &x[..n], &mut y[..n]);
        for (y, &node) in y.chunks_exact(components).zip(cell) {
            let force = &mut forces[node as usize * components..][..components];
            force.iter_mut().zip(y).for_each(|(f, y)| *f += y);
        }
    }
}

#[inline(always)]
fn simplices(
    piece: &Piece,
    group: &Group,
    (moduli, gradients): ((f64, f64), &[[f64; WIDE]]),
    u: &[f64],
    forces: &mut [f64],
) {
    let dimension = piece.corners - 1;
    let stride = dimension * dimension + 1;
    let (mut x, mut y) = ([[0.0; WIDE]; 12], [[0.0; WIDE]; 12]);
    let groups = group.connectivity.chunks(WIDE * piece.corners).zip(gradients.chunks_exact(stride));
    for (cells, gradients) in groups {
        gather(piece, cells, u, &mut x);
        match (dimension, piece.components) {
            (2, 1) => simplex::antiplane::<2>(moduli.0, gradients, &x, &mut y),
            (2, _) => simplex::forces::<2>(moduli, gradients, &x, &mut y),
            _ => simplex::forces::<3>(moduli, gradients, &x, &mut y),
        }
        scatter(piece, cells, &y, forces);
    }
}
