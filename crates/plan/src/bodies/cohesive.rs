//! Resolution of the cohesive zone by the points of an interface, with an error or a warning if statics shows that it
//! is too coarse.

use super::PlannedInterface;
use super::friction::Friction;
use super::surfaces::{BodySurface, FacingSurfaces};
use crate::doubts;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Interface, Scene, Spanned, UnderResolution};
use crate::shared::cohesive::enough;
use crate::shared::entry::Entry;
use crate::shared::model::{Body, Model};
use crate::shared::resolution::{FEW, Ground, TOO_FEW, modulus, spacings};
use asperity_fem::kinematics::Idealisation;
use asperity_fem::mesh::Side;
use asperity_fem::surface;
use asperity_mechanics::{Stage, ZoneResolution};
use asperity_run::Warning;

/// Length of friction that weakens where it is shortest against the distance of points.
#[derive(Clone, Copy)]
pub(super) struct Shortest {
    /// The length, times the normal traction \[Pa m\].
    pub length: f64,
    /// Distance to the farthest neighbour \[m\].
    pub spacing: f64,
    /// Node of the mesh.
    pub node: usize,
}

/// Cohesive zone and nucleation length of an interface with slave points at these nodes, ascending; `None` if its friction does not
/// weaken with slip.
pub(super) fn shortest<const D: usize>(
    model: &Model<D>,
    surfaces: &FacingSurfaces<'_, D>,
    nodes: &[usize],
    friction: Option<&Friction>,
) -> Option<[Shortest; 2]> {
    let friction = friction?;
    let of_side = |surface: &BodySurface<'_, D>| {
        let elastic = surface.body.elastic.first()?;
        Some(modulus(model.idealisation, elastic.shear(), elastic.poisson()))
    };
    // Against the softest master lengths are shortest.
    let masters: Option<Vec<f64>> = surfaces.masters.iter().map(of_side).collect();
    let (a, b) = (of_side(&surfaces.slave)?, masters?.into_iter().reduce(f64::min)?);
    let modulus = 2.0 * a * b / (a + b);
    let of = |law| Ground { law, normal: 1.0, modulus, in_space: D == 3 }.lengths();
    let mut found: Option<[Shortest; 2]> = None;
    for (node, spacing) in spacings(model, surfaces.slave.sides) {
        // The tip of a split surface is no point of the interface, but a neighbour of points.
        let point = nodes.binary_search(&node).ok();
        let law = if friction.is_uniform() { Some(friction.at(0)) } else { point.map(|p| friction.at(p)) };
        let Some(lengths) = law.and_then(of) else { continue };
        let here = lengths.map(|length| Shortest { length, spacing, node });
        found = Some(found.map_or(here, |before| [0, 1].map(|k| before[k].or(here[k]))));
    }
    found
}

impl Shortest {
    /// The one with fewer points, and of equal ones that with the larger distance.
    fn or(self, other: Self) -> Self {
        let order = |s: &Self| (s.spacing / s.length, s.spacing);
        let (own, others) = (order(&self), order(&other));
        if own.0.total_cmp(&others.0).then(own.1.total_cmp(&others.1)).is_gt() { self } else { other }
    }
}

/// Resolution of the cohesive zone of an interface.
pub(super) fn resolved(spec: &Interface, zone: &Shortest) -> Option<ZoneResolution> {
    let law = spec.law.as_ref()?;
    let spacing = zone.spacing;
    let allowed = spec.under_resolved.as_ref().map(|u| *u.get_ref()) == Some(UnderResolution::Allow);
    let one = zone.length / spacing;
    let refused_beyond = (!allowed).then_some(one / TOO_FEW);
    Some(ZoneResolution { one, spacing, refused_beyond, limit: limit(one, spacing), place: law.span() })
}

/// Resolution limit and remedy, printed if a run stops because of it.
fn limit(one: f64, spacing: f64) -> String {
    format!(
        "points {spacing:.4e} m apart resolve it up to {:.4} MPa: take them closer, in proportion, or a longer length of weakening (`l`, `d_c`); `under_resolved = \"allow\"` at the interface runs on",
        one / TOO_FEW / 1e6
    )
}

/// Remedy if the cohesive zone contains less than one point.
fn remedy(resolved: &ZoneResolution, normal: f64) -> String {
    format!("{}; or `under_resolved = \"allow\"` at the interface", enough(resolved, normal))
}

