//! A block of linear elastic cells of one kind: stiffness, internal force, stress, loads.

mod geometry;
mod loads;
pub mod lumped;
mod norm;
mod projection;
mod stiffness;
mod stress;

use crate::element::{ElementKind, MOST_NODES};
use crate::error::FemError;
use crate::kinematics::{Dilatation, Formulation, Idealisation};
use crate::material::elastic::Elastic;
use crate::mesh::{Cells, Mesh};
use crate::term::{Blocks, ForwardTerm, Instant, Linearized, Pattern, Refusal, Term};
pub(crate) use geometry::determinant;
use geometry::{CHUNK, Geometry, Places};
pub use norm::FieldValue;
use projection::Projection;
use rayon::prelude::*;
use std::sync::{Arc, OnceLock};
use stiffness::Moduli;
pub use stress::{PointState, von_mises};

/// Largest number of degrees of freedom of a cell.
const MOST_DOFS: usize = 3 * MOST_NODES;

/// See the module.
///
/// Degrees of freedom, geometry and stiffness of the cells are computed when first needed: planning a scene without running it does not
/// need the memory. Clones share them.
#[derive(Clone, Debug)]
pub struct LinearBlock<const D: usize> {
    name: String,
    cells: Arc<Cells>,
    places: Arc<Places<D>>,
    material: Elastic,
    idealisation: Idealisation,
    formulation: Formulation,
    /// Dilatation projected by B-bar.
    space: Option<Dilatation>,
    pattern: Arc<OnceLock<Pattern>>,
    geometry: Arc<OnceLock<(Geometry<D>, Option<Projection>)>>,
    stiffness: Arc<OnceLock<Vec<f64>>>,
}

impl<const D: usize> LinearBlock<D> {
    /// Stiffness of one block of cells of `mesh`; degree of freedom = node * components + component.
    ///
    /// # Errors
    /// [`FemError::Jacobian`] naming the first inverted cell; [`FemError::Radius`] naming a node left of the axis of
    /// revolution; [`FemError::Formulation`] if B-bar is unsuitable; [`FemError::Dimension`] and [`FemError::Idealisation`] if
    /// element, idealisation and mesh differ in dimension.
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
        geometry::check(mesh, &cells, block, idealisation)?;
        Ok(Self {
            name: format!("cells {block}"),
            places: Arc::new(Places::new(mesh, &cells)),
            cells: Arc::new(cells),
            material: *material,
            idealisation,
            formulation,
            space,
            pattern: Arc::default(),
            geometry: Arc::default(),
            stiffness: Arc::default(),
        })
    }

    /// True if degrees of freedom, geometry or stiffness of the cells have been computed.
    #[must_use]
    pub fn is_made(&self) -> bool {
        self.pattern.get().is_some() || self.geometry.get().is_some() || self.stiffness.get().is_some()
    }

    fn cell_dofs(&self) -> &Pattern {
        self.pattern.get_or_init(|| pattern(&self.cells, self.idealisation.components()))
    }

    fn made(&self) -> &(Geometry<D>, Option<Projection>) {
        self.geometry.get_or_init(|| {
            let geometry = Geometry::new(&self.places, &self.cells, self.idealisation);
            let width = self.cells.kind.nodes() * self.idealisation.components();
            let project = |space| Projection::new(space, &geometry, self.cells.len(), width);
            let projection = self.space.map(project);
            (geometry, projection)
        })
    }

    fn geometry(&self) -> &Geometry<D> {
        &self.made().0
    }

    fn projection(&self) -> Option<&Projection> {
        self.made().1.as_ref()
    }

    fn assemble(&self) -> Vec<f64> {
        let size = (self.cells.kind.nodes() * self.idealisation.components()).pow(2);
        let moduli = self.moduli();
        // Computed here, not by a task that others would wait for.
        self.made();
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
        match self.space {
            None => Moduli { shear, dilatation, projected: 0.0 },
            Some(Dilatation::ConstantPressure) => Moduli { shear, dilatation: 0.0, projected: dilatation },
            Some(_) => Moduli { shear, dilatation: -2.0 / 3.0 * shear, projected: self.material.bulk() },
        }
    }

    fn cell_stiffness(&self, cell: usize, moduli: &Moduli, k_e: &mut [f64]) {
        let geometry = self.geometry().cell(cell);
        match self.idealisation {
            Idealisation::Antiplane => stiffness::antiplane(&geometry, moduli.shear, k_e),
            _ => stiffness::solid(&geometry, moduli, k_e),
        }
        if self.idealisation == Idealisation::Axisymmetric {
            stiffness::hoop(&geometry, moduli, k_e);
        }
        for c in self.projection().into_iter().flat_map(|p| p.moments(cell)) {
            stiffness::projected(moduli.projected, c, k_e);
        }
        stiffness::mirror(self.cells.kind.nodes() * self.idealisation.components(), k_e);
    }

    /// Stiffness of some of the cells, one after another, as in [`LinearBlock::stiffness`]; nothing is kept.
    #[must_use]
    pub fn stiffness_of(&self, cells: &[usize]) -> Vec<f64> {
        let connectivity = cells.iter().flat_map(|&cell| self.cells.cell(cell).iter().copied()).collect();
        let part = Self {
            cells: Arc::new(Cells { kind: self.cells.kind, connectivity }),
            pattern: Arc::default(),
            geometry: Arc::default(),
            stiffness: Arc::default(),
            ..self.clone()
        };
        part.assemble()
    }

    /// G and the modulus of the dilatation, λ or its form of plane stress \[Pa\], of the standard formulation.
    #[must_use]
    pub fn moduli_of_strain(&self) -> (f64, f64) {
        let moduli = self.moduli();
        (moduli.shear, moduli.dilatation)
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

    /// Degrees of freedom and stiffness of the cells; everything else is freed.
    #[must_use]
    pub fn into_stiffness(self) -> (Pattern, Vec<f64>) {
        let _ = (self.cell_dofs(), self.stiffness());
        let Self { pattern, stiffness, .. } = self;
        (taken(pattern), taken(stiffness))
    }

    /// Adds the internal forces of the displacements `u`, without initial stress \[N, or N/m of thickness\].
    pub fn add_forces(&self, u: &[f64], forces: &mut [f64]) {
        let mut offset = 0;
        for block in self.cell_dofs().blocks() {
            let n = block.len();
            for (row, &dof) in self.stiffness()[offset..offset + n * n].chunks_exact(n).zip(block) {
                forces[dof] += row.iter().zip(block).map(|(k, &other)| k * u[other]).sum::<f64>();
            }
            offset += n * n;
        }
    }

    /// Elastic energy of the displacements `u`, without initial stress \[J, or J/m of thickness\].
    #[must_use]
    pub fn strain_energy(&self, u: &[f64]) -> f64 {
        let (mut offset, mut sum) = (0, 0.0);
        for block in self.cell_dofs().blocks() {
            let n = block.len();
            for (row, &dof) in self.stiffness()[offset..offset + n * n].chunks_exact(n).zip(block) {
                sum += 0.5 * u[dof] * row.iter().zip(block).map(|(k, &other)| k * u[other]).sum::<f64>();
            }
            offset += n * n;
        }
        sum
    }

    /// Cell stiffness matrices one after another, each row by row \[N/m, or N/m² in the plane\]; symmetric to the last bit.
    #[must_use]
    pub fn stiffness(&self) -> &[f64] {
        self.stiffness.get_or_init(|| self.assemble())
    }
}

