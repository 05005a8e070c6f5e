//! The two surfaces of an interface.

use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::Interface as Spec;
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

/// The surfaces of an interface, which look at each other.
#[derive(Clone, Copy)]
pub struct SurfacePair<'m, const D: usize> {
    pub slave: BodySurface<'m, D>,
    pub master: BodySurface<'m, D>,
}

impl<'m, const D: usize> SurfacePair<'m, D> {
    /// The surfaces of an interface of the scene.
    ///
    /// # Errors
    /// [`Diagnostic`] at a side that is no set of faces of a body.
    pub fn find(model: &'m Model<D>, Entry { name, spec }: Entry<'_, Spec>) -> Result<Self, Diagnostic> {
        let (slave, master) = (model::sides(model, &spec.slave)?, model::sides(model, &spec.master)?);
        let body = model.body_of(spec.slave.get_ref()).ok_or_else(|| {
            let help = "sets of bodies are named `body.set`";
            Diagnostic::at(spec.slave.span(), format!("interface `{name}`: the slave side has no body"), help)
        })?;
        let facing = model.body_of(spec.master.get_ref()).unwrap_or(body);
        let surface = |body: usize, sides: &'m [Side]| BodySurface { body: &model.bodies[body], sides };
        Ok(Self { slave: surface(body, slave), master: surface(facing, master) })
    }
}
