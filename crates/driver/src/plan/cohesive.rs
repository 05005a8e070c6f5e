//! Resolution of the cohesive zone by the points of an interface, with an error or a warning if statics shows that it
//! is too coarse.

use crate::cohesive::enough;
use crate::diagnostic::Diagnostic;
use crate::fault::{FEW, Ground, TOO_FEW, modulus, spacings};
use crate::laws;
use crate::model::{Body, Model};
use crate::scene::model::{Interface, Scene, UnderResolved};
use crate::warning::Warning;
use asperity_fem::kinematics::Idealisation;
use asperity_fem::mesh::Side;
use asperity_fem::surface;
use asperity_mechanics::{Resolved, Stage};

/// Cohesive zone and nucleation length of an interface, times the normal traction \[Pa m\]; `None` if its friction does not weaken with slip.
pub fn lengths<const D: usize>(model: &Model<D>, spec: &Interface) -> Option<[f64; 2]> {
    let law = laws::choose(spec.law.as_ref()?).ok()?;
    let of_side = |set| {
        let body = &model.bodies[model.body_of(set)?];
        let elastic = body.elastic.first()?;
        Some(modulus(model.idealisation, elastic.shear(), elastic.poisson()))
    };
    let (a, b) = (of_side(spec.slave.get_ref())?, of_side(spec.master.get_ref())?);
    let modulus = 2.0 * a * b / (a + b);
    Ground { law: &law, normal: 1.0, modulus, in_space: D == 3 }.lengths()
}

/// Resolution of an interface whose friction weakens with slip.
pub fn resolved<const D: usize>(model: &Model<D>, spec: &Interface, slave: &[Side]) -> Option<Resolved> {
    let law = spec.law.as_ref()?;
    let [zone, _] = lengths(model, spec)?;
    let spacing = spacings(model, slave).into_values().fold(0.0, f64::max);
    let allowed = spec.under_resolved.as_ref().map(|u| *u.get_ref()) == Some(UnderResolved::Allow);
    let one = zone / spacing;
    let refused_beyond = (!allowed).then_some(one / TOO_FEW);
    Some(Resolved { one, spacing, refused_beyond, limit: limit(one, spacing), place: law.span() })
}

/// Resolution limit and remedy, printed if a run stops because of it.
fn limit(one: f64, spacing: f64) -> String {
    format!(
        "points {spacing:.4e} m apart resolve it up to {:.4} MPa: take them closer, in proportion, or a longer length of weakening (`l`, `d_c`); `under_resolved = \"allow\"` at the interface runs on",
        one / TOO_FEW / 1e6
    )
}

/// Remedy if the cohesive zone contains less than one point.
fn remedy(resolved: &Resolved, normal: f64) -> String {
    format!("{}; or `under_resolved = \"allow\"` at the interface", enough(resolved, normal))
}

/// Warning if a mean normal traction \[Pa\] that follows from the loads leaves too few points.
///
/// # Errors
/// [`Diagnostic`] if there is less than one point and the scene does not allow it.
pub fn check(resolved: &Resolved, interface: &str, mean: f64) -> Result<Option<Warning>, Diagnostic> {
    let points = resolved.one / mean;
    if mean <= 0.0 || points >= FEW {
        return Ok(None);
    }
    let message = format!(
        "loads press interface `{interface}` with {:.4} MPa on average, where {points:.2} points, {:.4e} m apart, stand on the cohesive zone",
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

/// Sine of the angle below which a surface counts as flat and two directions count as equal: rounding of coordinates.
const FLAT: f64 = 1e-9;

/// Largest mean normal traction \[Pa\] of an interface in the stages in which its friction acts, if statics alone determines it. For this, loads must
/// press one of its bodies onto a flat side, and nothing else may hold that body along the normal.
pub fn pressed<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    stages: &[Stage],
    (name, spec): (&str, &Interface),
) -> Option<f64> {
    let touched = |body: &str| {
        let of = |set: &str| set.split('.').next() == Some(body);
        scene.interfaces.values().filter(|i| of(i.slave.get_ref()) || of(i.master.get_ref())).count()
    };
    let by = |set: &str| {
        let body = &model.bodies[model.body_of(set)?];
        let alone = touched(&body.name) == 1 && body.parts.len() == 1;
        let sides = model.mesh.side_sets.get(set)?;
        if alone { mean(model, stages, name, (body, sides)) } else { None }
    };
    by(spec.slave.get_ref()).or_else(|| by(spec.master.get_ref()))
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
