//! Conditions of the stages, converted to fixed degrees of freedom and loading channels.

pub(crate) mod courses;
mod jumps;
mod shared;
pub mod sizes;
mod stiff;

use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::check::pressing;
use crate::reading::scene::model::{Condition, Loading, Material, Motion, Pace, Scene, Spanned};
use crate::shared::entry::Entry;
use crate::shared::initial_stress;
use crate::shared::model::{self, Model, bounds, sets};
use asperity_fem::block::LinearBlock;
use asperity_fem::dof::Channel;
use asperity_fem::kinematics::Formulation;
use asperity_fem::surface;
use asperity_fem::table::Table;
use asperity_mechanics::{self as mechanics, RotatedSet, Rotation};
pub use asperity_mechanics::{Spring, Stage};
use jumps::StageStart;
use shared::PrescriptionHistory;
use std::collections::BTreeMap;
use std::ops::Range;

/// Resolves the conditions of the stages of a scene.
///
/// # Errors
/// [`Diagnostic`] at the condition that cannot be applied.
pub fn stages<const D: usize>(scene: &Scene, model: &Model<D>) -> Result<Vec<Stage>, Diagnostic> {
    // In scenes with faults, initial stress and weight only determine the initial tractions of the faults.
    let (body_loads, weight) = if scene.faults.is_empty() {
        (body_loads(scene, model)?, Vec::new())
    } else {
        (Vec::new(), weights(scene, model)?.concat())
    };
    let mut held: BTreeMap<(String, usize), Motion> = BTreeMap::new();
    let mut loads: BTreeMap<(String, usize), Loading> = BTreeMap::new();
    let mut shared = PrescriptionHistory::default();
    let mut start = 0.0;
    let mut stages = Vec::new();
    let pressing = pressing::stage(scene).map(|stage| &stage.name);
    for spec in &scene.stages {
        let presses = pressing == Some(&spec.name);
        let end = start + spec.duration.get_ref().0;
        settle(&mut held, &mut loads);
        let mut present: BTreeMap<(String, usize), f64> = BTreeMap::new();
        for (key, loading) in &loads {
            present.insert(key.clone(), end_value(loading));
        }
        let before = held.clone();
        for condition in &spec.conditions {
            take_up(model, condition, (&mut held, &mut shared), &mut loads)?;
            stiff::refuse(model, condition)?;
        }
        if !presses {
            let before = StageStart { held: &before, present: &present };
            jumps::refuse(scene, spec, before, &loads)?;
        }
        shared.stage(model, spec, &held)?;
        let (springs, motions) = apart(motions::<D>(model, &held));
        let mut fixed: Vec<usize> = motions.iter().flat_map(|(dofs, _)| dofs.iter().copied()).collect();
        fixed.sort_unstable();
        let mut channels: Vec<_> = body_loads.iter().map(|channel| (None, channel.clone())).collect();
        for (key, loading) in &loads {
            let from = present.get(key).copied().unwrap_or(0.0);
            let channel = load_channel(model, key, loading, (from, start, end));
            channels.push((Some(key.0.clone()), channel));
        }
        stages.push(Stage {
            name: spec.name.clone(),
            start,
            end,
            steps: spec.steps.as_ref().map(|s| *s.get_ref()),
            frictionless: spec.frictionless.iter().map(|s| s.get_ref().clone()).collect(),
            turning: turning(model, &motions),
            motions: motions.into_iter().filter_map(|(dofs, motion)| Some((dofs, moved(motion)?))).collect(),
            loads: channels,
            fixed,
            springs,
            weight: weight.clone(),
        });
        // The time of faults counts from the start of the stage in which they slide.
        start = if presses { 0.0 } else { end };
    }
    Ok(stages)
}

/// Carries the conditions of a stage over to the next one: targets that were reached are held.
fn settle(held: &mut BTreeMap<(String, usize), Motion>, loads: &mut BTreeMap<(String, usize), Loading>) {
    for motion in held.values_mut() {
        *motion = motion.clone().carried_on();
    }
    for loading in loads.values_mut() {
        *loading = Loading::Fixed(end_value(loading));
    }
}

fn end_value(loading: &Loading) -> f64 {
    match loading {
        Loading::Fixed(value) | Loading::To(value) => *value,
        Loading::Table(points) => points.last().map_or(0.0, |p| p.1),
    }
}

/// Names of the axes.
const AXES: [&str; 3] = ["x", "y", "z"];

/// Axis number of pressures in the table of loads; no displacement has this axis.
const PRESSURE: usize = 3;

