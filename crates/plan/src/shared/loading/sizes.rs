//! Checks the sizes of bodies whose meshes come from files. If their unit was omitted, they may be a thousand times too
//! large.

use super::Stage;
use crate::reading::scene::model::{MeshSource, Scene, Spanned};
use crate::shared::model::{Body, Model, bounds};
use asperity_run::Warning;
use asperity_scene::lengths::brief;
use std::ops::Range;

/// Largest prescribed motion over the size of a body that is suspiciously small. It is a strain of a millionth, or tens of kilopascals in rock. A
/// usual strain of a thousandth appears as this if the body is a thousand times too large.
const NO_MOTION: f64 = 1e-6;

/// Descriptions of the extents of bodies read from files.
pub fn file_extents<const D: usize>(scene: &Scene, model: &Model<D>) -> Vec<String> {
    let line = |body: &Body<D>| {
        let (_, unit) = file(&scene.bodies[&body.name].mesh)?;
        let (min, max) = bounds(&model.mesh.nodes[body.nodes.clone()]);
        let edges: Vec<String> = (0..D).map(|c| brief(max[c] - min[c])).collect();
        let said = unit.map_or("no `unit` is given, so that numbers are taken as m".to_string(), |unit| {
            format!("numbers are in {}", unit.get_ref())
        });
        Some(format!("body `{}` of a mesh file measures {}: {said}", body.name, edges.join(" x ")))
    };
    model.bodies.iter().filter_map(line).collect()
}

/// Warnings about bodies whose motion is negligible for their size: those read from files without a unit, and blocks, which may use another unit.
pub fn doubts<const D: usize>(scene: &Scene, model: &Model<D>, stages: &[Stage]) -> Vec<Warning> {
    let travel: f64 = stages.iter().map(Stage::travel).sum();
    if travel <= 0.0 || stages.iter().any(Stage::is_loaded) {
        return Vec::new();
    }
    let doubt = |body: &Body<D>| {
        let mesh = &scene.bodies[&body.name].mesh;
        let (min, max) = bounds(&model.mesh.nodes[body.nodes.clone()]);
        let size = (0..D).map(|c| max[c] - min[c]).fold(0.0, f64::max);
        if travel >= NO_MOTION * size {
            return None;
        }
        let what =
            format!("body `{}` is {} large and moved by {} at most", body.name, brief(size), brief(travel));
        if let MeshSource::Block(block) = mesh {
            let message = format!("{what}: it strains by less than a millionth");
            let help = "are its lengths meant in m? a number may have its unit, such as \"50 mm\"";
            return Some(Warning::at(block.max.span(), message, help));
        }
        let (place, unit) = file(mesh)?;
        unit.is_none().then(|| {
            let message = format!("{what}: its mesh file is read in m, since no `unit` is given");
            Warning::at(
                place,
                message,
                "add the unit of length of the file, such as `unit = \"mm\"`, or `unit = \"m\"`",
            )
        })
    };
    let mut found: Vec<Warning> = model.bodies.iter().filter_map(doubt).collect();
    // A mistake in the unit usually concerns all bodies, so only the first is reported.
    found.truncate(1);
    found
}

/// Position in the scene and unit of a mesh file.
fn file(mesh: &MeshSource) -> Option<(Range<usize>, Option<&Spanned<String>>)> {
    match mesh {
        MeshSource::Gmsh(file) => Some((file.file.span(), file.unit.as_ref())),
        MeshSource::Abaqus(file) => Some((file.file.span(), file.unit.as_ref())),
        MeshSource::Block(_) | MeshSource::Quadrilateral(_) | MeshSource::Fault(_) => None,
    }
}
