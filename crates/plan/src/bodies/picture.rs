//! Picture of the meshes of a scene with its sets, for `asperity check --plot`.

use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::Scene;
use crate::shared::checks::model_checks::used;
use crate::shared::model::{self, Model, bounds};
use asperity_fem::element::ElementKind;
use asperity_fem::mesh::{Mesh, Side, face_kind, face_nodes};
use asperity_output::figures::{Mark, MarkedSet, MeshPicture};
use std::collections::BTreeMap;

/// Picture of the bodies of a scene and of the sets that it uses; without bodies an empty one.
///
/// # Errors
/// [`Diagnostic`] with the position in the scene.
pub fn picture(scene: &Scene) -> Result<MeshPicture, Diagnostic> {
    match scene.kinematics.get_ref().dimension() {
        2 => mesh_picture::<2>(scene),
        _ => mesh_picture::<3>(scene),
    }
}

fn mesh_picture<const D: usize>(scene: &Scene) -> Result<MeshPicture, Diagnostic> {
    let (title, in_space) = (scene.title.clone(), D == 3);
    if scene.bodies.is_empty() {
        return Ok(MeshPicture { title, in_space, ..MeshPicture::default() });
    }
    let model = model::build::<D>(scene)?;
    let bodies = model.bodies.iter().map(|body| {
        let (min, max) = bounds(&model.mesh.nodes[body.nodes.clone()]);
        let middle = std::array::from_fn(|c| if c < D { 0.5 * (min[c] + max[c]) } else { 0.0 });
        (body.name.clone(), middle)
    });
    let faces = if D == 3 { outer(&model.mesh) } else { cells(&model.mesh) };
    Ok(MeshPicture {
        title,
        in_space,
        bodies: bodies.collect(),
        faces,
        sets: sets(scene, &model),
        ..MeshPicture::default()
    })
}

/// A position in space.
fn padded<const D: usize>(x: &[f64; D]) -> [f64; 3] {
    std::array::from_fn(|c| x.get(c).copied().unwrap_or(0.0))
}

/// Corners of all cells of a flat mesh.
fn cells<const D: usize>(mesh: &Mesh<D>) -> Vec<Vec<[f64; 3]>> {
    let corners = |kind: ElementKind| kind.linear().nodes();
    let ring = |nodes: &[usize]| nodes.iter().map(|&n| padded(&mesh.nodes[n])).collect();
    let blocks = mesh.blocks.iter();
    blocks.flat_map(|b| (0..b.len()).map(move |c| ring(&b.cell(c)[..corners(b.kind)]))).collect()
}

/// Corners of a face.
fn corners<const D: usize>(mesh: &Mesh<D>, side: &Side) -> Vec<usize> {
    let mut nodes = face_nodes(mesh, side);
    nodes.truncate(face_kind(mesh, side).corners());
    nodes
}

/// Corners of the faces that belong to one cell alone.
fn outer<const D: usize>(mesh: &Mesh<D>) -> Vec<Vec<[f64; 3]>> {
    let mut all: Vec<([usize; 4], Side)> = Vec::new();
    for (block, cells) in mesh.blocks.iter().enumerate() {
        for (cell, face) in (0..cells.len()).flat_map(|c| (0..cells.kind.faces().len()).map(move |f| (c, f)))
        {
            let side = Side { block, cell, face };
            let mut key = [usize::MAX; 4];
            key.iter_mut().zip(corners(mesh, &side)).for_each(|(k, n)| *k = n);
            key.sort_unstable();
            all.push((key, side));
        }
    }
    all.sort_unstable();
    let alone = all.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() == 1);
    alone
        .map(|same| corners(mesh, &same[0].1).into_iter().map(|n| padded(&mesh.nodes[n])).collect())
        .collect()
}

/// Meaning of a use of a set; `None` for an output.
fn mark(word: &str) -> Option<Mark> {
    match word {
        "held" => Some(Mark::Held),
        "moved" | "drawn by a spring" => Some(Mark::Moved),
        "loaded" => Some(Mark::Loaded),
        "absorbs waves" => Some(Mark::Absorbing),
        _ if word.starts_with("fault") || word.starts_with("interface") => Some(Mark::Surface),
        _ => None,
    }
}

/// The sets that a scene uses, in the order of their names.
fn sets<const D: usize>(scene: &Scene, model: &Model<D>) -> Vec<MarkedSet> {
    let mut words: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    let mut found = BTreeMap::new();
    for (set, word) in used(scene) {
        // Sets of nodes have no faces that could be drawn.
        let Some(sides) = model.mesh.side_sets.get(set.get_ref()) else { continue };
        found.insert(set.get_ref().as_str(), sides.as_slice());
        let own = words.entry(set.get_ref()).or_default();
        if !own.contains(&word) {
            own.push(word);
        }
    }
    let of = |(set, sides): (&str, &[Side])| {
        let own = &words[set];
        let mut marks: Vec<Mark> = own.iter().filter_map(|word| mark(word)).collect();
        marks.sort_unstable();
        marks.dedup();
        let ring =
            |side: &Side| corners(&model.mesh, side).iter().map(|&n| padded(&model.mesh.nodes[n])).collect();
        let label = format!("{set}: {}", own.join(", "));
        MarkedSet { label, marks, faces: sides.iter().map(ring).collect() }
    };
    found.into_iter().map(of).collect()
}