fn take_up<const D: usize>(
    model: &Model<D>,
    condition: &Spanned<Condition>,
    (held, shared): (&mut BTreeMap<(String, usize), Motion>, &mut PrescriptionHistory),
    loads: &mut BTreeMap<(String, usize), Loading>,
) -> Result<(), Diagnostic> {
    let c = condition.get_ref();
    let set = c.set.as_ref().ok_or_else(|| {
        Diagnostic::at(condition.span(), "the condition names no set", "add `set = \"body.side\"`")
    })?;
    if c.traction.is_some() || c.pressure.is_some() || c.absorbing.as_ref().is_some_and(|a| *a.get_ref()) {
        model::sides(model, set)?;
    } else {
        model::nodes(model, set)?;
    }
    for (axis, motion) in [&c.x, &c.y, &c.z].into_iter().enumerate() {
        if let Some(motion) = motion {
            held.insert((set.get_ref().clone(), axis), motion.get_ref().clone());
            shared.places.insert((set.get_ref().clone(), axis), motion.span());
        }
    }
    if let Some(rotate) = &c.rotate {
        for axis in 0..D {
            held.insert((set.get_ref().clone(), axis), rotate.get_ref().motion());
            shared.places.insert((set.get_ref().clone(), axis), rotate.span());
        }
    }
    if let Some(symmetry) = c.symmetry.as_ref().filter(|s| *s.get_ref()) {
        let axis = normal_axis(model, set)?;
        shared.places.insert((set.get_ref().clone(), axis), symmetry.span());
        held.insert((set.get_ref().clone(), axis), Motion::Fixed(0.0));
    }
    for ((set, axis), place) in shared.places.iter().filter(|(key, _)| key.0 == *set.get_ref()) {
        if model.idealisation.component(*axis).is_none() {
            return Err(Diagnostic::at(
                place.clone(),
                format!("bodies do not move along {} in {}", AXES[*axis], model.idealisation.name()),
                format!("leave this condition on `{set}` out"),
            ));
        }
    }
    if let Some(traction) = &c.traction {
        let components = traction.get_ref().len();
        model.idealisation.check_components(components).map_err(|e| {
            Diagnostic::at(traction.span(), e.to_string(), "one entry for each component of the displacement")
        })?;
        for (component, loading) in traction.get_ref().iter().enumerate() {
            let axis = model.idealisation.axis(component);
            loads.insert((set.get_ref().clone(), axis), loading.clone());
        }
    }
    if let Some(pressure) = &c.pressure {
        if model.idealisation.components() != D {
            return Err(Diagnostic::at(
                pressure.span(),
                format!("a pressure does nothing in {}", model.idealisation.name()),
                "use a `traction`",
            ));
        }
        loads.insert((set.get_ref().clone(), PRESSURE), pressure.get_ref().clone());
    }
    Ok(())
}

/// Axis along which all nodes of a set have the same coordinate.
fn normal_axis<const D: usize>(model: &Model<D>, set: &Spanned<String>) -> Result<usize, Diagnostic> {
    let nodes = model::nodes(model, set)?;
    let points: Vec<[f64; D]> = nodes.iter().map(|&n| model.mesh.nodes[n]).collect();
    let (min, max) = bounds(&points);
    /// Tolerance for the coordinates of a generated plane face, relative to the size of the scene: rounding.
    const FLAT: f64 = 1e-12;
    (0..D).find(|&c| max[c] - min[c] <= FLAT * model.scale).ok_or_else(|| {
        Diagnostic::at(
            set.span(),
            format!("`{}` is not a plane parallel to an axis", set.get_ref()),
            "prescribe displacement components instead of symmetry",
        )
    })
}

/// Degrees of freedom of each prescribed component. One that belongs to two sets is assigned to the first; earlier checks ensure that both prescribe
/// the same motion.
fn motions<'a, const D: usize>(
    model: &Model<D>,
    held: &'a BTreeMap<(String, usize), Motion>,
) -> Vec<(&'a (String, usize), Vec<usize>, Motion)> {
    let mut taken = vec![false; model.dofs()];
    let mut result = Vec::new();
    for (key, motion) in held.iter().filter(|(_, m)| **m != Motion::Free) {
        let mut dofs = Vec::new();
        for node in sets::find_nodes(model, &key.0).unwrap_or_default() {
            let dof = model.dof(node, key.1);
            if !taken[dof] {
                taken[dof] = true;
                dofs.push(dof);
            }
        }
        result.push((key, dofs, motion.clone()));
    }
    result
}

/// Degrees of freedom that have a motion.
type MovedDofs = (Vec<usize>, Motion);

/// Springs, and motions without springs. A spring of which another set has all nodes pulls nothing.
fn apart(all: Vec<(&(String, usize), Vec<usize>, Motion)>) -> (Vec<Spring>, Vec<MovedDofs>) {
    let (mut springs, mut motions) = (Vec::new(), Vec::new());
    for ((set, axis), dofs, motion) in all {
        match motion {
            Motion::Spring { stiffness, rate } if !dofs.is_empty() => {
                let rate = paced(&rate);
                springs.push(Spring { set: set.clone(), axis: *axis, dofs, stiffness, rate });
            }
            Motion::Spring { .. } => {}
            motion => motions.push((dofs, motion)),
        }
    }
    (springs, motions)
}

fn paced(pace: &Pace) -> mechanics::Pace {
    match pace {
        Pace::Steady(rate) => mechanics::Pace::Steady(*rate),
        Pace::Table(points) => mechanics::Pace::Table(points.to_vec()),
    }
}

