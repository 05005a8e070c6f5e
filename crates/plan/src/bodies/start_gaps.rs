//! Initial gaps, overlaps and facing area of the sides of the interfaces, measured as the contact measures them.

use super::assembly::Assembly;
use super::{PlannedInterface, SHARE, StartGap};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::Interface as Spec;
use crate::shared::entry::Entry;
use asperity_contact::{Enforcement, Interface, PointFields};
use asperity_fem::mesh::{MeshFace, Side};
use asperity_fem::surface;
use asperity_mechanics::{Model, Stage, bounds, contact_spec};
use asperity_run::Warning;
use asperity_scene::lengths::brief;
use std::collections::BTreeMap;

/// Rounding error of a gap over the size of the scene; contact treats smaller gaps as closed without traction.
const ROUNDING: f64 = 1e-12;

/// Distance by which two sides can approach, over the prescribed motion. Both sides may move, and a squeezed body bulges by less than it is squeezed.
const REACH: f64 = 3.0;

/// Initial gaps of an interface, with those of its points that face the master.
pub struct MeasuredGaps {
    pub start: StartGap,
    pub facing: Vec<FacingPoint>,
}

/// A point that faces the master.
pub struct FacingPoint {
    /// Number of the slave point.
    pub point: usize,
    /// Gap \[m\].
    pub gap: f64,
    pub area: f64,
}

/// An interface before the first step.
#[derive(Clone, Copy)]
pub struct StartContact<'a> {
    pub spec: &'a Spec,
    pub planned: &'a PlannedInterface,
    pub start: &'a StartGap,
    /// Size of the slave cells \[m\].
    pub size: f64,
}

impl StartContact<'_> {
    /// True if a bonded law keeps gaps as they are.
    pub fn is_bonded(&self) -> bool {
        self.planned.law.as_ref().is_some_and(|law| law.bonded())
    }
}

/// Measures the initial gaps of an interface.
///
/// # Errors
/// [`Diagnostic`] at the slave if the sides can never touch, or are the wrong ones.
pub fn measure<const D: usize>(
    assembly: &Assembly<'_, D>,
    planned: &PlannedInterface,
    slave: &[Side],
) -> Result<MeasuredGaps, Diagnostic> {
    let Assembly { model, stepping, .. } = assembly;
    let Entry { spec, .. } = assembly.entry(planned);
    let number: Vec<usize> = (0..model.dofs()).collect();
    let mut declared = contact_spec::spec(model, stepping, planned, &number, 0.0, 0);
    // Positions of the sides depend neither on the law nor on the enforcement.
    (declared.enforcement, declared.law) = (Enforcement::Penalty, None);
    let mut built = Interface::new(declared).map_err(|e| {
        Diagnostic::at(
            spec.slave.span(),
            e.to_string(),
            "slave and master are sides that look at each other: are they the right ones, in the right unit of length?",
        )
    })?;
    if let Some(by) = &planned.shift {
        built.shift(by);
    }
    let points = built.points();
    let normals = slave_normals(model, planned);
    let rounding = ROUNDING * model.scale;
    let mut start = StartGap {
        interface: planned.name.clone(),
        points: planned.slave.len(),
        unpaired: built.unpaired(),
        gap: [f64::INFINITY, f64::NEG_INFINITY],
        slave_area: surface::areas(&model.mesh, slave, model.idealisation).values().sum(),
        area_unit: if model.idealisation.weight(&[0.0; D]) == 1.0 && D == 2 { "m" } else { "m^2" },
        adjusted: planned.shift.iter().flatten().filter(|by| by.abs() > rounding).count(),
        adjustment: planned.shift.iter().flatten().fold(0.0, |most: f64, by| most.max(by.abs())),
        ..StartGap::default()
    };
    let mut facing = Vec::new();
    for (p, (node, _)) in planned.slave.iter().enumerate() {
        if points.gap[p].is_finite() && looks_at(&normals[node], points, p) {
            start.facing += 1;
            facing.push(FacingPoint { point: p, gap: points.gap[p], area: points.area[p] });
            start.gap = [start.gap[0].min(points.gap[p]), start.gap[1].max(points.gap[p])];
            start.facing_area += points.area[p];
        }
    }
    start.gap = start.gap.map(|g| if start.facing == 0 || g.abs() <= rounding { 0.0 } else { g });
    refuse(model, planned, spec, &start, points).map_or(Ok(MeasuredGaps { start, facing }), Err)
}

