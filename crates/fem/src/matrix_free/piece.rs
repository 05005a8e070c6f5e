//! Cells of a piece, with the numbers of its nodes and the forces on them.

use super::displacements::Displacements;
use super::product::{self, WIDE};
use super::shapes::Shapes;
use super::simplex;
use super::tetrahedra::{self, Gradients, Quad, Tetrahedra};
use crate::element::MOST_NODES;
use crate::mesh::Mesh;
use pulp::{Arch, Simd, WithSimd};

/// Groups of cells gathered before the first of them is computed: numbers written one by one cannot be read as vectors at once.
const BATCH: usize = 4;

/// Most degrees of freedom of a cell.
const MOST: usize = 3 * MOST_NODES;

/// Cells that lie close together.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    /// Nodes: first those whose forces are wanted, ascending, then the others, ascending.
    nodes: Vec<u32>,
    /// Number of nodes whose forces are wanted.
    own: usize,
    /// Entry of each of these among the forces of all pieces.
    slots: Vec<u32>,
    groups: Vec<Group>,
    /// Nodes of a cell.
    corners: usize,
}

/// Room for the displacements and forces of the nodes of a piece, and for those of a batch of its cells.
#[derive(Debug, Default)]
pub(super) struct Room {
    u: Vec<f64>,
    /// Forces of the last piece, node by node.
    pub forces: Vec<f64>,
    lanes: Lanes,
    /// Displacements and forces of the nodes of a piece of tetrahedra.
    quads: [Vec<Quad>; 2],
}

/// Displacements and forces of a batch of cells, degree of freedom by degree of freedom. It is kept from group to group: clearing it
/// would cost more than small groups of cells.
#[derive(Debug, Default)]
struct Lanes {
    x: Vec<[f64; WIDE]>,
    y: Vec<[f64; WIDE]>,
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
    /// Tetrahedra: moduli (G, λ), and gradients of each [`WIDE`] cells.
    Tetrahedra { moduli: (f64, f64), gradients: Vec<Gradients> },
    /// Triangles: moduli (G, λ), then for each [`WIDE`] cells their gradients and volumes.
    Simplex { moduli: (f64, f64), gradients: Vec<[f64; WIDE]> },
    /// One matrix for all cells.
    Shared(Vec<f64>),
    /// One matrix for each cell.
    Own(Vec<f64>),
}