/// Motion within a stage; `None` for components that are free or loaded by springs.
fn moved(motion: Motion) -> Option<mechanics::Motion> {
    Some(match motion {
        Motion::Fixed(value) => mechanics::Motion::Fixed(value),
        Motion::To(value) => mechanics::Motion::To(value),
        Motion::Rate(rate) => mechanics::Motion::Rate(paced(&rate)),
        Motion::Table(points) => mechanics::Motion::Table(points.to_vec()),
        // The displacement that a rotation adds to its start is given by [`RotatedSet`].
        Motion::Hold | Motion::Rotate(_) => mechanics::Motion::Hold,
        Motion::Free | Motion::Spring { .. } => return None,
    })
}

/// Rotating components, with the positions of their nodes.
fn turning<const D: usize>(model: &Model<D>, motions: &[(Vec<usize>, Motion)]) -> Vec<RotatedSet> {
    let components = model.idealisation.components();
    let place = |dof: &usize| {
        let x = &model.mesh.nodes[dof / components];
        std::array::from_fn(|c| x.get(c).copied().unwrap_or(0.0))
    };
    let turned = |(dofs, motion): &(Vec<usize>, Motion)| match motion {
        Motion::Rotate(rotation) => Some(RotatedSet {
            places: dofs.iter().map(place).collect(),
            dofs: dofs.clone(),
            components,
            rotation: Rotation { angle: rotation.angle, about: rotation.about, axis: rotation.axis },
        }),
        _ => None,
    };
    motions.iter().filter_map(turned).collect()
}

fn load_channel<const D: usize>(
    model: &Model<D>,
    (set, axis): &(String, usize),
    loading: &Loading,
    (from, start, end): (f64, f64, f64),
) -> Channel {
    let sides = &model.mesh.side_sets[set];
    // Unit force per area; the length of the normal is the area element of the point.
    let component = model.idealisation.component(*axis);
    let forces = surface::integrate(&model.mesh, sides, model.idealisation, |point, value| match component {
        Some(component) => value[component] = surface::length(&point.normal),
        None => value.iter_mut().zip(&point.normal).for_each(|(v, n)| *v = -n),
    });
    let amplitude = match loading {
        Loading::Fixed(value) => Table::constant(*value),
        Loading::To(value) => Table::new(vec![start, end], vec![from, *value]),
        Loading::Table(points) => {
            Table::new(points.iter().map(|p| start + p.0).collect(), points.iter().map(|p| p.1).collect())
        }
    };
    Channel { prescribed: Vec::new(), forces, amplitude }
}

/// Channels of body forces and initial stresses, which act from the start.
fn body_loads<const D: usize>(scene: &Scene, model: &Model<D>) -> Result<Vec<Channel>, Diagnostic> {
    let mut channels: Vec<Channel> = weights(scene, model)?.into_iter().map(|w| steady(w, 1.0)).collect();
    for body in &model.bodies {
        let stress = initial_stress::body_field(scene, &body.name);
        for block in body.blocks.clone() {
            if let (Some(stress), Some(linear)) = (&stress, model.blocks[block].linear()) {
                channels.push(steady(linear.initial_stress_field(|x| stress.at(x)), -1.0));
            }
        }
    }
    Ok(channels)
}

/// Nodal forces due to the weight of each block of cells that has a weight.
fn weights<const D: usize>(scene: &Scene, model: &Model<D>) -> Result<Vec<Vec<(usize, f64)>>, Diagnostic> {
    let mut all = Vec::new();
    for body in &model.bodies {
        let spec = &scene.bodies[&body.name];
        let Some(gravity) = &spec.gravity else { continue };
        for (k, block) in body.blocks.clone().enumerate() {
            let (name, material) = model::material(&model.mesh, scene, Entry::new(&body.name, spec), block)?;
            let density = density_of(name, material, gravity.span())?;
            let force: Vec<f64> = gravity.get_ref().iter().map(|g| density * g).collect();
            // Weight does not depend on stiffness; for nonlinear blocks it is computed with a linear one.
            let weight = |b: &LinearBlock<D>| b.body_force(&model.mesh, &force);
            let forces = match model.blocks[block].linear() {
                Some(linear) => weight(linear),
                None => {
                    let (space, standard) = (model.idealisation, Formulation::Standard);
                    LinearBlock::new(&model.mesh, block, &body.elastic[k], space, standard)
                        .and_then(|b| weight(&b))
                }
            };
            all.push(forces.map_err(|e| Diagnostic::body(&body.name, gravity.span(), e.to_string()))?);
        }
    }
    Ok(all)
}

fn density_of(name: &str, material: &Material, place: Range<usize>) -> Result<f64, Diagnostic> {
    material.density.as_ref().map(|d| d.get_ref().0).ok_or_else(|| {
        Diagnostic::at(
            place,
            format!("material `{name}` has no density"),
            "gravity acts on a mass: add `density = \"2700 kg/m^3\"`",
        )
    })
}

fn steady(forces: Vec<(usize, f64)>, factor: f64) -> Channel {
    let forces = forces.into_iter().map(|(dof, f)| (dof, factor * f)).collect();
    Channel { prescribed: Vec::new(), forces, amplitude: Table::constant(1.0) }
}