/// True if the slave side at a point and the master face each other.
fn looks_at<const D: usize>(slave: &[f64; D], points: &PointFields<D>, p: usize) -> bool {
    slave.iter().zip(&points.normal[p]).map(|(a, b)| a * b).sum::<f64>() < 0.0
}

/// Sums of the outward normals of the slave faces at their nodes.
pub fn slave_normals<const D: usize>(
    model: &Model<D>,
    planned: &PlannedInterface,
) -> BTreeMap<usize, [f64; D]> {
    let mut normals: BTreeMap<usize, [f64; D]> = BTreeMap::new();
    for MeshFace { nodes: face, .. } in &planned.slave_faces {
        let normal = model.face_normal(face);
        for &node in face {
            normals.entry(node).or_insert([0.0; D]).iter_mut().zip(&normal).for_each(|(s, n)| *s += n);
        }
    }
    normals
}

/// Error for sides that are certainly wrong.
fn refuse<const D: usize>(
    model: &Model<D>,
    planned: &PlannedInterface,
    spec: &Spec,
    start: &StartGap,
    points: &PointFields<D>,
) -> Option<Diagnostic> {
    let (slave, master) = (spec.slave.get_ref(), &spec.master);
    if start.facing == 0 {
        return Some(Diagnostic::at(
            spec.slave.span(),
            format!(
                "`{slave}` and {master} of interface `{}` do not face each other: both look the same way",
                planned.name
            ),
            "choose the side of each body that looks at the other",
        ));
    }
    // Bodies that enclose each other, such as a ring around a shaft, do not overlap by more than the thickness of
    // either.
    let deepest = -start.gap[1];
    let p = (0..points.gap.len()).find(|&p| points.gap[p].is_finite())?;
    let bodies = spec.sides().filter_map(|set| model.body_of(set.get_ref()));
    let (name, thick) = bodies
        .map(|b| (&model.bodies[b].name, thickness(model, b, &points.normal[p])))
        .min_by(|a, b| a.1.total_cmp(&b.1))?;
    (deepest >= thick * (1.0 - SHARE)).then(|| {
        Diagnostic::at(
            spec.slave.span(),
            format!(
                "`{slave}` and {master} of interface `{}` overlap by {} everywhere, and body `{name}` is {} thick",
                planned.name,
                brief(deepest),
                brief(thick)
            ),
            "these are the far sides of the two bodies: choose the near ones, or put the bodies beside each other",
        )
    })
}

/// Extent of the bounding box of a body along a direction \[m\].
pub(super) fn thickness<const D: usize>(model: &Model<D>, body: usize, n: &[f64; D]) -> f64 {
    let (min, max) = bounds(&model.mesh.nodes[model.bodies[body].nodes.clone()]);
    (0..D).map(|c| n[c].abs() * (max[c] - min[c])).sum()
}

/// Warning about the initial gaps of an interface; a bonded one keeps its gaps. Bodies that `fly` with inertia may close any gap.
pub fn doubts(contact: &StartContact<'_>, stages: &[Stage], fly: bool) -> Option<Warning> {
    let StartContact { spec, start, size: h, .. } = *contact;
    let [least, largest] = start.gap;
    let name = &start.interface;
    if contact.is_bonded() {
        let (farthest, what) = if -least > largest { (-least, "an overlap") } else { (largest, "a gap") };
        return (farthest > SHARE * h).then(|| {
            let message = format!("interface `{name}` is tied across {what} of up to {}", brief(farthest));
            let help = "tied points stay as far apart as they start: put the bodies beside each other";
            Warning::at(spec.slave.span(), message, help)
        });
    }
    if least < -SHARE * h {
        let message = format!(
            "the bodies at interface `{name}` overlap by up to {} at the start, {:.2} of the element size {}, and contact presses them apart \
             in the first step",
            brief(-least),
            -least / h,
            brief(h)
        );
        let help = "move a body so that they touch, unless a press fit is meant";
        return Some(Warning::at(spec.slave.span(), message, help));
    }
    let reach = REACH * stages.iter().map(Stage::travel).sum::<f64>();
    if !fly && least > SHARE * h && least > reach && !stages.iter().any(Stage::is_loaded) {
        let message = format!(
            "interface `{name}` starts open by {} or more, and no condition moves a body by more than {}: it cannot close",
            brief(least),
            brief(reach / REACH)
        );
        let help = "put the bodies beside each other, or prescribe a motion that closes the gap; is the unit of length right?";
        return Some(Warning::at(spec.slave.span(), message, help));
    }
    None
}
