//! Normal traction that overlaps at the start cause without any load.
//!
//! Facets of two meshes of one curve do not lie on each other: where a node of one side is inside the other, contact presses. The
//! traction is estimated from two compliances. Overlap beside the mean is taken up by the penalty and by a row of cells,
//! `1/E_n + h/E`. What all points have in common, s, is taken up by the bodies, `s = p̄ H/E`: H is the sum over both bodies of
//! their thickness, or of half the extent of the interface where that is less, as below a strip under pressure. With
//! `p = max(-g - s, 0)/(1/E_n + h/E)` and p̄ its mean over the area, s follows by bisection. A uniform overlap g of held blocks
//! gives `E g/H`, as it should.

use super::penalty::SofterCells;
use super::start_gaps::{MeasuredGaps, StartContact, thickness};
use super::{PlannedInterface, SHARE};
use crate::reading::scene::model::{Interface as Spec, Measure};
use crate::shared::loading::Stage;
use crate::shared::model::Model;
use asperity_fem::mesh::MeshFace;
use asperity_mechanics::{PlannedEnforcement, bounds};
use asperity_run::Warning;
use asperity_scene::lengths::brief;

/// Strain whose stress is large beside those that contact of elastic bodies is computed for: 5 MPa in rock, 20 MPa in steel.
const LARGE: f64 = 1e-4;
/// Share of the normal traction of the loads above which that of overlaps changes the result.
const NOTED: f64 = 0.1;
/// Halvings of the common relief, down to the spacing of numbers.
const HALVINGS: usize = 60;

/// Estimate of the largest normal traction without load \[Pa\].
pub fn traction<const D: usize>(
    model: &Model<D>,
    measured: &MeasuredGaps,
    planned: &PlannedInterface,
    softer: &SofterCells,
) -> f64 {
    let (most, points) = (-measured.start.gap[0], &measured.facing);
    if most <= 0.0 {
        return 0.0;
    }
    let young = softer.young_per_size * softer.size;
    let exact = matches!(planned.enforced, PlannedEnforcement::AugmentedLagrangian { .. });
    let local = softer.young_per_size.recip() + if exact { 0.0 } else { planned.normal_penalty.recip() };
    let common = depth(model, planned) / young;
    let area: f64 = points.iter().map(|p| p.area).sum();
    let mean = |s: f64| points.iter().map(|p| (-p.gap - s).max(0.0) / local * p.area).sum::<f64>() / area;
    let (mut low, mut high) = (0.0, most);
    for _ in 0..HALVINGS {
        let s = 0.5 * (low + high);
        if mean(s) * common > s { low = s } else { high = s }
    }
    (most - low) / local
}

/// H of the module \[m\].
fn depth<const D: usize>(model: &Model<D>, planned: &PlannedInterface) -> f64 {
    let nodes: Vec<[f64; D]> = planned.slave.iter().map(|(n, _)| model.mesh.nodes[*n]).collect();
    let (min, max) = bounds(&nodes);
    let half = 0.5 * (0..D).map(|c| max[c] - min[c]).fold(0.0, f64::max);
    let of = |faces: &Vec<MeshFace>| {
        let face = faces.first()?;
        let body = model.bodies.iter().position(|b| b.nodes.contains(&face.nodes[0]))?;
        let normal = model.face_normal(&face.nodes);
        Some(thickness(model, body, &std::array::from_fn(|c| normal[c])).min(half))
    };
    [&planned.slave_faces, &planned.master_faces].into_iter().filter_map(of).sum()
}

/// Warning about overlaps that press more than the scene may mean; `load` is the normal traction of the loads, if it is known \[Pa\].
pub fn doubt(
    contact: &StartContact<'_>,
    softer: &SofterCells,
    stages: &[Stage],
    load: Option<f64>,
) -> Option<Warning> {
    let StartContact { spec, planned, start, size } = *contact;
    let [least, largest] = start.gap;
    // A larger overlap is warned of as one of the bodies.
    if least >= 0.0 || contact.is_bonded() || least < -SHARE * size {
        return None;
    }
    let young = softer.young_per_size * softer.size;
    // An overlap that is the same everywhere may be how the bodies are pressed.
    let uneven = largest - least > NOTED * -least;
    let travel: f64 = stages.iter().map(Stage::travel).sum();
    let beside = match load {
        Some(load) if uneven && start.overlap_traction > NOTED * load => {
            format!("; the loads press it with {load:.3e} Pa")
        }
        None if uneven && travel > 0.0 && -least > NOTED * travel => {
            format!("; the conditions move bodies by {} in all", brief(travel))
        }
        _ if start.overlap_traction > LARGE * young => String::new(),
        _ => return None,
    };
    let message = format!(
        "the sides of interface `{}` overlap by up to {} at the start, which presses them with up to about {:.3e} Pa, {:.1e} of \
         Young's modulus, before any load{beside}",
        start.interface,
        brief(-least),
        start.overlap_traction,
        start.overlap_traction / young
    );
    Some(Warning::at(spec.slave.span(), message, help(spec, planned)))
}

/// Remedies of overlaps of facets.
fn help(spec: &Spec, planned: &PlannedInterface) -> String {
    let flat = planned.master_faces.iter().all(|f| f.kind.first_order());
    let smooth = match (flat && spec.smoothing.is_none(), spec.measure.get_ref()) {
        (false, _) => "",
        (true, Measure::NodeToPoint) => "`smoothing = \"cubic\"` rounds the facets of the master; ",
        (true, Measure::Mortar) => {
            "`measure = \"node-to-point\"` with `smoothing = \"cubic\"` rounds the facets of the master; "
        }
    };
    format!(
        "{smooth}finer facets overlap by less, in proportion to h^2; move the bodies apart by the overlap, unless a press fit is meant"
    )
}
