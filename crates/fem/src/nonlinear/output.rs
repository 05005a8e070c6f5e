//! Fields of the committed state.

use super::block::Block;
use super::cell::{InvertedPoint, Scratch};
use super::model::{Material, with_material};
use crate::material::constitutive::{ConstitutiveLaw, Voigt};

impl<const D: usize> Block<D> {
    /// Cauchy stress xx, yy, zz, xy, yz, zx at every quadrature point, cell by cell \[Pa\].
    #[must_use]
    pub fn stress_at_points(&self) -> Vec<Voigt> {
        with_material!(&self.body.model.material, m => self.stresses(m)).into_iter().map(|(s, _)| s).collect()
    }

    /// Cauchy stress of each cell, averaged over its current volume \[Pa\].
    #[must_use]
    pub fn cell_stress(&self) -> Vec<Voigt> {
        with_material!(&self.body.model.material, m => self.stresses(m))
            .chunks_exact(self.body.frame.points())
            .map(|points| {
                let volume: f64 = points.iter().map(|(_, v)| v).sum();
                std::array::from_fn(|i| points.iter().map(|(s, v)| v * s[i]).sum::<f64>() / volume)
            })
            .collect()
    }

    /// Equivalent plastic strain of every quadrature point, cell by cell, of a plastic material.
    #[must_use]
    pub fn plastic_strain_at_points(&self) -> Option<Vec<f64>> {
        let layout = self.body.frame.layout;
        matches!(self.body.model.material, Material::J2(_)).then(|| {
            self.state.committed.chunks_exact(layout.stride).map(|s| s[6 + 6 * layout.tensors]).collect()
        })
    }

    /// Equivalent plastic strain of each cell, averaged over its reference volume, of a plastic material.
    #[must_use]
    pub fn cell_plastic_strain(&self) -> Option<Vec<f64>> {
        let points = self.body.frame.points();
        let strains = self.plastic_strain_at_points()?;
        let cells = strains.chunks_exact(points).zip(self.body.volumes.chunks_exact(points));
        Some(
            cells
                .map(|(e, v)| e.iter().zip(v).map(|(e, v)| e * v).sum::<f64>() / v.iter().sum::<f64>())
                .collect(),
        )
    }

    /// Logarithmic strain through the thickness at every quadrature point, in plane stress if it is kept.
    #[must_use]
    pub fn thickness_strain_at_points(&self) -> Option<Vec<f64>> {
        let layout = self.body.frame.layout;
        let kept = layout.thickness && layout.stride > 0;
        kept.then(|| self.state.committed.chunks_exact(layout.stride).map(|s| s[layout.stride - 1]).collect())
    }

    /// Cauchy stress at the quadrature points of a cell \[Pa\].
    #[must_use]
    pub fn stress_of_cell(&self, cell: usize) -> Vec<Voigt> {
        let mut scratch = Scratch::new(&self.body.frame);
        with_material!(&self.body.model.material, m => self.cell_points(m, cell, &mut scratch))
            .into_iter()
            .map(|(s, _)| s)
            .collect()
    }

    /// Nodal forces of the stresses of a cell, in the order of its degrees of freedom \[N, or N/m of thickness\].
    // Never inlined where blocks with and without a history are distinguished: both would share the instructions at their ends, which
    // count for this file.
    #[inline(never)]
    #[must_use]
    pub fn forces_of_cell(&self, cell: usize) -> Vec<f64> {
        let (body, frame) = (&self.body, &self.body.frame);
        let mut scratch = Scratch::new(frame);
        let mut forces = vec![f64::NAN; frame.width()];
        with_material!(&body.model.material, m => {
            if self.cell_stresses(m, cell, &mut scratch).is_ok() {
                scratch.forces(frame, body.cell_volumes(cell), &mut forces);
            }
        });
        forces
    }

    /// Stress and current volume of every point. Under finite deformation σ = τ/J; with averaged dilatation J is that of the
    /// cell, as is the dilatation used for the stress.
    fn stresses<M: ConstitutiveLaw>(&self, material: &M) -> Vec<(Voigt, f64)> {
        let mut scratch = Scratch::new(&self.body.frame);
        (0..self.body.cells.len()).flat_map(|cell| self.cell_points(material, cell, &mut scratch)).collect()
    }

    /// The same for one cell.
    fn cell_points<M: ConstitutiveLaw>(
        &self,
        material: &M,
        cell: usize,
        scratch: &mut Scratch<D>,
    ) -> Vec<(Voigt, f64)> {
        let (body, frame) = (&self.body, &self.body.frame);
        let volumes = body.cell_volumes(cell);
        if self.cell_stresses(material, cell, scratch).is_err() {
            return volumes.iter().map(|_| ([f64::NAN; 6], f64::NAN)).collect();
        }
        let old = body.cell_state(cell, &self.state.committed);
        let mean = scratch.volume.iter().sum::<f64>() / volumes.iter().sum::<f64>();
        let point = |(point, (stress, v)): (usize, (&Voigt, &f64))| {
            let thickness = match (frame.thickness_of(old, point), frame.finite) {
                (Some(strain), true) => strain.exp(),
                _ => 1.0,
            };
            let j = if frame.modes > 0 { mean } else { v / volumes[point] * thickness };
            let stress = if frame.finite { stress.map(|s| s / j) } else { *stress };
            (stress, v * thickness)
        };
        scratch.stress.iter().zip(&scratch.volume).enumerate().map(point).collect()
    }

    /// Computes the stresses of a cell in the committed state by the cell's kernels. A committed state was evaluated and
    /// therefore has a volume; a restored one may be arbitrary.
    fn cell_stresses<M: ConstitutiveLaw>(
        &self,
        material: &M,
        cell: usize,
        scratch: &mut Scratch<D>,
    ) -> Result<(), InvertedPoint> {
        let (body, frame) = (&self.body, &self.body.frame);
        let start = if self.none.is_empty() { &self.u.committed } else { &self.none };
        body.gather(cell, start, &self.u.committed, scratch);
        scratch.motion(frame, body.cell_volumes(cell))?;
        let old = body.cell_state(cell, &self.state.committed);
        if self.none.is_empty() {
            scratch.forward(frame, material, 0.0, old);
        } else {
            let mut kept = vec![0.0; body.state_size()];
            scratch.stresses(frame, material, 0.0, old, &mut kept, false);
        }
        Ok(())
    }
}
