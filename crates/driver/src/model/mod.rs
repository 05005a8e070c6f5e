//! The discrete model of a scene: one mesh of all bodies, and what each block of its cells is.

mod cell_size;
pub mod materials;
pub mod meshes;
pub mod sizes;

use self::cell_size::cell_size;
use crate::diagnostic::Diagnostic;
use crate::forecast::{self, Counts};
use crate::initial_stress;
use crate::scene::model as scene;
use crate::scene::near::suggest;
use asperity_fem::FemError;
use asperity_fem::block::{LinearBlock, von_mises};
use asperity_fem::condense::Stiffness;
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::material::elastic::Elastic;
use asperity_fem::mesh::{Cells, Mesh, Side};
use asperity_fem::nonlinear::{self, Kinematics, Limits, Material};
use asperity_fem::surface;
use asperity_fem::term::{Limited, Linearized, Pattern};
use std::collections::BTreeMap;
use std::ops::Range;

/// Cells of one kind and material as a term.
#[derive(Clone, Debug)]
pub enum CellBlock<const D: usize> {
    /// Elastic, small strain.
    Linear(Box<LinearBlock<D>>),
    /// Anything else.
    Nonlinear(Box<nonlinear::Block<D>>),
}

impl<const D: usize> CellBlock<D> {
    /// The linear block, where it is one.
    #[must_use]
    pub fn linear(&self) -> Option<&LinearBlock<D>> {
        match self {
            Self::Linear(block) => Some(block),
            Self::Nonlinear(_) => None,
        }
    }

    /// As a term of an implicit step.
    pub fn linearized(&mut self) -> &mut dyn Linearized {
        match self {
            Self::Linear(block) => block.as_mut(),
            Self::Nonlinear(block) => block.as_mut(),
        }
    }

    /// As a term of a forward step.
    pub fn limited(&mut self) -> &mut dyn Limited {
        match self {
            Self::Linear(block) => block.as_mut(),
            Self::Nonlinear(block) => block.as_mut(),
        }
    }

    /// Forces of a cell on its nodes, in the order of its degrees of freedom \[N, or N/m of thickness\], for displacements `u`
    /// of the common mesh; a block that is not linear knows its state itself.
    #[must_use]
    pub fn forces_of_cell(&self, cell: usize, u: &[f64]) -> Vec<f64> {
        let block = match self {
            Self::Nonlinear(block) => return block.forces_of_cell(cell),
            Self::Linear(block) => block,
        };
        let pattern = block.pattern();
        let dofs = &pattern.dofs[pattern.starts[cell]..pattern.starts[cell + 1]];
        let size = dofs.len();
        let rows = block.stiffness()[cell * size * size..(cell + 1) * size * size].chunks_exact(size);
        rows.map(|row| row.iter().zip(dofs).map(|(k, &dof)| k * u[dof]).sum()).collect()
    }

    /// Bytes of cells with a history.
    #[must_use]
    pub fn history_bytes(&self) -> usize {
        match self {
            Self::Linear(_) => 0,
            Self::Nonlinear(block) => block.bytes(),
        }
    }

    /// Its degrees of freedom, cell by cell.
    #[must_use]
    pub fn pattern(&self) -> &Pattern {
        match self {
            Self::Linear(block) => block.pattern(),
            Self::Nonlinear(block) => block.pattern(),
        }
    }
}

/// A body of the model.
#[derive(Debug)]
pub struct Body<const D: usize> {
    /// Name in the scene.
    pub name: String,
    /// Its nodes in the common mesh.
    pub nodes: Range<usize>,
    /// Its blocks of cells in the common mesh.
    pub blocks: Range<usize>,
    /// Elastic constants of each of its blocks.
    pub elastic: Vec<Elastic>,
    /// Element size h of a generated block of equal or steadily growing cells: the largest edge of the bounding box of its first cell \[m\].
    size: Option<f64>,
    /// Nodes of each connected part, ascending; a body that is split right through has several.
    pub parts: Vec<Vec<usize>>,
    /// Why it is not linear; `None` when it is.
    pub nonlinear: Option<&'static str>,
    /// Its degrees of freedom in the common mesh.
    pub dofs: Range<usize>,
}

