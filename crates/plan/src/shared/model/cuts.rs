//! Surfaces along which the mesh of a file is split, and their plus sides.

use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model as scene;
use crate::reading::scene::suggestions::suggest;
use asperity_fem::mesh::Mesh;
use asperity_fem::mesh::split::{SplitError, Surface, split};
use asperity_fem::surface::mean_normal;
use scene::Spanned;
use std::collections::{BTreeMap, BTreeSet};

/// Parts of a unit to which normals are printed.
const DIGITS: f64 = 1e4;

/// Surfaces along which a mesh is split, and directions to the plus sides of some.
pub(super) type Cuts<'a> = (&'a [Spanned<String>], &'a BTreeMap<String, Spanned<Vec<f64>>>);

/// Splits a mesh along a surface; `plus` is the direction to its plus side, if the scene has one.
///
/// # Errors
/// [`Diagnostic`] at a surface or a direction that does not part two sides.
pub(super) fn cut<const D: usize>(
    mesh: &mut Mesh<D>,
    file: &str,
    name: &Spanned<String>,
    plus: Option<&Spanned<Vec<f64>>>,
) -> Result<(), Diagnostic> {
    let known = || suggest(name.get_ref(), "sets", mesh.side_sets.keys().map(String::as_str));
    let refuse = |message: String, help: String| Diagnostic::at(name.span(), message, help);
    let mut surface = Surface::from_side_set(mesh, name.get_ref()).map_err(|_| {
        refuse(format!("the mesh file `{file}` has no faces in a group `{}` here", name.get_ref()), known())
    })?;
    // A group between cells contains both sides of each face.
    let mut seen = BTreeSet::new();
    surface.faces.retain(|face| {
        let mut nodes = face.clone();
        nodes.sort_unstable();
        seen.insert(nodes)
    });
    // The scene check counts the components.
    surface.towards_plus =
        plus.map(|given| std::array::from_fn(|c| given.get_ref().get(c).copied().unwrap_or(0.0)));
    split(mesh, &[surface]).map(|_| ()).map_err(|e| match (&e, plus) {
        (SplitError::Hint { .. }, Some(direction)) => {
            Diagnostic::at(direction.span(), e.to_string(), "a direction across the surface")
        }
        (SplitError::Apart { .. }, _) => refuse(e.to_string(), chosen(name.get_ref(), D)),
        _ => refuse(
            e.to_string(),
            "a surface that is split lies inside the body and has cells on both sides".into(),
        ),
    })
}

/// Advice to choose the plus side of a surface.
fn chosen(name: &str, dimension: usize) -> String {
    let up = if dimension == 2 { "[0, 1]" } else { "[0, 1, 0]" };
    format!(
        "a direction from the minus to the plus side, such as `plus = {{ {name} = {up} }}` beside `split`; or surfaces with names of their own"
    )
}

/// Notes on the plus sides of the surfaces along which bodies from files are split.
pub(crate) fn notes<const D: usize>(scene: &scene::Scene, mesh: &Mesh<D>) -> Vec<String> {
    let mut all = Vec::new();
    for (body, spec) in &scene.bodies {
        let (surfaces, plus) = match &spec.mesh {
            scene::MeshSource::Gmsh(file) => (&file.split, &file.plus),
            scene::MeshSource::Abaqus(file) => (&file.split, &file.plus),
            scene::MeshSource::Block(_)
            | scene::MeshSource::Quadrilateral(_)
            | scene::MeshSource::Fault(_) => continue,
        };
        for surface in surfaces.iter().map(Spanned::get_ref) {
            let sides = mesh.side_sets.get(&format!("{body}.{surface}.minus"));
            let Some(normal) = sides.and_then(|sides| mean_normal(mesh, sides)) else { continue };
            all.push(side((body, surface), &normal, plus.contains_key(surface)));
        }
    }
    all
}

/// Note on the plus side of a surface with this mean normal from minus to plus.
fn side<const D: usize>((body, surface): (&str, &str), normal: &[f64; D], chosen: bool) -> String {
    // Adding zero turns -0 into 0.
    let parts: Vec<String> =
        normal.iter().map(|c| format!("{:.4}", (c * DIGITS).round() / DIGITS + 0.0)).collect();
    let why =
        if chosen { "as `plus` says" } else { "the side of larger x, or y or z where it is parallel to x" };
    format!(
        "the mean normal of `{body}.{surface}` from its minus to its plus side is ({}): {why}",
        parts.join(", ")
    )
}