/// The computed value, without a copy if it is not shared.
fn taken<T: Clone + Default>(shared: Arc<OnceLock<T>>) -> T {
    match Arc::try_unwrap(shared) {
        Ok(own) => own.into_inner().unwrap_or_default(),
        Err(shared) => shared.get().cloned().unwrap_or_default(),
    }
}

fn pattern(cells: &Cells, components: usize) -> Pattern {
    let width = cells.kind.nodes() * components;
    let dofs =
        cells.connectivity.iter().flat_map(|&n| (0..components).map(move |c| n * components + c)).collect();
    Pattern::new(Blocks::uniform(dofs, width))
}

impl<const D: usize> Term for LinearBlock<D> {
    fn name(&self) -> &str {
        &self.name
    }

    fn residual(&mut self, u: &[f64], _at: Instant, r: &mut [f64]) -> Result<(), Refusal> {
        let mut offset = 0;
        let mut local = [0.0; MOST_DOFS];
        let stiffness = self.stiffness();
        for block in self.cell_dofs().blocks() {
            let n = block.len();
            for (value, &dof) in local.iter_mut().zip(block) {
                *value = u[dof];
            }
            for (row, &dof) in stiffness[offset..offset + n * n].chunks_exact(n).zip(block) {
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
        self.cell_dofs()
    }

    fn tangent(&mut self, values: &mut [f64]) {
        values.copy_from_slice(self.stiffness());
    }

    fn constant_tangent(&self) -> Option<&[f64]> {
        Some(self.stiffness())
    }
}

impl<const D: usize> ForwardTerm for LinearBlock<D> {
    fn rate(&mut self, _at: Instant, values: &mut [f64], _constant: &mut [f64]) -> Result<(), Refusal> {
        values.copy_from_slice(self.stiffness());
        Ok(())
    }
}
