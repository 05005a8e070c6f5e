//! The discrete model of a scene: one mesh of all bodies, their stiffness, and the interfaces between them.

use crate::plan::PlanError;
use crate::scene::model as scene;
use asperity_fem::block::LinearBlock;
use asperity_fem::condense::Stiffness;
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::material::elastic::Elastic;
use asperity_fem::mesh::generate::{Block, Grading, divisions_for};
use asperity_fem::mesh::{Mesh, Side};
use asperity_fem::term::{Linearized, Pattern};
use std::ops::Range;

/// A body of the model.
#[derive(Debug)]
pub struct Body<const D: usize> {
    /// Name in the scene.
    pub name: String,
    /// Its nodes in the common mesh.
    pub nodes: Range<usize>,
    /// Its material.
    pub material: Elastic,
    /// Its linear stiffness on the degrees of freedom of the common mesh.
    pub block: LinearBlock<D>,
    /// Element size h: the largest edge of the bounding box of its first cell \[m\].
    pub size: f64,
}

impl<const D: usize> Body<D> {
    /// Degrees of freedom of the body in the common mesh.
    #[must_use]
    pub fn dofs(&self) -> Range<usize> {
        self.nodes.start * D..self.nodes.end * D
    }

    /// The stiffness in the body's own numbering, for condensation.
    #[must_use]
    pub fn stiffness(&self) -> Stiffness {
        let first = self.dofs().start;
        let pattern = self.block.pattern();
        let own = Pattern {
            dofs: pattern.dofs.iter().map(|d| d - first).collect(),
            starts: pattern.starts.clone(),
            version: pattern.version,
        };
        Stiffness { pattern: own, values: self.block.stiffness().to_vec(), dofs: self.dofs().len() }
    }
}

/// Mesh and bodies of a scene.
#[derive(Debug)]
pub struct Model<const D: usize> {
    /// All bodies in one mesh; sets are named `body.set`.
    pub mesh: Mesh<D>,
    /// The bodies, in the order of their names.
    pub bodies: Vec<Body<D>>,
    /// Diagonal of the bounding box \[m\].
    pub scale: f64,
}

impl<const D: usize> Model<D> {
    /// Generates the meshes of a scene and the stiffness of its bodies.
    ///
    /// # Errors
    /// [`PlanError`] naming the body whose mesh or material is not admissible.
    pub fn new(scene: &scene::Scene) -> Result<Self, PlanError> {
        let mut mesh = Mesh::<D>::default();
        let mut parts = Vec::new();
        for (name, body) in &scene.bodies {
            let scene::MeshSource::Block(spec) = &body.mesh;
            let part = generate::<D>(name, spec)?;
            let size = cell_size(&part);
            let first = mesh.nodes.len();
            mesh.append(part, name);
            parts.push((name, body, first..mesh.nodes.len(), size));
        }
        let mut bodies = Vec::new();
        for (index, (name, body, nodes, size)) in parts.into_iter().enumerate() {
            let material = material_of(scene, body)?;
            let space = Idealisation::of_dimension(D);
            let block = LinearBlock::new(&mesh, index, &material, space, Formulation::Standard)
                .map_err(|e| PlanError::body(name, body.material.span(), e.to_string()))?;
            bodies.push(Body { name: name.to_string(), nodes, material, block, size });
        }
        let scale = diagonal(&mesh.nodes);
        Ok(Self { mesh, bodies, scale })
    }

    /// Degrees of freedom in all.
    #[must_use]
    pub fn dofs(&self) -> usize {
        self.mesh.nodes.len() * D
    }

    /// The faces of a set.
    ///
    /// # Errors
    /// [`PlanError`] when the set does not exist, with those that do.
    pub fn sides(&self, set: &scene::Spanned<String>) -> Result<&[Side], PlanError> {
        self.mesh.side_sets.get(set.get_ref()).map(Vec::as_slice).ok_or_else(|| {
            let known: Vec<&str> = self.mesh.side_sets.keys().map(String::as_str).collect();
            PlanError::at(
                set.span(),
                format!("there is no set `{}`", set.get_ref()),
                format!("the sets are {}", known.join(", ")),
            )
        })
    }

