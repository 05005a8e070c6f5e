//! Loads on sets that share faces, which add up there.

use crate::reading::scene::model::{Condition, Scene, Spanned};
use crate::shared::model::Model;
use asperity_fem::mesh::Side;
use asperity_run::Warning;
use std::collections::BTreeSet;
use std::ops::Range;

/// A load of one kind on a set.
struct Load<'a> {
    kind: &'static str,
    set: &'a Spanned<String>,
    place: Range<usize>,
}

/// Loads of a condition.
fn loads(condition: &Condition) -> Vec<Load<'_>> {
    let Some(set) = &condition.set else { return Vec::new() };
    let pressure = condition.pressure.as_ref().map(|p| ("pressure", p.span()));
    let traction = condition.traction.as_ref().map(|t| ("traction", t.span()));
    pressure.into_iter().chain(traction).map(|(kind, place)| Load { kind, set, place }).collect()
}

/// Warnings about loads of one kind in a stage on sets of other names that share faces.
pub(crate) fn doubts<const D: usize>(scene: &Scene, model: &Model<D>) -> Vec<Warning> {
    let faces = |load: &Load<'_>| -> BTreeSet<Side> {
        model.mesh.side_sets.get(load.set.get_ref()).into_iter().flatten().copied().collect()
    };
    let mut all = Vec::new();
    for stage in &scene.stages {
        let loads: Vec<Load<'_>> = stage.conditions.iter().flat_map(|c| loads(c.get_ref())).collect();
        for (k, load) in loads.iter().enumerate() {
            for other in &loads[..k] {
                if load.kind != other.kind || load.set.get_ref() == other.set.get_ref() {
                    continue;
                }
                let common = faces(load).intersection(&faces(other)).count();
                if common > 0 {
                    all.push(doubt(load, other, common, &stage.name));
                }
            }
        }
    }
    all
}

fn doubt(load: &Load<'_>, other: &Load<'_>, common: usize, stage: &str) -> Warning {
    Warning::at(
        load.place.clone(),
        format!(
            "`{}` and `{}` have faces in common ({common}), where the {} of both adds up in stage `{stage}`",
            other.set.get_ref(),
            load.set.get_ref(),
            load.kind
        ),
        "load each face once, unless both are meant",
    )
}