/// Mesh and bodies of a scene.
#[derive(Debug)]
pub struct Model<const D: usize> {
    /// All bodies in one mesh; sets are named `body.set`.
    pub mesh: Mesh<D>,
    /// What the blocks of the mesh are, in its order.
    pub blocks: Vec<CellBlock<D>>,
    /// The bodies, in the order of their names.
    pub bodies: Vec<Body<D>>,
    /// Idealisation of space: degree of freedom = node * [`Idealisation::components`] + component.
    pub idealisation: Idealisation,
    /// Diagonal of the bounding box \[m\].
    pub scale: f64,
}

impl<const D: usize> Model<D> {
    /// Makes or reads the meshes of a scene and the terms of its bodies.
    ///
    /// # Errors
    /// [`Diagnostic`] naming the body whose mesh or material is not admissible.
    pub fn new(scene: &scene::Scene) -> Result<Self, Diagnostic> {
        let idealisation = scene.kinematics.get_ref().idealisation();
        idealisation
            .check_dimension(D)
            .map_err(|e| Diagnostic::at(scene.kinematics.span(), e.to_string(), "see `kinematics`"))?;
        forecast::admit(scene)?;
        let mut mesh = Mesh::<D>::default();
        let mut parts = Vec::new();
        for (name, body) in &scene.bodies {
            let part = meshes::of_body::<D>(scene, name, body)?;
            let even = matches!(&body.mesh, scene::MeshSource::Block(b) if b.spacing.is_none());
            let size = even.then(|| cell_size(&part, 0, 0));
            let (nodes, blocks) = (mesh.nodes.len(), mesh.blocks.len());
            mesh.append(part, name);
            parts.push((name, body, (nodes..mesh.nodes.len(), blocks..mesh.blocks.len()), size));
        }
        forecast::machine(&counts(&mesh), idealisation)?;
        let mut model =
            Self { scale: diagonal(&mesh.nodes), mesh, blocks: Vec::new(), bodies: Vec::new(), idealisation };
        for (name, body, (nodes, blocks), size) in parts {
            let mut elastic = Vec::new();
            for block in blocks.clone() {
                let (_, material) = model.material(scene, (name, body), block)?;
                elastic.push(materials::elastic(material)?);
                model.blocks.push(cell_block(
                    (scene, &model.mesh),
                    block,
                    (name, body),
                    material,
                    idealisation,
                )?);
            }
            let parts = connected(&model.mesh, nodes.clone(), blocks.clone());
            let linear = model.blocks[blocks.clone()].iter().all(|b| b.linear().is_some());
            let nonlinear = match (linear, body.is_finite()) {
                (true, _) => None,
                (false, true) => Some("large deformation is followed"),
                (false, false) => Some("its material is not elastic"),
            };
            let (name, components) = (name.to_string(), idealisation.components());
            let dofs = nodes.start * components..nodes.end * components;
            model.bodies.push(Body { name, nodes, blocks, elastic, size, parts, nonlinear, dofs });
        }
        Ok(model)
    }

