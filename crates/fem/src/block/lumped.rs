//! Lumped masses: the integrals of ρ N_a, which sum to the mass of each cell.
//!
//! They are the row sums of the consistent mass. On quad9 and hex27 they equal nodal quadrature (Simpson's rule). The corners of
//! tri6, quad8, tet10, hex20 and wedge15 have none, or negative ones: explicit steps are unstable with those elements.

use super::geometry::{determinant, place};
use crate::element::ElementKind;
use crate::error::FemError;
use crate::kinematics::Idealisation;
use crate::mesh::Mesh;

/// Refuses an element without positive lumped masses.
///
/// # Errors
/// [`FemError::LumpedMass`].
pub fn admit(kind: ElementKind) -> Result<(), FemError> {
    let mut integrals = vec![0.0; kind.nodes()];
    for (xi, weight) in kind.mass_quadrature() {
        let shape = kind.shape(xi);
        integrals.iter_mut().zip(&shape.n).for_each(|(sum, n)| *sum += weight * n);
    }
    let total: f64 = integrals.iter().sum();
    // The corners of tri6 have none but for rounding.
    let least = f64::EPSILON.sqrt() * total;
    if integrals.iter().all(|m| *m > least) {
        Ok(())
    } else {
        Err(FemError::LumpedMass { element: kind.name() })
    }
}

/// Masses of the nodes of a cell, for a density \[kg/m³\]: \[kg, or kg/m of thickness\].
#[must_use]
pub fn cell_masses<const D: usize>(
    mesh: &Mesh<D>,
    block: usize,
    cell: usize,
    idealisation: Idealisation,
    density: f64,
) -> Vec<f64> {
    let cells = &mesh.blocks[block];
    let mut masses = vec![0.0; cells.kind.nodes()];
    for (xi, weight) in cells.kind.mass_quadrature() {
        let shape = cells.kind.shape(xi);
        let (x, j) = place(&mesh.nodes, cells.cell(cell), &shape);
        let mass = density * weight * determinant(&j) * idealisation.weight(&x);
        masses.iter_mut().zip(&shape.n).for_each(|(sum, n)| *sum += mass * n);
    }
    masses
}

/// Masses of all nodes of a mesh; `density` holds that of each block of cells \[kg/m³\].
///
/// # Errors
/// [`FemError::LumpedMass`].
pub fn nodal_masses<const D: usize>(
    mesh: &Mesh<D>,
    idealisation: Idealisation,
    density: &[f64],
) -> Result<Vec<f64>, FemError> {
    let mut masses = vec![0.0; mesh.nodes.len()];
    for (block, (cells, density)) in mesh.blocks.iter().zip(density).enumerate() {
        admit(cells.kind)?;
        for cell in 0..cells.len() {
            let own = cell_masses(mesh, block, cell, idealisation, *density);
            cells.cell(cell).iter().zip(own).for_each(|(&node, mass)| masses[node] += mass);
        }
    }
    Ok(masses)
}
