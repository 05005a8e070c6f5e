//! Sets of faces and of nodes that a scene names.

use super::meshes::in_words;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::Spanned;
use crate::reading::scene::suggestions::suggest;
use asperity_fem::mesh::{Side, nodes_of_sides};
use asperity_mechanics::Model;

/// Faces of a set.
///
/// # Errors
/// [`Diagnostic`] if the set does not exist, with the existing sets, or has no faces.
pub fn sides<'a, const D: usize>(
    model: &'a Model<D>,
    set: &Spanned<String>,
) -> Result<&'a [Side], Diagnostic> {
    let (mesh, name) = (&model.mesh, set.get_ref());
    whole(model, set)?;
    if let Some(sides) = mesh.side_sets.get(name) {
        return Ok(sides);
    }
    if let Some(nodes) = mesh.node_sets.get(name) {
        return Err(Diagnostic::at(
            set.span(),
            format!("`{name}` is a set of {} nodes, and faces are needed here", nodes.len()),
            "motions and springs act on sets of nodes; all else takes a group of the faces of cells: a physical group (Gmsh) or a \
             `*Surface` of element faces (Abaqus)",
        ));
    }
    let known = mesh.side_sets.keys().map(String::as_str);
    Err(unknown(model, set, suggest(name, "sets", known)))
}

/// Nodes of a set of faces or of nodes, ascending.
///
/// # Errors
/// [`Diagnostic`] if the set does not exist, with the existing sets.
pub fn nodes<const D: usize>(model: &Model<D>, set: &Spanned<String>) -> Result<Vec<usize>, Diagnostic> {
    whole(model, set)?;
    find_nodes(model, set.get_ref()).ok_or_else(|| {
        let (faces, nodes) = (model.mesh.side_sets.keys(), model.mesh.node_sets.keys());
        unknown(model, set, suggest(set.get_ref(), "sets", faces.chain(nodes).map(String::as_str)))
    })
}

/// Nodes of a set of faces or, if there is none of this name, of nodes.
pub(crate) fn find_nodes<const D: usize>(model: &Model<D>, name: &str) -> Option<Vec<usize>> {
    let of_faces = model.mesh.side_sets.get(name).map(|sides| nodes_of_sides(&model.mesh, sides));
    of_faces.or_else(|| model.mesh.node_sets.get(name).cloned())
}

/// Refuses a set of which elements are left out of the mesh.
fn whole<const D: usize>(model: &Model<D>, set: &Spanned<String>) -> Result<(), Diagnostic> {
    let Some(left) = model.mesh.left_out.get(set.get_ref()).filter(|left| left.read) else { return Ok(()) };
    Err(Diagnostic::at(
        set.span(),
        format!("the set `{}` of a mesh file has {}", set.get_ref(), in_words(left)),
        "a set of this scene has faces of cells alone: a body beside them is missing in the file, or they lie off it",
    ))
}

/// Error for a set that does not exist.
fn unknown<const D: usize>(model: &Model<D>, set: &Spanned<String>, known: String) -> Diagnostic {
    let name = set.get_ref();
    let cells = model.mesh.cell_sets.contains_key(name);
    let left = model.mesh.left_out.get(name);
    let instead = match (cells, left) {
        (true, _) => ": it is a group of cells, and faces are needed".to_string(),
        (false, Some(left)) => format!(": the file has {}", in_words(left)),
        (false, None) => String::new(),
    };
    Diagnostic::at(set.span(), format!("there is no set `{name}`{instead}"), known)
}
