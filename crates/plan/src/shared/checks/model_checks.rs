//! Checks of bodies and of the sets that a scene uses.

use super::{BodyCheck, Checks, SetCheck};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Condition, Motion, Scene, Spanned};
use crate::shared::model::forecast::Counts;
use crate::shared::model::{Model, bounds, counts, nodes};
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::Idealisation;
use asperity_fem::mesh::{Side, face_nodes};
use asperity_fem::surface;
use asperity_mechanics::{Body, Stage};
use std::collections::{BTreeMap, BTreeSet};

/// Checks of the bodies of a model and of the sets that conditions, interfaces, faults and outputs use.
///
/// # Errors
/// [`Diagnostic`] at a set without faces, at faces inside bodies or on an axis of revolution, and at an axis that is moved.
pub(crate) fn checks<const D: usize>(scene: &Scene, model: &Model<D>) -> Result<Checks, Diagnostic> {
    let in_space = D == 3 || model.idealisation == Idealisation::Axisymmetric;
    axis(scene, model)?;
    let bodies = model.bodies.iter().map(|body| body_check(model, body)).collect();
    Ok(Checks { in_space, bodies, sets: sets(scene, model)?, ..Checks::default() })
}

fn body_check<const D: usize>(model: &Model<D>, body: &Body<D>) -> BodyCheck {
    let (from, to) = bounds(&model.mesh.nodes[body.nodes.clone()]);
    BodyCheck {
        body: body.name.clone(),
        from: from.to_vec(),
        to: to.to_vec(),
        nodes: body.nodes.len(),
        cells: model.mesh.blocks[body.blocks.clone()].iter().map(|b| b.len()).sum(),
        edges: edges(model, body),
    }
}

/// Pairs of corners of a cell that an edge joins.
fn joined(kind: ElementKind) -> BTreeSet<[usize; 2]> {
    let of_face = |corners: &[usize]| -> Vec<[usize; 2]> {
        let next = |k: usize| corners[(k + 1) % corners.len()];
        corners.iter().enumerate().map(|(k, &a)| [a.min(next(k)), a.max(next(k))]).collect()
    };
    kind.faces().iter().flat_map(|face| of_face(&face.nodes[..face.kind.corners()])).collect()
}

/// Shortest and longest edge of the cells of a body, between corners \[m\].
fn edges<const D: usize>(model: &Model<D>, body: &Body<D>) -> [f64; 2] {
    let mut squares = [f64::INFINITY, 0.0_f64];
    for block in &model.mesh.blocks[body.blocks.clone()] {
        let joined = joined(block.kind);
        for cell in 0..block.len() {
            let nodes = block.cell(cell);
            for [a, b] in &joined {
                let (x, y) = (&model.mesh.nodes[nodes[*a]], &model.mesh.nodes[nodes[*b]]);
                let square: f64 = x.iter().zip(y).map(|(x, y)| (x - y).powi(2)).sum();
                squares = [squares[0].min(square), squares[1].max(square)];
            }
        }
    }
    squares.map(f64::sqrt)
}

/// Words for the effects of a condition on its set.
fn does(condition: &Condition) -> Vec<&'static str> {
    let motion = |m: &Spanned<Motion>| match m.get_ref() {
        Motion::Fixed(_) | Motion::Hold => "held",
        Motion::Spring { .. } => "drawn by a spring",
        Motion::To(_) | Motion::Rate(_) | Motion::Table(_) | Motion::Rotate(_) => "moved",
        Motion::Free => "released",
    };
    let loaded = condition.traction.is_some() || condition.pressure.is_some();
    let on = |key: &Option<Spanned<bool>>| key.as_ref().is_some_and(|k| *k.get_ref());
    let moved = [&condition.x, &condition.y, &condition.z].into_iter().flatten().map(motion);
    let rotated = condition.rotate.as_ref().map(|_| "moved");
    let loaded = loaded.then_some("loaded");
    let symmetric = on(&condition.symmetry).then_some("held");
    let absorbing = on(&condition.absorbing).then_some("absorbs waves");
    moved.chain(rotated).chain(loaded).chain(symmetric).chain(absorbing).collect()
}

