//! The discrete model of a scene: one mesh of all bodies, and the type of each block of its cells.

pub(crate) mod cuts;
pub mod forecast;
pub mod locking;
mod locking_remedy;
pub mod materials;
pub mod meshes;
pub mod order;
pub(crate) mod samples;
pub(crate) mod sets;
pub mod surfaces;

use self::forecast::Counts;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model as scene;
use crate::reading::scene::suggestions::suggest;
use crate::shared::entry::Entry;
use crate::shared::{idealisation, initial_stress};
use asperity_fem::block::{LinearBlock, von_mises};
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::mesh::{Cells, Mesh};
use asperity_fem::nonlinear::{self, Kinematics, Limits, Material};
use asperity_mechanics::cell_size;
use std::collections::BTreeMap;
use std::ops::Range;

pub use asperity_mechanics::{Body, CellBlock, Model, bounds};
pub use sets::{nodes, sides};

/// Generates or reads the meshes of a scene, and builds the terms of its bodies.
///
/// # Errors
/// [`Diagnostic`] naming the body whose mesh or material is not admissible.
pub fn build<const D: usize>(scene: &scene::Scene) -> Result<Model<D>, Diagnostic> {
    let idealisation = idealisation::from_kinematics(*scene.kinematics.get_ref());
    idealisation
        .check_dimension(D)
        .map_err(|e| Diagnostic::at(scene.kinematics.span(), e.to_string(), "see `kinematics`"))?;
    materials::check(scene)?;
    forecast::admit(scene)?;
    let mut mesh = Mesh::<D>::default();
    let mut parts = Vec::new();
    for (name, body) in &scene.bodies {
        let part = numbered(scene, body, meshes::body_mesh::<D>(scene, name, body)?);
        let even =
            matches!(&body.mesh, scene::MeshSource::Block(b) if b.spacing.is_none() && b.coarser.is_none());
        let size = even.then(|| cell_size(&part, 0, 0));
        let (nodes, blocks) = (mesh.nodes.len(), mesh.blocks.len());
        mesh.append(part, name);
        parts.push((Entry::new(name, body), (nodes..mesh.nodes.len(), blocks..mesh.blocks.len()), size));
    }
    forecast::machine(scene, &counts(&mesh))?;
    let mut model =
        Model { scale: diagonal(&mesh.nodes), mesh, blocks: Vec::new(), bodies: Vec::new(), idealisation };
    for (body, (nodes, blocks), size) in parts {
        let mut elastic = Vec::new();
        for block in blocks.clone() {
            let (_, described) = self::material(&model.mesh, scene, body, block)?;
            elastic.push(materials::elastic(described)?);
            model.blocks.push(cell_block((scene, &model.mesh), block, body, described, idealisation)?);
        }
        let parts = connected(&model.mesh, nodes.clone(), blocks.clone());
        let linear = model.blocks[blocks.clone()].iter().all(|b| b.linear().is_some());
        let nonlinear = match (linear, body.spec.is_finite()) {
            (true, _) => None,
            (false, true) => Some("large deformation is followed"),
            (false, false) => Some("its material is not elastic"),
        };
        let (name, components) = (body.name.to_string(), idealisation.components());
        let dofs = nodes.start * components..nodes.end * components;
        model.bodies.push(Body { name, nodes, blocks, elastic, size, parts, nonlinear, dofs });
    }
    Ok(model)
}

/// The mesh of a body, ordered for explicit steps if it is used in these.
fn numbered<const D: usize>(scene: &scene::Scene, body: &scene::Body, mesh: Mesh<D>) -> Mesh<D> {
    if *scene.time.stepper.get_ref() != scene::Stepper::Explicit {
        return mesh;
    }
    match body.mesh {
        scene::MeshSource::Gmsh(_) | scene::MeshSource::Abaqus(_) => order::along_curve(mesh),
        scene::MeshSource::Block(_) => order::along_lines(mesh),
        _ => mesh,
    }
}

/// The material of a block of a body, with its name.
///
/// # Errors
/// [`Diagnostic`] if the cells have no material, or several.
pub fn material<'a, const D: usize>(
    mesh: &Mesh<D>,
    scene: &'a scene::Scene,
    Entry { name, spec: body }: Entry<'a, scene::Body>,
    block: usize,
) -> Result<(&'a str, &'a scene::Material), Diagnostic> {
    let prefix = format!("{name}.");
    let of_block = |group: &str| mesh.cell_sets.get(group).is_some_and(|s| s.contains(&block));
    let mut found: Option<(&str, (&'a str, &'a scene::Material))> = None;
    for (group, material, place) in body.materials() {
        let Some(group) = group else { return Ok((material, materials::find(scene, material, place)?)) };
        if !mesh.cell_sets.contains_key(&format!("{prefix}{group}")) {
            let known = mesh.cell_sets.keys().filter_map(|k| k.strip_prefix(&prefix));
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
        let groups: Vec<&str> = mesh.cell_sets.keys().filter(|g| of_block(g)).map(String::as_str).collect();
        let which =
            if groups.is_empty() { "in no group".into() } else { format!("in {}", groups.join(", ")) };
        Diagnostic::at(
            body.material.span(),
            format!("cells of body `{name}` {which} have no material"),
            "name one for each group of cells",
        )
    })
}

/// Cells and nodes of each block. All nodes are counted with the first block, so that shared ones count once.
#[must_use]
pub fn counts<const D: usize>(mesh: &Mesh<D>) -> Vec<Counts> {
    let nodes = |b: usize| if b == 0 { mesh.nodes.len() as f64 } else { 0.0 };
    let count =
        |(b, cells): (usize, &Cells)| Counts { kind: cells.kind, cells: cells.len() as f64, nodes: nodes(b) };
    mesh.blocks.iter().enumerate().map(count).collect()
}

/// Cells of a block, linear or nonlinear; no other place decides this.
fn cell_block<const D: usize>(
    (scene, mesh): (&scene::Scene, &Mesh<D>),
    block: usize,
    Entry { name, spec: body }: Entry<'_, scene::Body>,
    material: &scene::Material,
    idealisation: Idealisation,
) -> Result<CellBlock<D>, Diagnostic> {
    let place = body.formulation.as_ref().map_or_else(|| body.material.span(), scene::Spanned::span);
    let dilates = !matches!(idealisation, Idealisation::PlaneStress | Idealisation::Antiplane);
    if dilates {
        locking_remedy::admit(scene, Entry::new(name, body), mesh.blocks[block].kind)?;
    }
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
    if let (Some(stress), Some(given)) = (initial_stress::body_field(scene, name), &body.initial_stress) {
        let everywhere = mesh.blocks[block].connectivity.iter().map(|&n| stress.at(&mesh.nodes[n]));
        let borne = everywhere.map(|s| admissible(&s, &term.model().material)).find(Result::is_err);
        borne
            .unwrap_or(Ok(()))
            .and_then(|()| term.prestress_field(|x| stress.at(x)).map_err(|e| e.to_string()))
            .map_err(|e| Diagnostic::body(name, given.span(), e))?;
    }
    Ok(CellBlock::Nonlinear(Box::new(term)))
}

/// Checks that a material can sustain a stress.
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

/// Nodes of each connected part of some blocks, ordered by their first nodes.
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

fn diagonal<const D: usize>(points: &[[f64; D]]) -> f64 {
    let (min, max) = bounds(points);
    (0..D).map(|c| (max[c] - min[c]).powi(2)).sum::<f64>().sqrt()
}
