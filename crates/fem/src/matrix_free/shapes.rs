//! Stiffness of the cells of a block: gradients, shared matrices, or a matrix each.

use crate::block::LinearBlock;
use crate::element::ElementKind;
use crate::kinematics::Idealisation;
use crate::mesh::Mesh;
use std::collections::BTreeMap;

/// Difference of node positions, over the smallest extent of a cell, below which two cells have the same shape. Rounding of the
/// positions of a mesh of 1e5 cells along a side is some 1e-11 of a cell; the stiffness differs by as much as the shape.
const SAME: f64 = 1e-9;

/// Cells per shape from which matrices are shared. With fewer, groups of equal cells are too small to be treated together.
const SHARED: usize = 16;

/// True if many cells have one shape.
pub(super) fn few(shapes: usize, cells: usize) -> bool {
    shapes * SHARED <= cells
}

/// Number of matrices kept for this many shapes of this many cells.
fn kept(shapes: usize, cells: usize) -> usize {
    if few(shapes, cells) { shapes } else { cells }
}

/// True for cells whose gradients serve instead of matrices.
fn by_gradients(kind: ElementKind, idealisation: Idealisation) -> bool {
    matches!(kind, ElementKind::Tri3 | ElementKind::Tet4) && idealisation != Idealisation::Axisymmetric
}

/// Numbers kept for the cells of a block: gradients and a volume, or matrices.
pub(super) fn numbers<const D: usize>(block: &LinearBlock<D>, shapes: usize, cells: usize) -> usize {
    let (nodes, components) = (block.kind().nodes(), block.idealisation().components());
    if by_gradients(block.kind(), block.idealisation()) {
        return cells * (nodes * D + 1);
    }
    kept(shapes, cells) * (nodes * components).pow(2)
}

/// Stiffness of the cells of a block.
#[derive(Debug)]
pub(super) enum Shapes {
    /// Constant strain: G and the modulus of the dilatation \[Pa\].
    Simplex {
        /// G \[Pa\].
        shear: f64,
        /// λ, or its form of plane stress \[Pa\].
        dilatation: f64,
    },
    /// One matrix for each shape, and the shape of each cell.
    Shared {
        /// Matrices, one after another, row by row.
        matrices: Vec<f64>,
        /// Shape of each cell.
        shape: Vec<u32>,
        /// Degrees of freedom of a cell.
        size: usize,
    },
    /// One matrix for each cell.
    Own {
        /// Matrices, one after another, row by row.
        matrices: Vec<f64>,
        /// Degrees of freedom of a cell.
        size: usize,
    },
}

impl Shapes {
    /// Stiffness of the cells of a block with these shapes and first cells of each shape.
    pub fn from_block<const D: usize>(block: &LinearBlock<D>, shape: Vec<u32>, first: Vec<usize>) -> Self {
        if by_gradients(block.kind(), block.idealisation()) {
            let (shear, dilatation) = block.moduli_of_strain();
            return Self::Simplex { shear, dilatation };
        }
        let size = block.kind().nodes() * block.idealisation().components();
        if kept(first.len(), shape.len()) < shape.len() {
            return Self::Shared { matrices: block.stiffness_of(&first), shape, size };
        }
        let all: Vec<usize> = (0..shape.len()).collect();
        Self::Own { matrices: block.stiffness_of(&all), size }
    }

    /// Number of matrices.
    pub fn matrices(&self) -> usize {
        match self {
            Self::Simplex { .. } => 0,
            Self::Shared { matrices, size, .. } | Self::Own { matrices, size } => {
                matrices.len() / (size * size)
            }
        }
    }
}

/// Number of the shape of each cell, and the first cell of each shape. About an axis the stiffness depends on the position, and no two
/// cells share one.
pub(super) fn classes<const D: usize>(
    mesh: &Mesh<D>,
    block: usize,
    idealisation: Idealisation,
) -> (Vec<u32>, Vec<usize>) {
    let cells = &mesh.blocks[block];
    if idealisation == Idealisation::Axisymmetric {
        return ((0..cells.len() as u32).collect(), (0..cells.len()).collect());
    }
    let quantum = SAME * smallest_extent(mesh, block);
    let key = |cell: usize| -> Vec<i64> {
        let nodes = cells.cell(cell);
        let origin = &mesh.nodes[nodes[0]];
        let from_origin = |n: &usize| std::array::from_fn::<f64, D, _>(|c| mesh.nodes[*n][c] - origin[c]);
        nodes[1..].iter().flat_map(from_origin).map(|x| (x / quantum).round() as i64).collect()
    };
    let mut known: BTreeMap<Vec<i64>, u32> = BTreeMap::new();
    let mut first = Vec::new();
    let shape = (0..cells.len()).map(|cell| {
        *known.entry(key(cell)).or_insert_with(|| {
            first.push(cell);
            first.len() as u32 - 1
        })
    });
    (shape.collect(), first)
}

/// Smallest side of the bounding box of any cell \[m\].
fn smallest_extent<const D: usize>(mesh: &Mesh<D>, block: usize) -> f64 {
    let cells = &mesh.blocks[block];
    let extent = |cell: usize, axis: usize| {
        let along = || cells.cell(cell).iter().map(|&n| mesh.nodes[n][axis]);
        along().fold(f64::NEG_INFINITY, f64::max) - along().fold(f64::INFINITY, f64::min)
    };
    (0..cells.len())
        .flat_map(|cell| (0..D).map(move |axis| (cell, axis)))
        .map(|(c, a)| extent(c, a))
        .fold(f64::INFINITY, f64::min)
}
