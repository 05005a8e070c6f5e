//! Consistent mass of cells: `M_ab = ∫ ρ N_a N_b dV` for each component of the displacement.
//!
//! The integral is over the reference configuration. Mass is conserved, so that the matrix is that of any deformation. The rules
//! are exact for cells with straight, evenly divided sides. About an axis the factor r raises the degree by one: on tri3 the
//! masses of constant and of linear velocities are still exact.

use crate::element::Shape;
use crate::kinematics::Idealisation;
use crate::mesh::{Cells, Mesh};
use crate::term::{Blocks, Pattern};
use nalgebra::SMatrix;

/// Consistent mass of some blocks of cells: a dense block of `pattern` for each cell and component.
#[derive(Clone, Debug)]
pub struct Mass {
    pattern: Pattern,
    /// Entries of the blocks one after another, row by row \[kg, or kg/m of thickness\].
    values: Vec<f64>,
}

/// Consistent mass of the blocks of a mesh; `density` has one entry per block \[kg/m³\]. Degree of freedom = node * components +
/// component.
#[must_use]
pub fn consistent<const D: usize>(mesh: &Mesh<D>, density: &[f64], idealisation: Idealisation) -> Mass {
    let components = idealisation.components();
    let (mut blocks, mut values) = (Blocks::default(), Vec::new());
    for (cells, &density) in mesh.blocks.iter().zip(density) {
        let kind = cells.kind;
        let rule: Vec<_> = kind.mass_quadrature().into_iter().map(|(xi, w)| (kind.shape(xi), w)).collect();
        let mut one = vec![0.0; kind.nodes() * kind.nodes()];
        for cell in 0..cells.len() {
            write_cell_mass(mesh, (cells, cell), &rule, (density, idealisation), &mut one);
            for c in 0..components {
                blocks.push(cells.cell(cell).iter().map(|&node| node * components + c));
                values.extend_from_slice(&one);
            }
        }
    }
    Mass { pattern: blocks.into(), values }
}

/// Writes the mass of one component of a cell, row by row.
fn write_cell_mass<const D: usize>(
    mesh: &Mesh<D>,
    (cells, cell): (&Cells, usize),
    rule: &[(Shape, f64)],
    (density, idealisation): (f64, Idealisation),
    mass: &mut [f64],
) {
    let (nodes, n) = (cells.cell(cell), cells.kind.nodes());
    mass.fill(0.0);
    for (shape, weight) in rule {
        let (mut x, mut j) = ([0.0; D], SMatrix::<f64, D, D>::zeros());
        for (a, &node) in nodes.iter().enumerate() {
            for (i, at) in mesh.nodes[node].iter().enumerate() {
                x[i] += at * shape.n[a];
                (0..D).for_each(|m| j[(i, m)] += at * shape.dn[a][m]);
            }
        }
        let volume = density * weight * determinant(&j) * idealisation.weight(&x);
        for (row, na) in mass.chunks_exact_mut(n).zip(&shape.n) {
            row.iter_mut().zip(&shape.n).for_each(|(m, nb)| *m += volume * na * nb);
        }
    }
}

/// Determinant of a 2x2 or 3x3 matrix.
fn determinant<const D: usize>(j: &SMatrix<f64, D, D>) -> f64 {
    let minor = |a: usize, b: usize| j[(1, a)] * j[(2, b)] - j[(1, b)] * j[(2, a)];
    match D {
        2 => j[(0, 0)] * j[(1, 1)] - j[(0, 1)] * j[(1, 0)],
        _ => j[(0, 0)] * minor(1, 2) - j[(0, 1)] * minor(0, 2) + j[(0, 2)] * minor(0, 1),
    }
}

impl Mass {
    /// Degrees of freedom of the blocks.
    #[must_use]
    pub fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    /// Entries of the blocks one after another, row by row \[kg, or kg/m of thickness\].
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// M v, in the order of the cells.
    #[must_use]
    pub fn times(&self, v: &[f64]) -> Vec<f64> {
        let (mut product, mut offset) = (vec![0.0; v.len()], 0);
        for block in self.pattern.blocks() {
            let n = block.len();
            for (row, &dof) in self.values[offset..offset + n * n].chunks_exact(n).zip(block) {
                product[dof] += row.iter().zip(block).map(|(m, &other)| m * v[other]).sum::<f64>();
            }
            offset += n * n;
        }
        product
    }

    /// v·M w.
    #[must_use]
    pub fn product(&self, v: &[f64], w: &[f64]) -> f64 {
        self.times(w).iter().zip(v).map(|(m, v)| m * v).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::element::ElementKind;

    /// One cell of each kind at its natural coordinates, sheared a little.
    fn cell<const D: usize>(kind: ElementKind) -> Mesh<D> {
        let place =
            |x: &[f64; 3]| std::array::from_fn(|i| x[i] + if i == 0 { 2.0 + 0.3 * x[1] } else { 0.0 });
        let nodes = kind.node_coordinates().iter().map(place).collect();
        let cells = Cells { kind, connectivity: (0..kind.nodes()).collect() };
        Mesh { nodes, blocks: vec![cells], ..Mesh::default() }
    }

    fn check<const D: usize>(kind: ElementKind, idealisation: Idealisation) {
        let (mesh, components) = (cell::<D>(kind), idealisation.components());
        let mass = consistent(&mesh, &[3.0], idealisation);
        let fine = kind.fine_quadrature();
        let integral = |f: &dyn Fn(&[f64; D]) -> f64| -> f64 {
            let at = |xi: &[f64; 3]| -> [f64; D] {
                let shape = kind.shape(*xi);
                std::array::from_fn(|i| mesh.nodes.iter().zip(&shape.n).map(|(x, n)| n * x[i]).sum())
            };
            fine.iter().map(|(xi, w)| 3.0 * w * idealisation.weight(&at(xi)) * f(&at(xi))).sum()
        };
        let field = |f: &dyn Fn(&[f64; D]) -> f64, c: usize| -> Vec<f64> {
            let of =
                |x: &[f64; D]| (0..components).map(|k| if k == c { f(x) } else { 0.0 }).collect::<Vec<_>>();
            mesh.nodes.iter().flat_map(of).collect()
        };
        let (one, slope) = (|_: &[f64; D]| 1.0, |x: &[f64; D]| x[0] - 0.5 * x[1]);
        for c in 0..components {
            let (v, w) = (field(&one, c), field(&slope, c));
            let exact = [integral(&one), integral(&slope), integral(&|x| slope(x).powi(2))];
            let found = [mass.product(&v, &v), mass.product(&v, &w), mass.product(&w, &w)];
            // See the module: the last product is of third degree about an axis.
            let last =
                if idealisation == Idealisation::Axisymmetric && kind == ElementKind::Tri3 { 2 } else { 3 };
            for (f, e) in found.iter().zip(exact).take(last) {
                assert!((f - e).abs() < 1e-12 * exact[0].max(exact[2]), "{kind:?} {idealisation:?}: {f} {e}");
            }
        }
    }

    #[test]
    fn the_mass_of_linear_velocities_is_their_integral_on_every_element() {
        for kind in ElementKind::ALL {
            if kind.dimension() == 2 {
                check::<2>(kind, Idealisation::PlaneStrain);
                check::<2>(kind, Idealisation::Antiplane);
                check::<2>(kind, Idealisation::Axisymmetric);
            } else {
                check::<3>(kind, Idealisation::ThreeD);
            }
        }
    }
}
