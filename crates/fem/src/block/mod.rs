//! A block of linear elastic cells of one kind: stiffness, internal force, stress, loads.

mod geometry;
mod loads;
mod norm;
mod projection;
mod stiffness;
mod stress;

use crate::element::{ElementKind, MOST_NODES};
use crate::error::FemError;
use crate::kinematics::{Dilatation, Formulation, Idealisation};
use crate::material::elastic::Elastic;
use crate::mesh::{Cells, Mesh};
use crate::term::{Fraction, Instant, Limited, Linearized, Pattern, Refusal, Term};
use geometry::Geometry;
pub use norm::FieldValue;
use projection::Projection;
use rayon::prelude::*;
use stiffness::Moduli;
pub use stress::{PointState, von_mises};

/// Cells treated by one task: fixed, so that results do not depend on the number of threads.
const CHUNK: usize = 256;

/// Most degrees of freedom of a cell.
const MOST_DOFS: usize = 3 * MOST_NODES;

/// See the module.
#[derive(Clone, Debug)]
pub struct LinearBlock<const D: usize> {
    name: String,
    cells: Cells,
    material: Elastic,
    idealisation: Idealisation,
    formulation: Formulation,
    pattern: Pattern,
    stiffness: Vec<f64>,
    geometry: Geometry<D>,
    projection: Option<Projection>,
}

impl<const D: usize> LinearBlock<D> {
    /// The stiffness of one block of cells of `mesh`; degree of freedom = node * components + component.
    ///
    /// # Errors
    /// [`FemError::Jacobian`] naming the first cell that is inside out, [`FemError::Radius`] naming a node left of the axis of
    /// revolution, [`FemError::Formulation`] where B-bar does not serve, [`FemError::Dimension`] and
    /// [`FemError::Idealisation`] when element, idealisation and mesh differ in dimension.
    pub fn new(
        mesh: &Mesh<D>,
        block: usize,
        material: &Elastic,
        idealisation: Idealisation,
        formulation: Formulation,
    ) -> Result<Self, FemError> {
        let cells = mesh.blocks[block].clone();
        if cells.kind.dimension() != D {
            return Err(FemError::Dimension { element: cells.kind.name(), dimension: D });
        }
        idealisation.check_dimension(D)?;
        let space = formulation.dilatation(cells.kind, idealisation)?;
        let geometry = Geometry::new(mesh, &cells, block, idealisation)?;
        let components = idealisation.components();
        let width = cells.kind.nodes() * components;
        let projection = space.map(|space| Projection::new(space, &geometry, cells.len(), width));
        let mut result = Self {
            name: format!("cells {block}"),
            material: *material,
            idealisation,
            formulation,
            pattern: pattern(&cells, components),
            stiffness: Vec::new(),
            geometry,
            projection,
            cells,
        };
        result.stiffness = result.assemble();
        Ok(result)
    }

    fn assemble(&self) -> Vec<f64> {
        let size = (self.cells.kind.nodes() * self.idealisation.components()).pow(2);
        let moduli = self.moduli();
        let mut values = vec![0.0; self.cells.len() * size];
        values.par_chunks_mut(size * CHUNK).enumerate().for_each(|(chunk, part)| {
            for (k, k_e) in part.chunks_exact_mut(size).enumerate() {
                self.cell_stiffness(chunk * CHUNK + k, &moduli, k_e);
            }
        });
        values
    }

    fn moduli(&self) -> Moduli {
        let shear = self.material.shear();
        let dilatation = match self.idealisation {
            Idealisation::PlaneStress => self.material.plane_stress_lame(),
            _ => self.material.lame(),
        };
        match self.projection.as_ref().map(Projection::space) {
            None => Moduli { shear, dilatation, projected: 0.0 },
            Some(Dilatation::ConstantPressure) => Moduli { shear, dilatation: 0.0, projected: dilatation },
            Some(_) => Moduli { shear, dilatation: -2.0 / 3.0 * shear, projected: self.material.bulk() },
        }
    }

    fn cell_stiffness(&self, cell: usize, moduli: &Moduli, k_e: &mut [f64]) {
        let geometry = self.geometry.cell(cell);
        match self.idealisation {
            Idealisation::Antiplane => stiffness::antiplane(&geometry, moduli.shear, k_e),
            _ => stiffness::solid(&geometry, moduli, k_e),
        }
        if self.idealisation == Idealisation::Axisymmetric {
            stiffness::hoop(&geometry, moduli, k_e);
        }
        for c in self.projection.iter().flat_map(|p| p.moments(cell)) {
            stiffness::projected(moduli.projected, c, k_e);
        }
        stiffness::mirror(self.cells.kind.nodes() * self.idealisation.components(), k_e);
    }

    /// Kind of the cells.
    #[must_use]
    pub fn kind(&self) -> ElementKind {
        self.cells.kind
    }

    /// Idealisation of space.
    #[must_use]
    pub fn idealisation(&self) -> Idealisation {
        self.idealisation
    }

    /// Treatment of the dilatation.
    #[must_use]
    pub fn formulation(&self) -> Formulation {
        self.formulation
    }

    /// Degrees of freedom and stiffness of its cells; all else is given back.
    #[must_use]
    pub fn into_stiffness(self) -> (Pattern, Vec<f64>) {
        (self.pattern, self.stiffness)
    }

    /// Cell stiffness matrices one after another, each row by row \[N/m, or N/m² in the plane\]; symmetric to the last bit.
    #[must_use]
    pub fn stiffness(&self) -> &[f64] {
        &self.stiffness
    }
}

fn pattern(cells: &Cells, components: usize) -> Pattern {
    let width = cells.kind.nodes() * components;
    let dofs =
        cells.connectivity.iter().flat_map(|&n| (0..components).map(move |c| n * components + c)).collect();
    Pattern { dofs, starts: (0..=cells.len()).map(|c| c * width).collect(), version: 0 }
}

impl<const D: usize> Term for LinearBlock<D> {
    fn name(&self) -> &str {
        &self.name
    }

    fn residual(&mut self, u: &[f64], _at: Instant, r: &mut [f64]) -> Result<(), Refusal> {
        let mut offset = 0;
        let mut local = [0.0; MOST_DOFS];
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

    fn constant_tangent(&self) -> Option<&[f64]> {
        Some(&self.stiffness)
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