    /// The material of a block of a body, with its name.
    ///
    /// # Errors
    /// [`Diagnostic`] when its cells have none, or several.
    pub fn material<'a>(
        &self,
        scene: &'a scene::Scene,
        (name, body): (&str, &'a scene::Body),
        block: usize,
    ) -> Result<(&'a str, &'a scene::Material), Diagnostic> {
        let prefix = format!("{name}.");
        let of_block = |group: &str| self.mesh.cell_sets.get(group).is_some_and(|s| s.contains(&block));
        let mut found: Option<(&str, (&'a str, &'a scene::Material))> = None;
        for (group, material, place) in body.materials() {
            let Some(group) = group else { return Ok((material, materials::find(scene, material, place)?)) };
            if !self.mesh.cell_sets.contains_key(&format!("{prefix}{group}")) {
                let known = self.mesh.cell_sets.keys().filter_map(|k| k.strip_prefix(&prefix));
                return Err(Diagnostic::at(
                    place,
                    format!("body `{name}` has no cells in a group `{group}`"),
                    suggest(group, "groups of its cells", known),
                ));
            }
            if !of_block(&format!("{prefix}{group}")) {
                continue;
            }
            if let Some((first, _)) = found {
                return Err(Diagnostic::at(
                    place,
                    format!("cells of body `{name}` lie in both groups `{first}` and `{group}`"),
                    "one material for each cell",
                ));
            }
            found = Some((group, (material, materials::find(scene, material, place)?)));
        }
        found.map(|f| f.1).ok_or_else(|| {
            let groups: Vec<&str> =
                self.mesh.cell_sets.keys().filter(|g| of_block(g)).map(String::as_str).collect();
            let which =
                if groups.is_empty() { "in no group".into() } else { format!("in {}", groups.join(", ")) };
            Diagnostic::at(
                body.material.span(),
                format!("cells of body `{name}` {which} have no material"),
                "name one for each group of cells",
            )
        })
    }

    /// Cells and nodes of each block.
    #[must_use]
    pub fn counts(&self) -> Vec<Counts> {
        counts(&self.mesh)
    }

    /// Degrees of freedom in all.
    #[must_use]
    pub fn dofs(&self) -> usize {
        self.mesh.nodes.len() * self.idealisation.components()
    }

    /// Degree of freedom of a node along an axis of space.
    ///
    /// # Panics
    /// When no displacement points there, which the check of a scene refuses.
    #[must_use]
    pub fn dof(&self, node: usize, axis: usize) -> usize {
        let component =
            self.idealisation.component(axis).expect("the check refuses axes without a displacement");
        node * self.idealisation.components() + component
    }

    /// Displacement of a node in space \[m\], given that of all degrees of freedom.
    #[must_use]
    pub fn displacement(&self, node: usize, u: &[f64]) -> [f64; 3] {
        let components = self.idealisation.components();
        let mut displacement = [0.0; 3];
        for (c, value) in u[node * components..(node + 1) * components].iter().enumerate() {
            displacement[self.idealisation.axis(c)] = *value;
        }
        displacement
    }

    /// Whether all bodies are linear.
    #[must_use]
    pub fn is_linear(&self) -> bool {
        self.bodies.iter().all(|b| b.nonlinear.is_none())
    }

    /// Degrees of freedom of the cells of a linear body in its own numbering, cell by cell.
    #[must_use]
    pub fn pattern(&self, body: &Body<D>) -> Pattern {
        let first = body.dofs.start;
        let mut own = Pattern { dofs: Vec::new(), starts: vec![0], version: 0 };
        for block in self.blocks[body.blocks.clone()].iter().filter_map(CellBlock::linear) {
            let (pattern, offset) = (block.pattern(), own.dofs.len());
            own.dofs.extend(pattern.dofs.iter().map(|d| d - first));
            own.starts.extend(pattern.starts[1..].iter().map(|s| s + offset));
        }
        own
    }

    /// The stiffness of a linear body in its own numbering, for condensation; blocks that are not linear have none.
    #[must_use]
    pub fn stiffness(&self, body: &Body<D>) -> Stiffness {
        let blocks = self.blocks[body.blocks.clone()].iter().filter_map(CellBlock::linear);
        let values = blocks.flat_map(|b| b.stiffness().iter().copied()).collect();
        Stiffness { pattern: self.pattern(body), values, dofs: body.dofs.len() }
    }

