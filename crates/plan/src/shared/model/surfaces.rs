//! Surfaces of triangles, read from files.

use super::meshes::bytes;
pub(crate) use super::meshes::unit;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{DepthTriangles, FaultTriangles, Scene, Spanned};
use crate::reading::scene::suggestions::suggest;
use crate::reading::sniff::Reader;
use asperity_fem::mesh::triangles::{TriangleError, Triangles};
use asperity_fem::mesh::{Options, abaqus, gmsh, stl};

/// Triangles of a fault. `of_depths` makes those of a surface given by depths, which needs the geographic frame.
///
/// # Errors
/// [`Diagnostic`] at the file or at the name of a group.
pub fn triangles(
    scene: &Scene,
    spec: &FaultTriangles,
    of_depths: impl FnOnce(&DepthTriangles, &[u8]) -> Result<Triangles, Diagnostic>,
) -> Result<Triangles, Diagnostic> {
    let file = spec.file();
    let (parse, reader): (fn(&[u8]) -> _, _) = match spec {
        FaultTriangles::Depths(spec) => return of_depths(spec, &bytes(scene, file, Reader::Depths)?),
        FaultTriangles::Gmsh(_) => (gmsh::parse, Reader::Gmsh),
        FaultTriangles::Abaqus(_) => (abaqus::parse, Reader::Abaqus),
        FaultTriangles::Stl(_) => (stl::parse, Reader::Stl),
    };
    let options = Options { length_unit: unit(spec.unit())?, ..Options::default() };
    let groups: Option<Vec<&str>> =
        spec.groups().map(|g| g.get_ref().iter().map(|name| name.get_ref().as_str()).collect());
    let found = parse(&bytes(scene, file, reader)?)
        .map_err(TriangleError::from)
        .and_then(|raw| Triangles::new(&raw, &options, groups.as_deref()));
    found.map_err(|error| refused(spec, &error))
}

/// Error of a file, at the place in the scene that has to do with it.
fn refused(spec: &FaultTriangles, error: &TriangleError) -> Diagnostic {
    let (file, message) = (spec.file(), format!("mesh file `{}`: {error}", spec.file().get_ref()));
    let (kind, key) = match spec {
        FaultTriangles::Gmsh(_) => ("physical groups", "groups"),
        FaultTriangles::Abaqus(_) => ("element sets", "elsets"),
        FaultTriangles::Stl(_) | FaultTriangles::Depths(_) => ("solids", "solids"),
    };
    let in_file = "the error is in the file, not in the scene";
    let help = match error {
        TriangleError::MissingGroup { name, present } => {
            let named = spec.groups().and_then(|g| g.get_ref().iter().find(|n| n.get_ref() == name));
            let place = named.map_or(file.span(), Spanned::span);
            let help = suggest(name, kind, present.iter().map(String::as_str));
            return Diagnostic::at(place, message, help);
        }
        TriangleError::Solid { .. } => {
            &format!("name the {kind} of the fault, such as `{key} = [\"fault\"]`")
        }
        TriangleError::Shape { .. } => "mesh the fault with triangles of first order",
        TriangleError::Branch { .. } => &format!(
            "give each branch as a fault of its own, by {kind}; it ends one cell away from the others"
        ),
        TriangleError::OneSided { .. } => {
            "leave out the triangles along a cut, or give the parts as faults of their own"
        }
        _ => in_file,
    };
    Diagnostic::at(file.span(), message, help.to_string())
}
