//! How finely the points of an interface of bodies stand beside the cohesive zone of its friction.
//!
//! The zone is as long as f_n is small ([`crate::fault::Ground`]), and f_n is known once bodies are pressed: the plan says up to which f_n the points
//! resolve it. Where loads alone press a flat interface their mean is known before, and judged then. Otherwise a run stops where a point slides
//! under so much that less than one point stands on the zone, and the end of each stage warns of less than three.

use crate::diagnostic::Diagnostic;
use crate::fault::{ENOUGH, FEW, Ground, TOO_FEW, modulus, spacings};
use crate::loading::Stage;
use crate::model::{Body, Model};
use crate::scene::law;
use crate::scene::model::{Interface, Scene, UnderResolved};
use crate::warning::Warning;
use asperity_fem::kinematics::Idealisation;
use asperity_fem::mesh::Side;
use asperity_fem::surface;
use std::ops::Range;

/// What the slave points of an interface resolve.
#[derive(Clone, Debug, PartialEq)]
pub struct Resolved {
    /// Normal traction under which the cohesive zone is as long as the largest distance between points \[Pa\].
    pub one: f64,
    /// That distance \[m\].
    pub spacing: f64,
    /// Whether the scene wants it run with less than one point to the zone.
    allowed: bool,
    place: Range<usize>,
}

impl Resolved {
    /// Of an interface, where its friction weakens with slip.
    pub fn new<const D: usize>(model: &Model<D>, spec: &Interface, slave: &[Side]) -> Option<Self> {
        let law = spec.law.as_ref()?;
        let choice = law::choose(law).ok()?;
        let of_side = |set| {
            let body = &model.bodies[model.body_of(set)?];
            let elastic = body.elastic.first()?;
            Some(modulus(model.idealisation, elastic.shear(), elastic.poisson()))
        };
        let (a, b) = (of_side(spec.slave.get_ref())?, of_side(spec.master.get_ref())?);
        let modulus = 2.0 * a * b / (a + b);
        let [zone, _] = Ground { law: &choice, normal: 1.0, modulus, in_space: D == 3 }.lengths()?;
        let spacing = spacings(model, slave).into_values().fold(0.0, f64::max);
        let allowed = spec.under_resolved.as_ref().map(|u| *u.get_ref()) == Some(UnderResolved::Allow);
        Some(Self { one: zone / spacing, spacing, allowed, place: law.span() })
    }

    /// What the plan says.
    #[must_use]
    pub fn remark(&self, interface: &str) -> String {
        format!(
            "interface `{interface}`: points at most {:.4e} m apart are three to the cohesive zone under {:.4} MPa of normal traction, and one under {:.4} MPa",
            self.spacing,
            self.one / ENOUGH / 1e6,
            self.one / 1e6
        )
    }

    /// Normal traction under which no point may slide \[Pa\]; none where the scene allows it.
    #[must_use]
    pub fn refused_beyond(&self) -> Option<f64> {
        (!self.allowed).then_some(self.one / TOO_FEW)
    }

    /// What the points resolve and what helps, where a run stops for it.
    #[must_use]
    pub fn limit(&self) -> String {
        format!(
            "points {:.4e} m apart resolve it up to {:.4} MPa: take them closer, in proportion, or a longer length of weakening (`l`, `d_c`); `under_resolved = \"allow\"` at the interface runs on",
            self.spacing,
            self.one / TOO_FEW / 1e6
        )
    }

    /// What helps where less than one point stands on the zone.
    #[must_use]
    pub fn remedy(&self, normal: f64) -> String {
        format!("{}; or `under_resolved = \"allow\"` at the interface", self.enough(normal))
    }

    fn enough(&self, normal: f64) -> String {
        format!("points {:.4e} m apart give three", self.spacing * self.one / normal / ENOUGH)
    }

    /// A warning where the largest normal traction \[Pa\] at the end of a stage leaves too few points.
    #[must_use]
    pub fn warning(&self, interface: &str, stage: &str, largest: f64) -> Option<Warning> {
        let points = self.one / largest;
        (largest > 0.0 && points < FEW).then(|| {
            Warning::at(
                self.place.clone(),
                format!(
                    "interface `{interface}` is pressed with up to {:.4} MPa at the end of stage `{stage}`, where {points:.2} points stand on the cohesive zone: fronts of slip follow the \
                     mesh",
                    largest / 1e6
                ),
                self.enough(largest),
            )
        })
    }

    /// A warning where a mean normal traction \[Pa\] that loads are known to press with leaves too few points.
    ///
    /// # Errors
    /// [`Diagnostic`] where they are less than one and the scene does not allow it.
    pub fn check(&self, interface: &str, mean: f64) -> Result<Option<Warning>, Diagnostic> {
        let points = self.one / mean;
        if mean <= 0.0 || points >= FEW {
            return Ok(None);
        }
        let message = format!(
            "loads press interface `{interface}` with {:.4} MPa on average, where {points:.2} points, {:.4e} m apart, stand on the cohesive zone",
            mean / 1e6,
            self.spacing
        );
        if points < TOO_FEW && !self.allowed {
            let message = format!("{message}: each point breaks by itself, and slip is that of the mesh");
            return Err(Diagnostic::at(self.place.clone(), message, self.remedy(mean)));
        }
        let message = format!("{message}: fronts of slip follow the mesh");
        Ok(Some(Warning::at(self.place.clone(), message, self.enough(mean))))
    }
}

/// Sine of the angle between a surface and a plane below which it is flat, and of that between two directions below which they are one: rounding of coordinates.
const FLAT: f64 = 1e-9;

/// Largest mean normal traction \[Pa\] of an interface in the stages in which its friction acts, where statics alone says it: one of its bodies is pressed by
/// loads onto a flat side, and held along its normal by nothing else.
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

/// Force along the outward normal of a flat side over its area, the largest of the stages in which friction acts.
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