impl Piece {
    /// Piece of the given cells of block `k`. Forces on `regular` nodes are not wanted.
    pub fn new<const D: usize>(
        mesh: &Mesh<D>,
        k: usize,
        shapes: &Shapes,
        regular: &[bool],
        cells: &[usize],
    ) -> Self {
        let block = &mesh.blocks[k];
        let mut nodes: Vec<u32> =
            cells.iter().flat_map(|&cell| block.cell(cell).iter().map(|&n| n as u32)).collect();
        let order = |n: u32| (regular[n as usize], n);
        nodes.sort_unstable_by_key(|&n| order(n));
        nodes.dedup();
        let own = nodes.partition_point(|&n| !regular[n as usize]);
        let local = |cell: usize| {
            let find = |&n: &usize| nodes.binary_search_by_key(&order(n as u32), |&n| order(n));
            let numbered = block.cell(cell).iter().map(find);
            numbered.map(|n| n.map_or(0, |n| n as u16)).collect::<Vec<u16>>()
        };
        let connectivity = |cells: &[usize]| cells.iter().flat_map(|&cell| local(cell)).collect();
        let corners = block.kind.nodes();
        let groups = match shapes {
            Shapes::Simplex { shear, dilatation } => {
                let moduli = (*shear, *dilatation);
                let kind = if D == 3 {
                    Kind::Tetrahedra { moduli, gradients: tetrahedra::gradients(mesh, k, cells) }
                } else {
                    Kind::Simplex { moduli, gradients: gradients(mesh, k, cells) }
                };
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
        Self { nodes, own, slots: Vec::new(), groups, corners }
    }

    /// Nodes whose forces are wanted, ascending.
    pub fn nodes(&self) -> &[u32] {
        &self.nodes[..self.own]
    }

    /// Memory \[bytes\].
    pub fn bytes(&self) -> usize {
        let of_group = |g: &Group| {
            let numbers = match &g.kind {
                Kind::Tetrahedra { gradients, .. } => size_of_val(&gradients[..]) / size_of::<f64>(),
                Kind::Simplex { gradients, .. } => gradients.len() * WIDE,
                Kind::Shared(matrix) | Kind::Own(matrix) => matrix.len(),
            };
            2 * g.connectivity.len() + 8 * numbers
        };
        4 * (self.nodes.len() + self.own) + self.groups.iter().map(of_group).sum::<usize>()
    }

    /// Entries of the nodes among the forces of all pieces.
    pub fn slots(&self) -> &[u32] {
        &self.slots
    }

    /// Gives each node its entry.
    pub fn place(&mut self, entry: impl FnMut(&u32) -> u32) {
        self.slots = self.nodes().iter().map(entry).collect();
    }

    /// Computes the forces of the cells on the nodes of the piece at displacements of all nodes, C components each. Cells find
    /// both in `room` by numbers of two bytes.
    pub fn forces<const C: usize>(&self, all: &Displacements<'_>, room: &mut Room) {
        room.u.resize(self.nodes.len() * C, 0.0);
        room.forces.resize(self.nodes.len() * C, 0.0);
        if let [Group { connectivity, kind: Kind::Tetrahedra { moduli, gradients } }] = &self.groups[..] {
            let cells = connectivity.as_chunks().0;
            let [u, forces] = &mut room.quads;
            u.clear();
            u.extend(self.nodes.iter().map(|&node| tetrahedra::quad(all.node::<C>(node as usize))));
            forces.clear();
            forces.resize(u.len(), [0.0; 4]);
            Arch::new().dispatch(Tetrahedra { cells, moduli: *moduli, gradients, u, forces });
            let own = room.forces.as_chunks_mut::<C>().0.iter_mut().zip(forces);
            own.for_each(|(own, force)| own.copy_from_slice(&force[..C]));
            return;
        }
        for (own, &node) in room.u.as_chunks_mut::<C>().0.iter_mut().zip(&self.nodes) {
            *own = all.node(node as usize);
        }
        let Room { u, forces, lanes, .. } = room;
        Arch::new().dispatch(Evaluation::<C> { piece: self, u, forces, lanes });
    }
}

/// Cells of each shape, ascending.
fn by_shape(shape: &[u32], cells: &[usize]) -> Vec<(u32, Vec<usize>)> {
    let mut sorted = cells.to_vec();
    sorted.sort_by_key(|&cell| (shape[cell], cell));
    let groups = sorted.chunk_by(|a, b| shape[*a] == shape[*b]);
    groups.map(|group| (shape[group[0]], group.to_vec())).collect()
}

/// Gradients and volumes of triangles, [`WIDE`] cells after [`WIDE`]; missing cells at the end have no volume.
fn gradients<const D: usize>(mesh: &Mesh<D>, k: usize, cells: &[usize]) -> Vec<[f64; WIDE]> {
    let stride = D * D + 1;
    let mut result = vec![[0.0; WIDE]; cells.len().div_ceil(WIDE) * stride];
    for (at, &cell) in cells.iter().enumerate() {
        let (gradients, volume) = simplex::gradients(mesh, mesh.blocks[k].cell(cell));
        let lanes = &mut result[at / WIDE * stride..][..stride];
        for a in 0..D {
            for j in 0..D {
                lanes[a * D + j][at % WIDE] = gradients[(j, a)];
            }
        }
        lanes[D * D][at % WIDE] = volume;
    }
    result
}

/// Forces on the nodes of a piece at their displacements, C components a node.
struct Evaluation<'a, const C: usize> {
    piece: &'a Piece,
    u: &'a [f64],
    forces: &'a mut [f64],
    lanes: &'a mut Lanes,
}

impl<const C: usize> WithSimd for Evaluation<'_, C> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let corners = self.piece.corners;
        let (u, _) = self.u.as_chunks::<C>();
        let (forces, _) = self.forces.as_chunks_mut::<C>();
        forces.fill([0.0; C]);
        for group in &self.piece.groups {
            let cells = (corners, group.connectivity.as_slice());
            match &group.kind {
                Kind::Simplex { moduli, gradients } => triangles(cells, (*moduli, gradients), u, forces),
                // Pieces of tetrahedra have no other cells, and a form of displacements of their own.
                Kind::Tetrahedra { .. } => {}
                Kind::Shared(matrix) => shared(simd, cells, matrix, (u, forces), self.lanes),
                Kind::Own(matrices) => own(cells, matrices, u, forces),
            }
        }
    }
}

