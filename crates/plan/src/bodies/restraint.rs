//! Bodies that are not restrained by their conditions: remarks if contact holds them, remedies if nothing does.

use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::Scene;
use asperity_fem::mesh::face_nodes;
use asperity_mechanics::restraint::{self, Motion};
use asperity_mechanics::{Model, PlannedInterface, Stage, coordinates};

/// Checks all bodies in all stages. Returns remarks about bodies that contact alone holds.
///
/// # Errors
/// [`Diagnostic`] naming the body, the motion and the stage.
pub fn check<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    stages: &[Stage],
    interfaces: &[PlannedInterface],
) -> Result<Vec<String>, Diagnostic> {
    let remark = |held: &Motion| {
        let Motion { stage, motion, .. } = held;
        format!("stage `{stage}`: contact alone holds the {motion} of {}", part(model, held))
    };
    match restraint::check(model, stages, interfaces) {
        Ok(held) => Ok(held.iter().map(remark).collect()),
        Err(loose) => {
            let Motion { body, stage, motion, together, .. } = &loose;
            if !together.is_empty() {
                return Err(joined(scene, model, &loose));
            }
            let (what, name) = (part(model, &loose), &model.bodies[*body].name);
            Err(Diagnostic::at(
                scene.bodies[name].material.span(),
                format!("{what} is free to move in stage `{stage}`: nothing holds its {motion}"),
                remedy(model, name, motion),
            ))
        }
    }
}

/// Error for bodies that contact joins, and that move together.
fn joined<const D: usize>(scene: &Scene, model: &Model<D>, loose: &Motion) -> Diagnostic {
    let Motion { body, stage, motion, as_one, .. } = loose;
    let name = &model.bodies[*body].name;
    let what = if *as_one {
        format!("as one in stage `{stage}`: nothing holds their {motion}, which contact only passes on")
    } else {
        let first = part(model, loose);
        format!(
            "together in stage `{stage}`: contact passes the {motion} of {first} on, and nothing holds it"
        )
    };
    let message = format!("{} are free to move {what}", names(model, loose));
    Diagnostic::at(scene.bodies[name].material.span(), message, remedy(model, name, motion))
}

/// Names of bodies that move together.
fn names<const D: usize>(model: &Model<D>, loose: &Motion) -> String {
    let names: Vec<String> = loose.together.iter().map(|&b| format!("`{}`", model.bodies[b].name)).collect();
    match &names[..] {
        [only] => format!("the parts of body {only}"),
        [rest @ .., last] => format!("bodies {} and {last}", rest.join(", ")),
        [] => String::new(),
    }
}

/// Likely cause of a step without solution: a body that contact held and holds no longer; `None` if all are held.
pub fn lost<const D: usize>(
    model: &Model<D>,
    stage: &Stage,
    interfaces: &[PlannedInterface],
    closed: &dyn Fn(usize, usize) -> bool,
) -> Option<String> {
    let loose = restraint::parted(model, stage, interfaces, closed)?;
    let what = if loose.together.is_empty() {
        format!("{} is", part(model, &loose))
    } else {
        format!("{} are", names(model, &loose))
    };
    let nodes: Vec<&[usize]> = loose_parts(model, &loose);
    let open = interfaces.iter().enumerate().filter_map(|(k, interface)| {
        let mut faces = interface.slave_faces.iter().chain(&interface.master_faces);
        let own = faces.any(|face| nodes.iter().any(|part| part.binary_search(&face.nodes[0]).is_ok()));
        let all = interface.slave.len();
        let open = (0..all).filter(|&point| !closed(k, point)).count();
        (own && open > 0).then(|| format!("`{}` presses nothing at {open} of {all} points", interface.name))
    });
    let open: Vec<String> = open.collect();
    if open.is_empty() {
        return None;
    }
    Some(format!(
        "the likely cause: {what} free in {}, since contact is lost: interface {}. Hold it by a condition or a soft spring, or see whether a load or a motion pulls it off",
        loose.motion,
        open.join(", ")
    ))
}

/// Nodes of the parts that move.
fn loose_parts<'a, const D: usize>(model: &'a Model<D>, loose: &Motion) -> Vec<&'a [usize]> {
    let own = |b: &usize| model.bodies[*b].parts.iter().map(Vec::as_slice).collect::<Vec<_>>();
    if loose.together.is_empty() {
        let parts = own(&loose.body);
        return parts.into_iter().filter(|part| part.binary_search(&loose.node).is_ok()).collect();
    }
    loose.together.iter().flat_map(own).collect()
}

/// Description of the part of a body that can move.
fn part<const D: usize>(model: &Model<D>, moving: &Motion) -> String {
    let body = &model.bodies[moving.body];
    match body.parts.len() {
        1 => format!("body `{}`", body.name),
        _ => format!(
            "the part of body `{}` with the node at {}",
            body.name,
            coordinates::in_words(&model.mesh.nodes[moving.node])
        ),
    }
}

/// Largest number of sets of a body named in a remedy; more would obscure it.
const MOST_NAMED: usize = 8;

/// Remedy that would restrain a body.
fn remedy<const D: usize>(model: &Model<D>, body: &str, loose: &str) -> String {
    let own = |set: &&String| set.strip_prefix(body).is_some_and(|rest| rest.starts_with('.'));
    let sets: Vec<&String> = model.mesh.side_sets.keys().filter(own).collect();
    let axis = ["x", "y", "z"].iter().position(|axis| loose == format!("translation in {axis}"));
    let across = sets.iter().find(|set| axis.is_some_and(|axis| is_across(model, set, axis)));
    let Some(first) = across.or(sets.first()) else {
        return "the body has no sets: a condition needs one, such as a physical group of faces in its mesh"
            .into();
    };
    let example = match loose.strip_prefix("translation in ") {
        Some(axis) => format!("such as `{{ set = \"{first}\", {axis} = 0 }}`"),
        None => format!("such as one on `{first}` that holds both ends of the set"),
    };
    let named: Vec<String> = sets.iter().take(MOST_NAMED).map(|s| format!("`{s}`")).collect();
    let more = if sets.len() > MOST_NAMED { ", .." } else { "" };
    format!(
        "add a condition that prevents the {loose}, {example}, or an interface that can; its sets are {}{more}",
        named.join(", ")
    )
}

/// True if the faces of a set are normal to an axis.
fn is_across<const D: usize>(model: &Model<D>, set: &str, axis: usize) -> bool {
    let mut faces = model.mesh.side_sets[set].iter().map(|side| face_nodes(&model.mesh, side));
    faces.all(|face| axis < D && model.face_normal(&face)[axis].abs() > ACROSS)
}

/// Component of a unit normal along an axis above which a face counts as normal to it: within 25 degrees.
const ACROSS: f64 = 0.9;
