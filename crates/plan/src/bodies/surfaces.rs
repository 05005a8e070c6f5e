//! The two surfaces of an interface.

use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Interface as Spec, Spanned};
use crate::shared::entry::Entry;
use crate::shared::model::{self, Body, Model};
use asperity_fem::mesh::{MeshFace, Side};

/// Faces of a body.
#[derive(Clone, Copy)]
pub struct BodySurface<'m, const D: usize> {
    pub body: &'m Body<D>,
    pub sides: &'m [Side],
}

impl<const D: usize> BodySurface<'_, D> {
    /// Its faces in the mesh.
    pub fn faces(&self, model: &Model<D>) -> Vec<MeshFace> {
        self.sides.iter().map(|side| MeshFace::new(&model.mesh, side)).collect()
    }

    /// Young's modulus over the size of the cells at these faces \[Pa/m\].
    pub fn young_per_size(&self, model: &Model<D>) -> f64 {
        model.young_per_size(self.body, self.sides)
    }

    /// Size of the cells at these faces \[m\].
    pub fn cell_size(&self, model: &Model<D>) -> f64 {
        model.element_size(self.body, self.sides)
    }
}

/// The surfaces of an interface: the slave, and all masters that look at it.
#[derive(Clone)]
pub struct FacingSurfaces<'m, const D: usize> {
    pub slave: BodySurface<'m, D>,
    /// At least one.
    pub masters: Vec<BodySurface<'m, D>>,
}

impl<'m, const D: usize> FacingSurfaces<'m, D> {
    /// The surfaces of an interface of the scene.
    ///
    /// # Errors
    /// [`Diagnostic`] at a side that is no set of faces of a body.
    pub fn find(model: &'m Model<D>, Entry { name, spec }: Entry<'_, Spec>) -> Result<Self, Diagnostic> {
        let body = model.body_of(spec.slave.get_ref()).ok_or_else(|| {
            let help = "sets of bodies are named `body.set`";
            Diagnostic::at(spec.slave.span(), format!("interface `{name}`: the slave side has no body"), help)
        })?;
        let surface = |set: &Spanned<String>| {
            let own = model.body_of(set.get_ref()).unwrap_or(body);
            Ok(BodySurface { body: &model.bodies[own], sides: model::sides(model, set)? })
        };
        let masters = spec.master.iter().map(surface).collect::<Result<_, Diagnostic>>()?;
        Ok(Self { slave: surface(&spec.slave)?, masters })
    }

    /// Faces of all masters.
    pub fn master_sides(&self) -> Vec<Side> {
        self.masters.iter().flat_map(|master| master.sides).copied().collect()
    }
}