/// Sets that a scene uses, with their uses in the order of the scene.
pub(crate) fn used(scene: &Scene) -> Vec<(&Spanned<String>, String)> {
    let mut all = Vec::new();
    for (name, interface) in &scene.interfaces {
        let word = format!("interface `{name}`");
        all.extend(interface.sides().map(|set| (set, word.clone())));
    }
    for (name, fault) in scene.faults.iter().filter(|(_, fault)| fault.has_sides()) {
        all.extend([&fault.minus, &fault.plus].map(|set| (set, format!("fault `{name}`"))));
    }
    for condition in scene.stages.iter().flat_map(|s| &s.conditions) {
        let condition = condition.get_ref();
        let Some(set) = &condition.set else { continue };
        all.extend(does(condition).into_iter().map(|word| (set, word.to_string())));
    }
    let forces = scene.output.forces.iter();
    all.extend(forces.map(|(name, force)| (&force.get_ref().set, format!("force `{name}`"))));
    all
}

fn sets<const D: usize>(scene: &Scene, model: &Model<D>) -> Result<Vec<SetCheck>, Diagnostic> {
    let mut found: BTreeMap<&str, SetCheck> = BTreeMap::new();
    for (set, word) in used(scene) {
        let nodes = nodes(model, set)?;
        let faces = model.mesh.side_sets.get(set.get_ref()).map_or(&[][..], Vec::as_slice);
        if nodes.is_empty() {
            return Err(Diagnostic::at(
                set.span(),
                format!("the set `{}` has no face", set.get_ref()),
                "a set is a group of faces of cells: name it where the mesh is made, or take another",
            ));
        }
        if SURFACES.iter().any(|use_of_surface| word.starts_with(use_of_surface)) {
            outside(model, set, faces)?;
        }
        let entry = found.entry(set.get_ref()).or_insert_with(|| SetCheck {
            set: set.get_ref().clone(),
            used: Vec::new(),
            faces: faces.len(),
            nodes: faces.is_empty().then_some(nodes.len()),
            area: surface::areas(&model.mesh, faces, model.idealisation).values().sum(),
        });
        if !entry.used.contains(&word) {
            entry.used.push(word);
        }
    }
    Ok(found.into_values().collect())
}

/// Uses of sets as surfaces of bodies, by their first words in [`used`].
const SURFACES: [&str; 4] = ["loaded", "absorbs waves", "interface", "fault"];

/// Checks that faces are on the outside of bodies and have an area.
fn outside<const D: usize>(
    model: &Model<D>,
    set: &Spanned<String>,
    faces: &[Side],
) -> Result<(), Diagnostic> {
    let name = set.get_ref();
    let mut sorted: Vec<Vec<usize>> = faces.iter().map(|side| face_nodes(&model.mesh, side)).collect();
    sorted.iter_mut().for_each(|nodes| nodes.sort_unstable());
    sorted.sort_unstable();
    let inside = sorted.windows(2).filter(|pair| pair[0] == pair[1]).count();
    if inside > 0 {
        return Err(Diagnostic::at(
            set.span(),
            format!(
                "`{name}` lies inside a body: {inside} of its faces have cells on both sides, and each would count twice"
            ),
            "take faces on the outside; `split` divides a body along faces inside it",
        ));
    }
    let on_axis = |nodes: &Vec<usize>| nodes.iter().all(|&node| model.mesh.nodes[node][0] == 0.0);
    if model.idealisation == Idealisation::Axisymmetric && sorted.iter().all(on_axis) && !faces.is_empty() {
        return Err(Diagnostic::at(
            set.span(),
            format!("`{name}` lies on the axis of revolution, where faces have no area"),
            "take faces away from the axis: the material itself holds what lies on it",
        ));
    }
    Ok(())
}

