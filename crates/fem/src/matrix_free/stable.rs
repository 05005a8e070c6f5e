//! Highest frequency of a mesh of elastic cells with lumped masses, from above.
//!
//! The highest eigenvalue of M⁻¹K of the assembled mesh is at most the highest of any of its cells (Irons & Treharne 1971; Hughes,
//! The Finite Element Method, 1987, section 9.1). Central differences are stable for Δt < 2/ω.

use super::shapes::{classes, numbers};
use crate::FemError;
use crate::block::{LinearBlock, lumped};
use crate::mesh::Mesh;
use nalgebra::DMatrix;

/// Cells whose matrices are held at once.
const CHUNK: usize = 4096;

/// Highest frequency of any cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HighestFrequency {
    /// ω \[rad/s\].
    pub frequency: f64,
    /// Block of cells.
    pub block: usize,
    /// Cell in the block.
    pub cell: usize,
    /// Numbers that forces without an assembled matrix keep for the cells of all blocks.
    pub kept: usize,
}

/// Returns the highest frequency of any cell; `density` holds that of each block of cells \[kg/m³\].
///
/// # Errors
/// [`FemError::LumpedMass`].
pub fn highest_frequency<const D: usize>(
    mesh: &Mesh<D>,
    blocks: &[&LinearBlock<D>],
    density: &[f64],
) -> Result<HighestFrequency, FemError> {
    let mut highest = HighestFrequency { frequency: 0.0, block: 0, cell: 0, kept: 0 };
    for (k, (block, density)) in blocks.iter().zip(density).enumerate() {
        lumped::admit(block.kind())?;
        let size = block.kind().nodes() * block.idealisation().components();
        let (shape, first) = classes(mesh, k, block.idealisation());
        highest.kept += numbers(block, first.len(), shape.len());
        for cells in first.chunks(CHUNK) {
            let matrices = block.stiffness_of(cells);
            for (matrix, &cell) in matrices.chunks_exact(size * size).zip(cells) {
                let mass = lumped::cell_masses(mesh, k, cell, block.idealisation(), *density);
                let above = highest.frequency * highest.frequency;
                if let Some(square) = exceeds(matrix, &mass, above) {
                    highest = HighestFrequency { frequency: square.sqrt(), block: k, cell, ..highest };
                }
            }
        }
    }
    Ok(highest)
}

/// Highest eigenvalue of M⁻¹K of a cell if it exceeds `above` \[1/s²\].
fn exceeds(k: &[f64], mass: &[f64], above: f64) -> Option<f64> {
    let size = k.len().isqrt();
    let components = size / mass.len();
    let scale: Vec<f64> = (0..size).map(|i| 1.0 / mass[i / components].sqrt()).collect();
    let scaled = DMatrix::from_fn(size, size, |i, j| k[i * size + j] * scale[i] * scale[j]);
    // Rows bound the eigenvalues (Gershgorin); most cells need no more than that.
    let bound = scaled.row_iter().map(|row| row.iter().map(|x| x.abs()).sum()).fold(0.0, f64::max);
    if bound <= above {
        return None;
    }
    let highest = scaled.symmetric_eigenvalues().max();
    (highest > above).then_some(highest)
}