/// Gathers the displacements of up to [`WIDE`] cells, degree of freedom by degree of freedom.
#[inline(always)]
fn gather<const C: usize>((corners, cells): (usize, &[u16]), u: &[[f64; C]], x: &mut [[f64; WIDE]]) {
    let (x, _) = x.as_chunks_mut::<C>();
    for (l, cell) in cells.chunks_exact(corners).take(WIDE).enumerate() {
        for (x, &node) in x.iter_mut().zip(cell) {
            let from = &u[node as usize];
            for c in 0..C {
                x[c][l] = from[c];
            }
        }
    }
}

/// Adds the forces of up to [`WIDE`] cells.
#[inline(always)]
fn scatter<const C: usize>((corners, cells): (usize, &[u16]), y: &[[f64; WIDE]], forces: &mut [[f64; C]]) {
    let (y, _) = y.as_chunks::<C>();
    for (l, cell) in cells.chunks_exact(corners).take(WIDE).enumerate() {
        for (y, &node) in y.iter().zip(cell) {
            let force = &mut forces[node as usize];
            for c in 0..C {
                force[c] += y[c][l];
            }
        }
    }
}

#[inline(always)]
fn shared<S: Simd, const C: usize>(
    simd: S,
    (corners, cells): (usize, &[u16]),
    k: &[f64],
    (u, forces): (&[[f64; C]], &mut [[f64; C]]),
    Lanes { x, y }: &mut Lanes,
) {
    let (n, wide) = (corners * C, WIDE * corners);
    x.resize(BATCH * n, [0.0; WIDE]);
    y.resize(BATCH * n, [0.0; WIDE]);
    for cells in cells.chunks(BATCH * wide) {
        for (cells, x) in cells.chunks(wide).zip(x.chunks_exact_mut(n)) {
            gather((corners, cells), u, x);
        }
        for (x, y) in x.chunks_exact(n).zip(y.chunks_exact_mut(n)).take(cells.len().div_ceil(wide)) {
            product::shared(simd, k, n, x.as_flattened(), y.as_flattened_mut());
        }
        for (cells, y) in cells.chunks(wide).zip(y.chunks_exact(n)) {
            scatter((corners, cells), y, forces);
        }
    }
}

#[inline(always)]
fn own<const C: usize>(
    (corners, cells): (usize, &[u16]),
    matrices: &[f64],
    u: &[[f64; C]],
    forces: &mut [[f64; C]],
) {
    let n = corners * C;
    let (mut x, mut y) = ([0.0; MOST], [0.0; MOST]);
    for (cell, k) in cells.chunks_exact(corners).zip(matrices.chunks_exact(n * n)) {
        for (x, &node) in x.as_chunks_mut::<C>().0.iter_mut().zip(cell) {
            *x = u[node as usize];
        }
        product::own(k, &x[..n], &mut y[..n]);
        for (y, &node) in y.as_chunks::<C>().0.iter().zip(cell) {
            forces[node as usize].iter_mut().zip(y).for_each(|(f, y)| *f += y);
        }
    }
}

#[inline(always)]
fn triangles<const C: usize>(
    (corners, cells): (usize, &[u16]),
    (moduli, gradients): ((f64, f64), &[[f64; WIDE]]),
    u: &[[f64; C]],
    forces: &mut [[f64; C]],
) {
    const STRIDE: usize = 2 * 2 + 1;
    let (mut x, mut y) = ([[[0.0; WIDE]; 6]; BATCH], [[[0.0; WIDE]; 6]; BATCH]);
    let wide = WIDE * corners;
    for (cells, gradients) in cells.chunks(BATCH * wide).zip(gradients.chunks(BATCH * STRIDE)) {
        for (cells, x) in cells.chunks(wide).zip(&mut x) {
            gather((corners, cells), u, x);
        }
        for (gradients, (x, y)) in gradients.chunks_exact(STRIDE).zip(x.iter().zip(&mut y)) {
            if C == 1 {
                simplex::antiplane::<2>(moduli.0, gradients, x, y);
            } else {
                simplex::forces::<2>(moduli.0, moduli.1, gradients, x, y);
            }
        }
        for (cells, y) in cells.chunks(wide).zip(&y) {
            scatter((corners, cells), y, forces);
        }
    }
}