    /// Index of the body a set belongs to, by the part of its name before the point.
    #[must_use]
    pub fn body_of(&self, set: &str) -> Option<usize> {
        let name = set.split('.').next()?;
        self.bodies.iter().position(|b| b.name == name)
    }
}

fn material_of(scene: &scene::Scene, body: &scene::Body) -> Result<Elastic, PlanError> {
    let name = body.material.get_ref();
    let spec = scene.materials.get(name).ok_or_else(|| {
        let known: Vec<&str> = scene.materials.keys().map(String::as_str).collect();
        PlanError::at(
            body.material.span(),
            format!("there is no material `{name}`"),
            format!("the materials are {}", known.join(", ")),
        )
    })?;
    Elastic::new(spec.young.get_ref().0, *spec.poisson.get_ref())
        .map_err(|e| PlanError::at(spec.young.span(), e.to_string(), "0 < E and -1 < nu < 0.5".into()))
}

fn generate<const D: usize>(name: &str, spec: &scene::BlockMesh) -> Result<Mesh<D>, PlanError> {
    let element: ElementKind =
        spec.element.get_ref().parse().map_err(|e| {
            PlanError::at(spec.element.span(), format!("{e}"), "see the list of elements".into())
        })?;
    let corner = |v: &scene::Spanned<Vec<crate::scene::units::Length>>| -> Result<[f64; D], PlanError> {
        let values: Vec<f64> = v.get_ref().iter().map(|l| l.0).collect();
        <[f64; D]>::try_from(values)
            .map_err(|v| PlanError::at(v_span(spec), format!("{} coordinates", v.len()), format!("give {D}")))
    };
    let (min, max) = (corner(&spec.min)?, corner(&spec.max)?);
    let mut divisions = [1; D];
    let mut grading = [Grading::Uniform; D];
    for axis in 0..D {
        divisions[axis] = divisions_along(spec, axis, max[axis] - min[axis])?;
        if let Some(g) = &spec.grading
            && let Some(&ratio) = g.get_ref().get(axis)
            && ratio != 1.0
        {
            grading[axis] = Grading::Geometric { ratio };
        }
    }
    Block { min, max, divisions, grading, kind: element }
        .mesh()
        .map_err(|e| PlanError::body(name, spec.element.span(), e.to_string()))
}

fn v_span(spec: &scene::BlockMesh) -> Range<usize> {
    spec.min.span()
}

fn divisions_along(spec: &scene::BlockMesh, axis: usize, length: f64) -> Result<usize, PlanError> {
    if let Some(divisions) = &spec.divisions {
        return divisions.get_ref().get(axis).copied().filter(|&n| n > 0).ok_or_else(|| {
            PlanError::at(
                divisions.span(),
                "divisions are incomplete".into(),
                "one positive number an axis".into(),
            )
        });
    }
    let size = spec.size.as_ref().ok_or_else(|| {
        PlanError::at(spec.element.span(), "the block has no element size".into(), "give `size`".into())
    })?;
    divisions_for(length, size.get_ref().0).map_err(|e| {
        PlanError::at(size.span(), e.to_string(), "a size that divides each edge of the block".into())
    })
}

/// Largest extent along an axis of the first cell \[m\].
fn cell_size<const D: usize>(mesh: &Mesh<D>) -> f64 {
    let cells = &mesh.blocks[0];
    let first = &cells.connectivity[..cells.kind.nodes()];
    let points: Vec<[f64; D]> = first.iter().map(|&n| mesh.nodes[n]).collect();
    let (min, max) = bounds(&points);
    (0..D).map(|c| max[c] - min[c]).fold(0.0, f64::max)
}

/// Corners of the bounding box.
#[must_use]
pub fn bounds<const D: usize>(points: &[[f64; D]]) -> ([f64; D], [f64; D]) {
    let mut min = [f64::INFINITY; D];
    let mut max = [f64::NEG_INFINITY; D];
    for p in points {
        for c in 0..D {
            min[c] = min[c].min(p[c]);
            max[c] = max[c].max(p[c]);
        }
    }
    (min, max)
}

fn diagonal<const D: usize>(points: &[[f64; D]]) -> f64 {
    let (min, max) = bounds(points);
    (0..D).map(|c| (max[c] - min[c]).powi(2)).sum::<f64>().sqrt()
}
