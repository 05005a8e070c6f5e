//! A block of linear elastic cells of one kind: stiffness, internal force, stress.
//!
//! `K_ab = ∫ λ ∇N_a ⊗ ∇N_b + G (∇N_b ⊗ ∇N_a + ∇N_a·∇N_b I) dV`, the displacement form of isotropic elasticity, which
//! serves plane strain and three dimensions alike.

use crate::element::{ElementKind, MOST_NODES, Shape};
use crate::error::FemError;
use crate::material::elastic::Elastic;
use crate::mesh::{Cells, Mesh, Side};
use crate::surface;
use crate::term::{Fraction, Instant, Limited, Linearized, Pattern, Refusal, Term};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Cells treated by one task: fixed, so that results do not depend on the number of threads.
const CHUNK: usize = 256;

/// See the module.
#[derive(Clone, Debug)]
pub struct LinearBlock<const D: usize> {
    name: String,
    cells: Cells,
    material: Elastic,
    pattern: Pattern,
    stiffness: Vec<f64>,
    /// ∇N of every node at every quadrature point of every cell, and weight times Jacobian.
    points: Vec<PointData<D>>,
    per_cell: usize,
}

/// Gradients at one quadrature point.
#[derive(Clone, Copy, Debug)]
struct PointData<const D: usize> {
    gradients: [[f64; D]; MOST_NODES],
    n: [f64; MOST_NODES],
    volume: f64,
}

impl<const D: usize> LinearBlock<D> {
    /// The stiffness of one block of cells of `mesh`; degree of freedom = node * D + component.
    ///
    /// # Errors
    /// [`FemError::Jacobian`] naming the first cell that is inside out.
    pub fn new(mesh: &Mesh<D>, block: usize, material: &Elastic) -> Result<Self, FemError> {
        let cells = mesh.blocks[block].clone();
        if cells.kind.dimension() != D {
            return Err(FemError::Dimension { element: cells.kind.name(), dimension: D });
        }
        let rule: Vec<(Shape, f64)> =
            cells.kind.quadrature().into_iter().map(|(xi, w)| (cells.kind.shape(xi), w)).collect();
        let points = (0..cells.len())
            .into_par_iter()
            .with_min_len(CHUNK)
            .map(|cell| cell_points(mesh, &cells, block, cell, &rule))
            .collect::<Result<Vec<_>, _>>()?
            .concat();
        let dofs: Vec<Vec<usize>> = (0..cells.len())
            .map(|c| cells.cell(c).iter().flat_map(|&n| (0..D).map(move |i| n * D + i)).collect())
            .collect();
        let pattern = Pattern::of_blocks(0, dofs.iter().map(Vec::as_slice));
        let mut result = Self {
            name: format!("cells {block}"),
            material: *material,
            pattern,
            stiffness: Vec::new(),
            per_cell: rule.len(),
            points,
            cells,
        };
        result.stiffness = result.assemble();
        Ok(result)
    }

    fn assemble(&self) -> Vec<f64> {
        let size = (self.cells.kind.nodes() * D).pow(2);
        let mut values = vec![0.0; self.cells.len() * size];
        values.par_chunks_mut(size * CHUNK).enumerate().for_each(|(chunk, part)| {
            for (k, k_e) in part.chunks_exact_mut(size).enumerate() {
                self.cell_stiffness(chunk * CHUNK + k, k_e);
            }
        });
        values
    }

    fn cell_stiffness(&self, cell: usize, k_e: &mut [f64]) {
        let (g, lambda) = (self.material.shear(), self.material.lame());
        let nodes = self.cells.kind.nodes();
        let width = nodes * D;
        for point in self.cell_data(cell) {
            for a in 0..nodes {
                let ga = point.gradients[a];
                for b in 0..nodes {
                    let gb = point.gradients[b];
                    let dot: f64 = (0..D).map(|i| ga[i] * gb[i]).sum();
                    for i in 0..D {
                        for j in 0..D {
                            let shear = g * ga[j] * gb[i] + if i == j { g * dot } else { 0.0 };
                            k_e[(a * D + i) * width + b * D + j] +=
                                point.volume * (lambda * ga[i] * gb[j] + shear);
                        }
                    }
                }
            }
        }
    }

    fn cell_data(&self, cell: usize) -> &[PointData<D>] {
        &self.points[cell * self.per_cell..(cell + 1) * self.per_cell]
    }

    /// Kind of the cells.
    #[must_use]
    pub fn kind(&self) -> ElementKind {
        self.cells.kind
    }

