//! Distances of a discrete solution from a known field.

use super::LinearBlock;
use super::geometry::{determinant, place};
use crate::element::Shape;
use crate::mesh::Mesh;

/// Components of a displacement \[m\] and its gradient `[c][j]` = ∂u_c/∂x_j \[-\] at a position.
pub type FieldValue = ([f64; 3], [[f64; 3]; 3]);

impl<const D: usize> LinearBlock<D> {
    /// Distance of the nodal displacements `u` from `exact`: the L2 norm of the displacement, √∫ |u_h - u|² dV \[m^(1+D/2)\], and of
    /// its gradient (the H1 seminorm), √∫ |∇u_h - ∇u|² dV \[m^(D/2)\]. About an axis, dV is 2πr dr dz. The rule has degree 7 in each
    /// variable. It is finer than that of the stiffness, at whose points gradients are most accurate.
    pub fn error_norms(
        &self,
        mesh: &Mesh<D>,
        u: &[f64],
        exact: impl Fn(&[f64; D]) -> FieldValue,
    ) -> [f64; 2] {
        let kind = self.cells.kind;
        let rule: Vec<_> = kind.fine_quadrature().into_iter().map(|(xi, w)| (kind.shape(xi), w)).collect();
        let mut sums = [0.0; 2];
        for cell in 0..self.cells.len() {
            for (shape, weight) in &rule {
                let squares = self.squares(mesh, cell, shape, u, &exact);
                sums.iter_mut().zip(squares).for_each(|(sum, s)| *sum += weight * s);
            }
        }
        sums.map(f64::sqrt)
    }

    /// Squared differences at a point, times the volume that belongs to a unit of natural coordinates.
    fn squares(
        &self,
        mesh: &Mesh<D>,
        cell: usize,
        shape: &Shape,
        u: &[f64],
        exact: &impl Fn(&[f64; D]) -> FieldValue,
    ) -> [f64; 2] {
        let (nodes, components) = (self.cells.cell(cell), self.idealisation.components());
        let (x, j) = place(&mesh.nodes, nodes, shape);
        let volume = determinant(&j) * self.idealisation.weight(&x);
        let (value, gradient) = exact(&x);
        // Inverted cells were refused when the block was made; a NaN would show in the sum.
        let inverse = j.try_inverse().unwrap_or_else(|| j.map(|_| f64::NAN));
        let mut squares = [0.0; 2];
        for c in 0..components {
            let (mut found, mut natural) = (0.0, [0.0; D]);
            for ((&node, n), dn) in nodes.iter().zip(&shape.n).zip(&shape.dn) {
                let displacement = u[node * components + c];
                found += n * displacement;
                natural.iter_mut().zip(dn).for_each(|(g, d)| *g += d * displacement);
            }
            squares[0] += volume * (found - value[c]).powi(2);
            for k in 0..D {
                let slope: f64 = (0..D).map(|m| natural[m] * inverse[(m, k)]).sum();
                squares[1] += volume * (slope - gradient[c][k]).powi(2);
            }
        }
        squares
    }

    /// Root of the volume integral of |σ_h - σ|² over the quadrature points of the stiffness, xx, yy, zz, xy, yz, zx with the
    /// shears counted twice \[Pa m^(D/2)\].
    pub fn stress_error(&self, u: &[f64], exact: impl Fn(&[f64; D]) -> [f64; 6]) -> f64 {
        let mut sum = 0.0;
        for cell in 0..self.cells.len() {
            for (state, x) in self.cell_state(cell, u).zip(self.geometry().cell(cell).positions) {
                let squares = state.stress.iter().zip(exact(x)).enumerate().map(|(k, (s, e))| {
                    let times = if k < 3 { 1.0 } else { 2.0 };
                    times * (s - e).powi(2)
                });
                sum += state.volume * squares.sum::<f64>();
            }
        }
        sum.sqrt()
    }
}