    /// The stiffness of all bodies, which are linear, in the numbering of the model. The blocks of cells are gone then: where nothing else is
    /// asked of them, their memory serves what follows.
    pub fn take_stiffness(&mut self) -> Stiffness {
        let dofs = self.dofs();
        let blocks: Vec<LinearBlock<D>> = std::mem::take(&mut self.blocks)
            .into_iter()
            .filter_map(|block| match block {
                CellBlock::Linear(block) => Some(*block),
                CellBlock::Nonlinear(_) => None,
            })
            .collect();
        let mut all = Stiffness {
            pattern: Pattern { dofs: Vec::new(), starts: vec![0], version: 0 },
            values: Vec::new(),
            dofs,
        };
        for block in blocks {
            let (pattern, values) = block.into_stiffness();
            let offset = all.pattern.dofs.len();
            all.pattern.starts.extend(pattern.starts[1..].iter().map(|s| s + offset));
            if all.values.is_empty() {
                (all.pattern.dofs, all.values) = (pattern.dofs, values);
            } else {
                all.pattern.dofs.extend(pattern.dofs);
                all.values.extend(values);
            }
        }
        all
    }

    /// The faces of a set.
    ///
    /// # Errors
    /// [`Diagnostic`] when the set does not exist, with those that do.
    pub fn sides(&self, set: &scene::Spanned<String>) -> Result<&[Side], Diagnostic> {
        self.mesh.side_sets.get(set.get_ref()).map(Vec::as_slice).ok_or_else(|| {
            let known = self.mesh.side_sets.keys().map(String::as_str);
            Diagnostic::at(
                set.span(),
                format!("there is no set `{}`", set.get_ref()),
                suggest(set.get_ref(), "sets", known),
            )
        })
    }

    /// Index of the body a set belongs to, by the part of its name before the point.
    #[must_use]
    pub fn body_of(&self, set: &str) -> Option<usize> {
        let name = set.split('.').next()?;
        self.bodies.iter().position(|b| b.name == name)
    }

    /// Tributary areas of the nodes of faces \[m^(D-1); m² of the full circle about an axis\].
    ///
    /// # Errors
    /// [`FemError::NodalAreas`] for faces in space of six or eight nodes, whose nodes cannot stand for areas.
    pub fn tributary_areas(&self, sides: &[Side]) -> Result<BTreeMap<usize, f64>, FemError> {
        for side in sides {
            let kind = self.mesh.blocks[side.block].kind;
            if D == 3 && matches!(kind.faces()[side.face].len(), 6 | 8) {
                return Err(FemError::NodalAreas { element: kind.name() });
            }
        }
        Ok(surface::areas(&self.mesh, sides, self.idealisation))
    }

    /// Unit normal of a face, outward of its body.
    #[must_use]
    pub fn face_normal(&self, face: &[usize]) -> Vec<f64> {
        let edge = |a: usize, b: usize| -> Vec<f64> {
            (0..D).map(|c| self.mesh.nodes[face[b]][c] - self.mesh.nodes[face[a]][c]).collect()
        };
        let e = edge(0, 1);
        let n = if D == 2 {
            vec![e[1], -e[0]]
        } else {
            let f = edge(0, 2);
            vec![e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]]
        };
        let length = n.iter().map(|c| c * c).sum::<f64>().sqrt();
        n.iter().map(|c| c / length).collect()
    }

    /// Young's modulus over element size behind the faces of a body \[Pa/m\]: of the first cell there, and for the size of a
    /// generated block of the first cell of the block, of other meshes the mean of the cells at the faces.
    #[must_use]
    pub fn young_per_size(&self, body: &Body<D>, sides: &[Side]) -> f64 {
        let first = sides.first().map_or(body.blocks.start, |s| s.block);
        let young = body.elastic[first - body.blocks.start].young();
        young / self.element_size(body, sides)
    }

    /// The declared element size of a body, or the mean size of the cells behind `sides` \[m\].
    #[must_use]
    pub fn element_size(&self, body: &Body<D>, sides: &[Side]) -> f64 {
        body.size.unwrap_or_else(|| {
            let sizes = sides.iter().map(|s| cell_size(&self.mesh, s.block, s.cell));
            sizes.sum::<f64>() / sides.len().max(1) as f64
        })
    }
}

