//! Forces of Kelvin-Voigt viscosity, `σ = C : ε(w)` with the elastic moduli C and the motion w of a relaxation time.
//!
//! They act beside the forces of the material and leave its history alone. Gradients are those of the trial state: a rigid
//! motion costs nothing, and the forces exert no torque.

use super::block::Block;
use super::cell::CellError;
use super::model::{Material, with_material};
use crate::material::constitutive::{ConstitutiveLaw, Moduli, Voigt};
use crate::material::plane_stress;
use crate::term::Refusal;

impl<const D: usize> Block<D> {
    /// Adds the forces of viscosity at the displacements of the last residual; `w` is the velocity times the relaxation time,
    /// in the numbering of the system \[m\].
    ///
    /// # Errors
    /// [`Refusal`] if a cell turns inside out.
    pub fn viscous(&mut self, w: &[f64], r: &mut [f64]) -> Result<(), Refusal> {
        let components = self.body.frame.components;
        let moved = self.body.nodes.iter().flat_map(|&n| &w[n * components..(n + 1) * components]);
        let before: Vec<f64> = self.u.trial.iter().zip(moved).map(|(u, w)| u - w).collect();
        let c = self.elastic_moduli();
        let mut forces = std::mem::take(&mut self.forces);
        let result = self.viscous_forces(&before, &c, &mut forces);
        self.forces = forces;
        result.map_err(|error| self.refusal(&error))?;
        self.scatter(&self.forces, r);
        Ok(())
    }

    fn viscous_forces(&self, before: &[f64], c: &Moduli, forces: &mut [f64]) -> Result<(), CellError> {
        let body = &self.body;
        body.chunks(forces, body.frame.width(), &mut [], 0, |scratch, mut task| {
            for (cell, f, _) in task.cells() {
                let volumes = body.cell_volumes(cell);
                body.gather(cell, before, &self.u.trial, scratch);
                scratch.motion(&body.frame, volumes).map_err(|_| CellError::InvertedByViscosity { cell })?;
                for (stress, increment) in scratch.stress.iter_mut().zip(&scratch.increments) {
                    *stress = product(c, &increment.strain);
                }
                scratch.forces(&body.frame, volumes, f);
            }
            Ok(())
        })
        .into_iter()
        .collect()
    }

    /// Moduli of the first strain of an unstressed point.
    fn elastic_moduli(&self) -> Moduli {
        let material: &Material = &self.body.model.material;
        let (tensors, scalars) = material.history();
        let history = vec![0.0; 6 * tensors + scalars];
        let c = with_material!(material, m => m.forward(0.0, &[0.0; 6], &history));
        if self.body.frame.plane_stress { plane_stress::condensed(&c) } else { c }
    }
}

fn product(c: &Moduli, strain: &Voigt) -> Voigt {
    std::array::from_fn(|i| c[i].iter().zip(strain).map(|(c, e)| c * e).sum())
}
