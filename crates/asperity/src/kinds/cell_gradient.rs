//! Displacement gradients in cells.

use asperity_fem::mesh::Cells;
use asperity_mechanics::Model;
use nalgebra::DMatrix;

/// Displacement gradient at a place in a cell.
pub(super) struct CellGradient {
    /// ∂u_i/∂x_j \[-\].
    pub gradient: DMatrix<f64>,
    /// Determinant of the Jacobian \[m^D\].
    pub jacobian: f64,
}

impl CellGradient {
    /// Gradient at natural coordinates of a cell, of displacements `u` of all degrees of freedom \[m\].
    pub(super) fn new<const D: usize>(
        model: &Model<D>,
        cells: &Cells,
        cell: usize,
        at: [f64; 3],
        u: &[f64],
    ) -> Self {
        let shape = cells.kind.shape(at);
        let (mut jacobian, mut natural) = (DMatrix::<f64>::zeros(D, D), DMatrix::<f64>::zeros(D, D));
        for (a, &node) in cells.cell(cell).iter().enumerate() {
            for i in 0..D {
                for m in 0..D {
                    jacobian[(i, m)] += model.mesh.nodes[node][i] * shape.dn[a][m];
                    natural[(i, m)] += u[node * D + i] * shape.dn[a][m];
                }
            }
        }
        let determinant = jacobian.determinant();
        // A cell whose Jacobian cannot be inverted is refused when the bodies are built.
        let gradient =
            jacobian.try_inverse().map_or_else(|| DMatrix::zeros(D, D), |inverse| natural * inverse);
        Self { gradient, jacobian: determinant }
    }
}