/// Checks that no condition moves the axis of revolution away from itself.
fn axis<const D: usize>(scene: &Scene, model: &Model<D>) -> Result<(), Diagnostic> {
    if model.idealisation != Idealisation::Axisymmetric {
        return Ok(());
    }
    for condition in scene.stages.iter().flat_map(|stage| &stage.conditions).map(Spanned::get_ref) {
        let (Some(set), Some(x)) = (&condition.set, &condition.x) else { continue };
        let stays = match x.get_ref() {
            Motion::Fixed(value) | Motion::To(value) => *value == 0.0,
            Motion::Hold | Motion::Free => true,
            Motion::Rate(_) | Motion::Table(_) | Motion::Spring { .. } | Motion::Rotate(_) => false,
        };
        if !stays && nodes(model, set)?.iter().any(|&node| model.mesh.nodes[node][0] == 0.0) {
            return Err(Diagnostic::at(
                x.span(),
                format!(
                    "`{}` has nodes on the axis of revolution, which cannot leave it: x is the radius",
                    set.get_ref()
                ),
                "`x = 0` there, or a set without the axis",
            ));
        }
    }
    Ok(())
}

/// Size of a number in memory \[bytes\].
const NUMBER: usize = 8;

/// Size of a field with so many values at each node and in each cell, with its mesh \[bytes\].
pub(crate) fn field_bytes<const D: usize>(model: &Model<D>, [nodal, cellwise]: [usize; 2]) -> usize {
    let numbers = |c: &Counts| c.cells as usize * (c.kind.nodes() + cellwise);
    let cells: usize = counts(&model.mesh).iter().map(numbers).sum();
    NUMBER * (model.mesh.nodes.len() * (3 + nodal) + cells)
}

/// A surface that springs may drive.
pub(crate) struct DrivenSurface {
    /// Bodies on each of its two sides.
    pub bodies: [Vec<String>; 2],
    /// Mean unit normal; zero where all axes of motion lie in the surface.
    pub normal: [f64; 3],
    /// Area \[m²; m per metre of thickness\].
    pub area: f64,
    /// True if friction acts on it.
    pub rubs: bool,
}

/// Stiffness of the springs of a stage over the area of the surfaces that they drive, for each surface \[Pa/m\]. A spring drives the surfaces with friction
/// of its body together, if it pulls along them rather than across. Springs on both sides act one behind the other.
pub(crate) fn machines(stage: &Stage, surfaces: &[DrivenSurface]) -> Vec<Option<f64>> {
    let of_side = |bodies: &[String], normal: &[f64; 3]| {
        let along = |axis: usize| normal[axis].powi(2) < 0.5;
        let own = |set: &str| set.split('.').next().is_some_and(|body| bodies.iter().any(|b| b == body));
        let springs = stage.springs.iter().filter(|s| own(&s.set) && along(s.axis));
        let stiffness: f64 = springs.map(|s| s.stiffness).sum();
        let driven =
            surfaces.iter().filter(|s| s.rubs && s.bodies.iter().flatten().any(|b| bodies.contains(b)));
        let area: f64 = driven.map(|s| s.area).sum();
        (stiffness > 0.0 && area > 0.0).then(|| stiffness / area)
    };
    let of = |surface: &DrivenSurface| {
        let [a, b] = &surface.bodies;
        let both = [Some(a), Some(b).filter(|b| *b != a)].into_iter().flatten();
        let compliances: Vec<f64> =
            both.filter_map(|bodies| of_side(bodies, &surface.normal)).map(f64::recip).collect();
        (!compliances.is_empty()).then(|| compliances.iter().sum::<f64>().recip())
    };
    surfaces.iter().map(|surface| of(surface).filter(|_| surface.rubs)).collect()
}

/// Name of the body of a set.
pub(crate) fn body_name(set: &Spanned<String>) -> String {
    set.get_ref().split('.').next().unwrap_or_default().to_string()
}