    /// Cell stiffness matrices one after another, each row by row \[Pa m^(D-2)\].
    #[must_use]
    pub fn stiffness(&self) -> &[f64] {
        &self.stiffness
    }

    /// Cauchy stress at the quadrature points of a cell: xx, yy, zz, xy, yz, zx \[Pa\], with the volume of each point.
    fn point_stress<'a>(&'a self, cell: usize, u: &'a [f64]) -> impl Iterator<Item = ([f64; 6], f64)> + 'a {
        let nodes = self.cells.cell(cell);
        self.cell_data(cell).iter().map(move |point| {
            let mut h = [[0.0; 3]; 3];
            for (&node, gradient) in nodes.iter().zip(&point.gradients) {
                for (row, &u) in h.iter_mut().zip(&u[node * D..(node + 1) * D]) {
                    for (entry, g) in row.iter_mut().zip(gradient) {
                        *entry += u * g;
                    }
                }
            }
            (self.material.stress(&h), point.volume)
        })
    }

    /// Stress at every quadrature point, cell by cell \[Pa\].
    #[must_use]
    pub fn stress_at_points(&self, u: &[f64]) -> Vec<[f64; 6]> {
        (0..self.cells.len()).flat_map(|c| self.point_stress(c, u).map(|(s, _)| s)).collect()
    }

    /// Stress of each cell, averaged over its volume \[Pa\].
    #[must_use]
    pub fn cell_stress(&self, u: &[f64]) -> Vec<[f64; 6]> {
        (0..self.cells.len())
            .map(|cell| {
                let mut sum = [0.0; 6];
                let mut volume = 0.0;
                for (stress, v) in self.point_stress(cell, u) {
                    volume += v;
                    for (s, t) in sum.iter_mut().zip(stress) {
                        *s += v * t;
                    }
                }
                sum.map(|s| s / volume)
            })
            .collect()
    }

    /// Stress at the nodes of the block: volume-weighted mean of the adjoining cells, node and stress \[Pa\].
    #[must_use]
    pub fn nodal_stress(&self, _mesh: &Mesh<D>, u: &[f64]) -> Vec<(usize, [f64; 6])> {
        let mut sums: BTreeMap<usize, ([f64; 6], f64)> = BTreeMap::new();
        for (cell, stress) in self.cell_stress(u).into_iter().enumerate() {
            let volume: f64 = self.cell_data(cell).iter().map(|p| p.volume).sum();
            for &node in self.cells.cell(cell) {
                let entry = sums.entry(node).or_default();
                entry.1 += volume;
                for (s, t) in entry.0.iter_mut().zip(stress) {
                    *s += volume * t;
                }
            }
        }
        sums.into_iter().map(|(node, (sum, volume))| (node, sum.map(|s| s / volume))).collect()
    }

    /// Consistent nodal forces of a body force `f` \[N/m³\].
    #[must_use]
    pub fn body_force(&self, f: [f64; D]) -> Vec<(usize, f64)> {
        self.integrate(|point, a, i| point.n[a] * f[i])
    }

    /// Internal nodal forces ∫ Bᵀ σ of a uniform stress xx, yy, zz, xy, yz, zx \[Pa\].
    #[must_use]
    pub fn initial_stress(&self, stress: [f64; 6]) -> Vec<(usize, f64)> {
        const ROWS: [[usize; 3]; 3] = [[0, 3, 5], [3, 1, 4], [5, 4, 2]];
        self.integrate(|point, a, i| (0..D).map(|j| stress[ROWS[i][j]] * point.gradients[a][j]).sum())
    }

    fn integrate(&self, value: impl Fn(&PointData<D>, usize, usize) -> f64) -> Vec<(usize, f64)> {
        let mut forces: BTreeMap<usize, f64> = BTreeMap::new();
        for cell in 0..self.cells.len() {
            for point in self.cell_data(cell) {
                for (a, &node) in self.cells.cell(cell).iter().enumerate() {
                    for i in 0..D {
                        *forces.entry(node * D + i).or_default() += point.volume * value(point, a, i);
                    }
                }
            }
        }
        forces.into_iter().collect()
    }

    /// Nodal forces of a uniform traction \[Pa\] on faces.
    ///
    /// # Errors
    /// None today; faces without area are found when the cells are set up.
    pub fn traction(
        &self,
        mesh: &Mesh<D>,
        sides: &[Side],
        t: [f64; D],
    ) -> Result<Vec<(usize, f64)>, FemError> {
        Ok(surface::integrate(mesh, sides, |n| std::array::from_fn(|c| t[c] * surface::length(&n))))
    }