/// Cells and nodes of each block; nodes that blocks share count for the first.
fn counts<const D: usize>(mesh: &Mesh<D>) -> Vec<Counts> {
    let nodes = |b: usize| if b == 0 { mesh.nodes.len() as f64 } else { 0.0 };
    let count =
        |(b, cells): (usize, &Cells)| Counts { kind: cells.kind, cells: cells.len() as f64, nodes: nodes(b) };
    mesh.blocks.iter().enumerate().map(count).collect()
}

/// The one place where it is decided whether cells are linear.
fn cell_block<const D: usize>(
    (scene, mesh): (&scene::Scene, &Mesh<D>),
    block: usize,
    (name, body): (&str, &scene::Body),
    material: &scene::Material,
    idealisation: Idealisation,
) -> Result<CellBlock<D>, Diagnostic> {
    let place = body.formulation.as_ref().map_or_else(|| body.material.span(), scene::Spanned::span);
    let formulation = match body.formulation.as_ref().map(|f| *f.get_ref()) {
        Some(scene::Formulation::BBar) => Formulation::BBar,
        _ => Formulation::Standard,
    };
    if material.is_elastic() && !body.is_finite() {
        let elastic = materials::elastic(material)?;
        return LinearBlock::new(mesh, block, &elastic, idealisation, formulation)
            .map(|b| CellBlock::Linear(Box::new(b)))
            .map_err(|e| Diagnostic::body(name, place, e.to_string()));
    }
    let model = nonlinear::Model {
        material: materials::behaviour(material)?,
        idealisation,
        kinematics: if body.is_finite() { Kinematics::UpdatedLagrangian } else { Kinematics::Small },
        formulation,
        limits: Limits::default(),
    };
    let mut term = nonlinear::Block::new(mesh, block, model)
        .map_err(|e| Diagnostic::body(name, place, e.to_string()))?
        .named(format!("body `{name}`, cells {block}"));
    if let (Some(stress), Some(given)) = (initial_stress::of_body(scene, name), &body.initial_stress) {
        let everywhere = mesh.blocks[block].connectivity.iter().map(|&n| stress.at(&mesh.nodes[n]));
        let borne = everywhere.map(|s| admissible(&s, &term.model().material)).find(Result::is_err);
        borne
            .unwrap_or(Ok(()))
            .and_then(|()| term.prestress_field(|x| stress.at(x)).map_err(|e| e.to_string()))
            .map_err(|e| Diagnostic::body(name, given.span(), e))?;
    }
    Ok(CellBlock::Nonlinear(Box::new(term)))
}

/// Whether a material can bear a stress.
fn admissible(stress: &[f64; 6], material: &Material) -> Result<(), String> {
    let Material::J2(j2) = material else { return Ok(()) };
    let (mises, limit) = (von_mises(stress), j2.hardening().at(0.0).stress);
    if mises <= limit {
        return Ok(());
    }
    Err(format!(
        "the Mises stress {mises:.6e} Pa of the initial stress lies above the yield stress {limit:.6e} Pa"
    ))
}

/// Nodes of each connected part of some blocks, in the order of their first nodes.
fn connected<const D: usize>(mesh: &Mesh<D>, nodes: Range<usize>, blocks: Range<usize>) -> Vec<Vec<usize>> {
    fn root(parent: &mut [usize], mut n: usize) -> usize {
        while parent[n] != n {
            parent[n] = parent[parent[n]];
            n = parent[n];
        }
        n
    }
    let first = nodes.start;
    let mut parent: Vec<usize> = (0..nodes.len()).collect();
    for cells in &mesh.blocks[blocks] {
        for cell in 0..cells.len() {
            let cell = cells.cell(cell);
            for &n in &cell[1..] {
                let (a, b) = (root(&mut parent, cell[0] - first), root(&mut parent, n - first));
                parent[a.max(b)] = a.min(b);
            }
        }
    }
    let mut parts: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for n in 0..nodes.len() {
        parts.entry(root(&mut parent, n)).or_default().push(first + n);
    }
    parts.into_values().collect()
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