/// Warning if a mean normal traction \[Pa\] that follows from the loads leaves too few points.
///
/// # Errors
/// [`Diagnostic`] if there is less than one point and the scene does not allow it.
pub fn check(resolved: &ZoneResolution, interface: &str, mean: f64) -> Result<Option<Warning>, Diagnostic> {
    let points = resolved.one / mean;
    if mean <= 0.0 || points >= FEW {
        return Ok(None);
    }
    let message = format!(
        "loads press interface `{interface}` with {:.4} MPa on average, where {points:.2} points, {:.4e} m apart, lie on the cohesive zone",
        mean / 1e6,
        resolved.spacing
    );
    if points < TOO_FEW && resolved.refused_beyond.is_some() {
        let message = format!("{message}: each point fails independently, and slip is that of the mesh");
        return Err(Diagnostic::at(resolved.place.clone(), message, remedy(resolved, mean)));
    }
    let message = format!("{message}: fronts of slip follow the mesh");
    Ok(Some(Warning::at(resolved.place.clone(), message, enough(resolved, mean))))
}

/// Warning about an interface that is shorter than the length \[m\] over which slip nucleates on it.
pub fn nucleation<const D: usize>(
    model: &Model<D>,
    planned: &PlannedInterface,
    spec: &Interface,
    length: f64,
) -> Option<Warning> {
    let places: Vec<[f64; D]> = planned.slave.iter().map(|(node, _)| model.mesh.nodes[*node]).collect();
    let (least, most) = crate::shared::model::bounds(&places);
    let extent = least.iter().zip(&most).map(|(a, b)| (b - a).powi(2)).sum::<f64>().sqrt();
    let place = spec.law.as_ref()?.span();
    doubts::nucleation(&format!("interface `{}`", planned.name), place, [length, extent], false)
}

/// Sine of the angle below which a surface counts as flat and two directions count as equal: rounding of coordinates.
const FLAT: f64 = 1e-9;

/// Largest mean normal traction \[Pa\] of an interface in the stages in which its friction acts, if statics alone determines it. For this, loads must
/// press one of its bodies onto a flat side, and nothing else may hold that body along the normal.
pub fn pressed<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    stages: &[Stage],
    Entry { name, spec }: Entry<'_, Interface>,
) -> Option<f64> {
    let touched = |body: &str| {
        let own = |set: &Spanned<String>| set.get_ref().split('.').next() == Some(body);
        scene.interfaces.values().filter(|i| i.sides().any(own)).count()
    };
    let by = |set: &str| {
        let body = &model.bodies[model.body_of(set)?];
        let alone = touched(&body.name) == 1 && body.parts.len() == 1;
        let sides = model.mesh.side_sets.get(set)?;
        if alone { mean(model, stages, name, (body, sides)) } else { None }
    };
    // Several masters share what presses the interface, and each bears a part.
    let mut masters = spec.master.iter();
    let master = masters.next().filter(|_| masters.next().is_none());
    by(spec.slave.get_ref()).or_else(|| by(master?.get_ref()))
}

/// Force along the outward normal of a flat side over its area; the largest of the stages in which friction acts.
fn mean<const D: usize>(
    model: &Model<D>,
    stages: &[Stage],
    interface: &str,
    (body, sides): (&Body<D>, &[Side]),
) -> Option<f64> {
    if !matches!(
        model.idealisation,
        Idealisation::PlaneStrain | Idealisation::PlaneStress | Idealisation::ThreeD
    ) {
        return None;
    }
    let mut normal = [0.0; D];
    for (dof, value) in
        surface::integrate(&model.mesh, sides, model.idealisation, |p, v| v[..D].copy_from_slice(&p.normal))
    {
        normal[dof % D] += value;
    }
    let area: f64 = surface::areas(&model.mesh, sides, model.idealisation).values().sum();
    let length = surface::length(&normal);
    if length < (1.0 - FLAT) * area {
        return None;
    }
    let normal = normal.map(|c| c / length);
    let active = stages.iter().filter(|s| !s.frictionless.iter().any(|f| f == interface));
    let free = active.filter(|s| !s.holds(&body.dofs, &normal.map(|c| c.abs() > FLAT)));
    free.map(|s| s.largest_force(&body.dofs, &normal) / area).reduce(f64::max)
}
