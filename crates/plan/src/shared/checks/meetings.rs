//! Bodies that meet where nothing joins them, bodies that are cut, and loads that meet on a face.

use super::double_loads;
use super::model_checks::body_name;
use crate::reading::scene::model::{Interface, MeshSource, Scene, Spanned};
use crate::shared::model::{Model, bounds};
use asperity_fem::mesh::{Side, cut, meeting};
use asperity_mechanics::Body;
use asperity_run::Warning;
use asperity_scene::lengths::brief;
use std::collections::BTreeSet;

/// True if an interface or a fault of the scene joins two bodies.
fn joined(scene: &Scene, names: [&str; 2]) -> bool {
    let both = |a: &Spanned<String>, b: &Spanned<String>| {
        let [a, b] = [a, b].map(body_name);
        [[a.as_str(), b.as_str()], [b.as_str(), a.as_str()]].contains(&names)
    };
    scene.interfaces.values().any(|i| i.master.iter().any(|master| both(&i.slave, master)))
        || scene.faults.values().any(|f| both(&f.minus, &f.plus))
}

/// True if the boxes of two bodies are apart.
fn apart<const D: usize>(model: &Model<D>, bodies: [&Body<D>; 2]) -> bool {
    let [one, other] = bodies.map(|body| bounds(&model.mesh.nodes[body.nodes.clone()]));
    (0..D).any(|c| one.0[c] > other.1[c] || other.0[c] > one.1[c])
}

/// Warnings about the bodies of a model and the loads on their sets.
pub(crate) fn doubts<const D: usize>(scene: &Scene, model: &Model<D>) -> Vec<Warning> {
    let mut all = unjoined(scene, model);
    all.extend(cuts(scene, model));
    all.extend(double_loads::doubts(scene, model));
    all
}

/// Warnings about bodies that touch or overlap, and do not feel each other.
fn unjoined<const D: usize>(scene: &Scene, model: &Model<D>) -> Vec<Warning> {
    let mut all = Vec::new();
    for (k, one) in model.bodies.iter().enumerate() {
        for other in &model.bodies[k + 1..] {
            if joined(scene, [&one.name, &other.name]) || apart(model, [one, other]) {
                continue;
            }
            let of = |a: &Body<D>, b: &Body<D>| meeting(&model.mesh, a.blocks.clone(), b.blocks.clone());
            let faces = [of(one, other), of(other, one)].concat();
            let (Some(first), Some(spec)) = (faces.first(), scene.bodies.get(&other.name)) else { continue };
            all.push(Warning::at(
                spec.material.span(),
                format!(
                    "bodies `{}` and `{}` meet at {} of their faces, such as at ({}), and no interface joins them: they do not feel each other",
                    one.name,
                    other.name,
                    faces.len(),
                    first.map(brief).join(", ")
                ),
                "an interface with the sides of both that meet; or put them apart",
            ));
        }
    }
    all
}

/// Faces of which a scene says what happens there: those of interfaces, faults and conditions.
fn known_faces<const D: usize>(scene: &Scene, model: &Model<D>) -> BTreeSet<Side> {
    let interfaces = scene.interfaces.values().flat_map(Interface::sides);
    let faults = scene.faults.values().flat_map(|f| [&f.minus, &f.plus]);
    let conditions = scene.stages.iter().flat_map(|stage| &stage.conditions);
    let sets = interfaces.chain(faults).chain(conditions.filter_map(|c| c.get_ref().set.as_ref()));
    sets.filter_map(|set| model.mesh.side_sets.get(set.get_ref())).flatten().copied().collect()
}

/// Warnings about bodies of a mesh that has a cut, whose sides do not feel each other.
fn cuts<const D: usize>(scene: &Scene, model: &Model<D>) -> Vec<Warning> {
    let known = known_faces(scene, model);
    let doubt = |body: &Body<D>| {
        let spec = scene.bodies.get(&body.name)?;
        if matches!(spec.mesh, MeshSource::Block(_) | MeshSource::Quadrilateral(_)) {
            return None;
        }
        let faces = cut(&model.mesh, body.blocks.clone(), &known);
        let first = faces.first()?;
        Some(Warning::at(
            spec.material.span(),
            format!(
                "body `{}` is cut or lies over itself along {} of its faces, such as at ({}), and no interface joins them: they do not feel each other",
                body.name,
                faces.len(),
                first.map(brief).join(", ")
            ),
            "an interface with both sides of the cut; or a mesh without it, whose parts do not overlap. A crack that stays open may stay",
        ))
    };
    model.bodies.iter().filter_map(doubt).collect()
}