    /// Nodal forces of a uniform pressure \[Pa\], positive into the body.
    ///
    /// # Errors
    /// As [`LinearBlock::traction`].
    pub fn pressure(&self, mesh: &Mesh<D>, sides: &[Side], p: f64) -> Result<Vec<(usize, f64)>, FemError> {
        Ok(surface::integrate(mesh, sides, |n| std::array::from_fn(|c| -p * n[c])))
    }

    /// Integral of each face shape function: tributary area of each node \[m^(D-1)\].
    ///
    /// # Errors
    /// None for the faces that exist: their weights are positive.
    pub fn tributary_areas(&self, mesh: &Mesh<D>, sides: &[Side]) -> Result<BTreeMap<usize, f64>, FemError> {
        Ok(surface::areas(mesh, sides))
    }
}

/// Gradients at the quadrature points of one cell.
fn cell_points<const D: usize>(
    mesh: &Mesh<D>,
    cells: &Cells,
    block: usize,
    cell: usize,
    rule: &[(Shape, f64)],
) -> Result<Vec<PointData<D>>, FemError> {
    let nodes = cells.cell(cell);
    rule.iter()
        .map(|(shape, weight)| {
            let mut j = nalgebra::SMatrix::<f64, D, D>::zeros();
            for (a, &node) in nodes.iter().enumerate() {
                for i in 0..D {
                    for m in 0..D {
                        j[(i, m)] += mesh.nodes[node][i] * shape.dn[a][m];
                    }
                }
            }
            let determinant = determinant(&j);
            let bad = || FemError::Jacobian { block, cell, determinant };
            let inverse = if determinant > 0.0 { j.try_inverse() } else { None }.ok_or_else(bad)?;
            let mut gradients = [[0.0; D]; MOST_NODES];
            for (a, g) in gradients.iter_mut().enumerate().take(nodes.len()) {
                for (i, value) in g.iter_mut().enumerate() {
                    *value = (0..D).map(|m| shape.dn[a][m] * inverse[(m, i)]).sum();
                }
            }
            Ok(PointData { gradients, n: shape.n, volume: weight * determinant })
        })
        .collect()
}

fn determinant<const D: usize>(j: &nalgebra::SMatrix<f64, D, D>) -> f64 {
    if D == 2 {
        return j[(0, 0)] * j[(1, 1)] - j[(0, 1)] * j[(1, 0)];
    }
    let minor = |a: usize, b: usize| j[(1, a)] * j[(2, b)] - j[(1, b)] * j[(2, a)];
    j[(0, 0)] * minor(1, 2) - j[(0, 1)] * minor(0, 2) + j[(0, 2)] * minor(0, 1)
}

/// Mises equivalent stress of xx, yy, zz, xy, yz, zx \[Pa\].
#[must_use]
pub fn von_mises(s: &[f64; 6]) -> f64 {
    let normal = (s[0] - s[1]).powi(2) + (s[1] - s[2]).powi(2) + (s[2] - s[0]).powi(2);
    let shear = s[3] * s[3] + s[4] * s[4] + s[5] * s[5];
    (0.5 * normal + 3.0 * shear).sqrt()
}

impl<const D: usize> Term for LinearBlock<D> {
    fn name(&self) -> &str {
        &self.name
    }

    fn residual(&mut self, u: &[f64], _at: Instant, r: &mut [f64]) -> Result<(), Refusal> {
        let mut offset = 0;
        let mut local = [0.0; 3 * MOST_NODES];
        for block in self.pattern.blocks() {
            let n = block.len();
            for (value, &dof) in local.iter_mut().zip(block) {
                *value = u[dof];
            }
            for (row, &dof) in self.stiffness[offset..offset + n * n].chunks_exact(n).zip(block) {
                r[dof] += row.iter().zip(&local).map(|(k, u)| k * u).sum::<f64>();
            }
            offset += n * n;
        }
        Ok(())
    }

    fn accept(&mut self) {}

    fn reject(&mut self) {}
}

impl<const D: usize> Linearized for LinearBlock<D> {
    fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    fn tangent(&mut self, values: &mut [f64]) {
        values.copy_from_slice(&self.stiffness);
    }
}

impl<const D: usize> Limited for LinearBlock<D> {
    fn rate(&mut self, _at: Instant, values: &mut [f64], _constant: &mut [f64]) -> Result<(), Refusal> {
        values.copy_from_slice(&self.stiffness);
        Ok(())
    }

    fn limit(&mut self, _du: &[f64], _at: Instant) -> Option<Fraction> {
        None
    }

    fn advance(&mut self, _du: &[f64], _at: Instant) -> Result<(), Refusal> {
        Ok(())
    }
}
