//! Consistent nodal forces of a block: body forces, initial stress, tractions on its faces.

use super::LinearBlock;
use super::geometry::{determinant, place};
use crate::error::FemError;
use crate::kinematics::Idealisation;
use crate::mesh::{Mesh, Side};
use crate::surface;
use std::collections::BTreeMap;

impl<const D: usize> LinearBlock<D> {
    /// Consistent nodal forces of a uniform body force `f`, one entry per component \[N/m³\]: degree of freedom and force
    /// \[N, or N/m of thickness\], ascending.
    ///
    /// # Errors
    /// [`FemError::Components`] if `f` has a different length.
    pub fn body_force(&self, mesh: &Mesh<D>, f: &[f64]) -> Result<Vec<(usize, f64)>, FemError> {
        self.idealisation.check_components(f.len())?;
        Ok(self.body_force_field(mesh, |_, value| value.copy_from_slice(f)))
    }

    /// As [`LinearBlock::body_force`], for a body force that `f` writes for each position.
    pub fn body_force_field(&self, mesh: &Mesh<D>, f: impl Fn(&[f64; D], &mut [f64])) -> Vec<(usize, f64)> {
        let components = self.idealisation.components();
        let kind = self.cells.kind;
        let rule: Vec<_> = kind.mass_quadrature().into_iter().map(|(xi, w)| (kind.shape(xi), w)).collect();
        let mut forces: BTreeMap<usize, f64> = BTreeMap::new();
        for cell in 0..self.cells.len() {
            let nodes = self.cells.cell(cell);
            for (shape, weight) in &rule {
                let (x, j) = place(&mesh.nodes, nodes, shape);
                let volume = weight * determinant(&j) * self.idealisation.weight(&x);
                let mut value = [0.0; 3];
                f(&x, &mut value[..components]);
                for (&node, n) in nodes.iter().zip(&shape.n) {
                    for (c, v) in value[..components].iter().enumerate() {
                        *forces.entry(node * components + c).or_default() += volume * n * v;
                    }
                }
            }
        }
        forces.into_iter().collect()
    }

    /// Internal nodal forces ∫ Bᵀ σ of a uniform stress xx, yy, zz, xy, yz, zx \[Pa\]. About an axis, zz is the hoop stress.
    /// B-bar gives the same forces, as its projection keeps the integral of the dilatation.
    #[must_use]
    pub fn initial_stress(&self, stress: [f64; 6]) -> Vec<(usize, f64)> {
        self.initial_stress_field(|_| stress)
    }

    /// As [`LinearBlock::initial_stress`], for the stress at each position. B-bar would give other forces where the mean stress varies;
    /// these are in balance with the tractions on the faces and the body forces of the field.
    pub fn initial_stress_field(&self, stress: impl Fn(&[f64; D]) -> [f64; 6]) -> Vec<(usize, f64)> {
        const ROWS: [[usize; 3]; 3] = [[0, 3, 5], [3, 1, 4], [5, 4, 2]];
        let components = self.idealisation.components();
        let mut forces: BTreeMap<usize, f64> = BTreeMap::new();
        for cell in 0..self.cells.len() {
            let geometry = self.geometry().cell(cell);
            for (q, volume) in geometry.volumes.iter().enumerate() {
                let stress = stress(&geometry.positions[q]);
                let nodes = self.cells.cell(cell).iter().zip(geometry.gradients(q)).zip(geometry.shapes(q));
                for ((&node, gradient), n) in nodes {
                    for c in 0..components {
                        let row = ROWS[self.idealisation.axis(c)];
                        let mut value: f64 = row.iter().zip(gradient).map(|(&s, g)| stress[s] * g).sum();
                        if c == 0 {
                            value += stress[2] * n * geometry.hoop(q);
                        }
                        *forces.entry(node * components + c).or_default() += volume * value;
                    }
                }
            }
        }
        forces.into_iter().collect()
    }

    /// Nodal forces of a uniform traction, one entry per component \[Pa\], on faces.
    ///
    /// # Errors
    /// [`FemError::Components`] if `t` has a different length.
    pub fn traction(&self, mesh: &Mesh<D>, sides: &[Side], t: &[f64]) -> Result<Vec<(usize, f64)>, FemError> {
        self.idealisation.check_components(t.len())?;
        Ok(surface::integrate(mesh, sides, self.idealisation, |point, value| {
            let area = surface::length(&point.normal);
            value.iter_mut().zip(t).for_each(|(v, t)| *v = t * area);
        }))
    }

    /// Nodal forces of a uniform pressure \[Pa\], positive into the body.
    ///
    /// # Errors
    /// [`FemError::Idealisation`] in antiplane motion, where a pressure has no effect.
    pub fn pressure(&self, mesh: &Mesh<D>, sides: &[Side], p: f64) -> Result<Vec<(usize, f64)>, FemError> {
        if self.idealisation == Idealisation::Antiplane {
            return Err(FemError::Idealisation {
                idealisation: self.idealisation.name(),
                reason: "a pressure has no component along z",
            });
        }
        Ok(surface::integrate(mesh, sides, self.idealisation, |point, value| {
            value.iter_mut().zip(&point.normal).for_each(|(v, n)| *v = -p * n);
        }))
    }

    /// Integral of each face shape function: tributary area of each node \[m^(D-1); m² about an axis\].
    ///
    /// # Errors
    /// [`FemError::NodalAreas`] for faces of six or eight nodes: a flat tri6 has zero at its corners, a quad8 -1/12 of its area.
    pub fn tributary_areas(&self, mesh: &Mesh<D>, sides: &[Side]) -> Result<BTreeMap<usize, f64>, FemError> {
        for side in sides {
            let kind = mesh.blocks[side.block].kind;
            if !kind.faces()[side.face].kind.shares_area() {
                return Err(FemError::NodalAreas { element: kind.name() });
            }
        }
        Ok(surface::areas(mesh, sides, self.idealisation))
    }
}
