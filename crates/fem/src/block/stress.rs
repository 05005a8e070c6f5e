//! Strain and stress of a block.

use super::LinearBlock;
use crate::kinematics::{Dilatation, Idealisation};
use crate::mesh::Mesh;
use std::collections::BTreeMap;

/// Mises equivalent stress of xx, yy, zz, xy, yz, zx \[Pa\].
#[must_use]
pub fn von_mises(s: &[f64; 6]) -> f64 {
    let normal = (s[0] - s[1]).powi(2) + (s[1] - s[2]).powi(2) + (s[2] - s[0]).powi(2);
    let shear = s[3] * s[3] + s[4] * s[4] + s[5] * s[5];
    (0.5 * normal + 3.0 * shear).sqrt()
}

/// Strain and stress at a quadrature point, xx, yy, zz, xy, yz, zx (about an axis: rr, axial, hoop, and rz at xy).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointState {
    /// Components of the strain tensor (shear not doubled) \[-\]; with [`Dilatation::Constant`] and [`Dilatation::Linear`], the
    /// assumed strain.
    pub strain: [f64; 6],
    /// Cauchy stress \[Pa\].
    pub stress: [f64; 6],
    /// Volume of the point \[m^D, m³ about an axis\].
    pub volume: f64,
}

impl<const D: usize> LinearBlock<D> {
    /// Strain and stress at the quadrature points of a cell.
    pub fn cell_state(&self, cell: usize, u: &[f64]) -> impl Iterator<Item = PointState> {
        let components = self.idealisation.components();
        let pattern = self.cell_dofs();
        let dofs = pattern.block(cell);
        let mut local = [0.0; super::MOST_DOFS];
        local.iter_mut().zip(dofs).for_each(|(value, &dof)| *value = u[dof]);
        let geometry = self.geometry().cell(cell);
        let mut projected = self.projection().map(|p| p.dilatation(cell, &local));
        (0..geometry.volumes.len()).map(move |q| {
            let mut h = [[0.0; 3]; 3];
            let nodes = local.chunks_exact(components).zip(geometry.gradients(q));
            for (u, gradient) in nodes {
                for (c, u) in u.iter().enumerate() {
                    for (entry, g) in h[self.idealisation.axis(c)].iter_mut().zip(gradient) {
                        *entry += u * g;
                    }
                }
            }
            if self.idealisation == Idealisation::Axisymmetric {
                let radial: f64 =
                    local.chunks_exact(components).zip(geometry.shapes(q)).map(|(u, n)| u[0] * n).sum();
                h[2][2] = radial * geometry.hoop(q);
            }
            let shift = projected
                .as_mut()
                .and_then(Iterator::next)
                .map_or(0.0, |theta| theta - h[0][0] - h[1][1] - h[2][2]);
            self.state(h, shift, geometry.volumes[q])
        })
    }

    /// State of a displacement gradient whose dilatation is shifted by `shift` with B-bar; in plane stress, the strain along z
    /// is found here.
    fn state(&self, mut h: [[f64; 3]; 3], shift: f64, volume: f64) -> PointState {
        let material = &self.material;
        let mean_pressure = self.space == Some(Dilatation::ConstantPressure);
        if !mean_pressure {
            (0..3).for_each(|i| h[i][i] += shift / 3.0);
        }
        let sheet = self.idealisation == Idealisation::PlaneStress;
        if sheet {
            h[2][2] = -material.poisson() / (1.0 - material.poisson()) * (h[0][0] + h[1][1]);
        }
        let mut stress = material.stress(&h);
        if sheet {
            // Zero except for rounding.
            stress[2] = 0.0;
        }
        if mean_pressure {
            stress[..3].iter_mut().for_each(|s| *s += material.lame() * shift);
        }
        let shear = |i: usize, j: usize| 0.5 * (h[i][j] + h[j][i]);
        let strain = [h[0][0], h[1][1], h[2][2], shear(0, 1), shear(1, 2), shear(2, 0)];
        PointState { strain, stress, volume }
    }

    /// Stress at every quadrature point, cell by cell \[Pa\].
    #[must_use]
    pub fn stress_at_points(&self, u: &[f64]) -> Vec<[f64; 6]> {
        (0..self.cells.len()).flat_map(|c| self.cell_state(c, u).map(|s| s.stress)).collect()
    }

    /// Strain at every quadrature point, cell by cell \[-\]; see [`PointState`].
    #[must_use]
    pub fn strain_at_points(&self, u: &[f64]) -> Vec<[f64; 6]> {
        (0..self.cells.len()).flat_map(|c| self.cell_state(c, u).map(|s| s.strain)).collect()
    }

    /// Stress of each cell, averaged over its volume \[Pa\].
    #[must_use]
    pub fn cell_stress(&self, u: &[f64]) -> Vec<[f64; 6]> {
        self.cell_means(u, |s| s.stress)
    }

    /// Strain of each cell, averaged over its volume \[-\]; see [`PointState`].
    #[must_use]
    pub fn cell_strain(&self, u: &[f64]) -> Vec<[f64; 6]> {
        self.cell_means(u, |s| s.strain)
    }

    /// Centre of volume of each cell \[m\].
    #[must_use]
    pub fn cell_middles(&self) -> Vec<[f64; D]> {
        let middle = |cell: usize| {
            let geometry = self.geometry().cell(cell);
            let volume: f64 = geometry.volumes.iter().sum();
            let mut sum = [0.0; D];
            for (x, v) in geometry.positions.iter().zip(geometry.volumes) {
                sum.iter_mut().zip(x).for_each(|(s, x)| *s += v * x);
            }
            sum.map(|s| s / volume)
        };
        (0..self.cells.len()).map(middle).collect()
    }

    fn cell_means(&self, u: &[f64], part: impl Fn(&PointState) -> [f64; 6]) -> Vec<[f64; 6]> {
        (0..self.cells.len())
            .map(|cell| {
                let mut sum = [0.0; 6];
                let mut volume = 0.0;
                for state in self.cell_state(cell, u) {
                    volume += state.volume;
                    for (s, t) in sum.iter_mut().zip(part(&state)) {
                        *s += state.volume * t;
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
            let volume: f64 = self.geometry().cell(cell).volumes.iter().sum();
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
}
