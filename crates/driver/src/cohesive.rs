//! How finely the points of an interface of bodies stand beside the cohesive zone of its friction.
//!
//! The zone is as long as f_n is small ([`crate::fault::Ground`]), and f_n is known once bodies are pressed: the plan says up to which f_n the points
//! resolve it, and the end of each stage compares.

use crate::fault::{ENOUGH, Ground, modulus, spacings};
use crate::model::Model;
use crate::scene::law;
use crate::scene::model::Interface;
use crate::warning::Warning;
use asperity_fem::mesh::Side;
use std::ops::Range;

/// What the slave points of an interface resolve.
#[derive(Clone, Debug, PartialEq)]
pub struct Resolved {
    /// Normal traction under which the cohesive zone is as long as the largest distance between points \[Pa\].
    pub one: f64,
    /// That distance \[m\].
    pub spacing: f64,
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
        Some(Self { one: zone / spacing, spacing, place: law.span() })
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

    /// A warning where the largest normal traction \[Pa\] at the end of a stage leaves too few points.
    #[must_use]
    pub fn warning(&self, interface: &str, stage: &str, largest: f64) -> Option<Warning> {
        let points = self.one / largest;
        (largest > 0.0 && points < ENOUGH).then(|| {
            Warning::at(
                self.place.clone(),
                format!(
                    "interface `{interface}` is pressed with up to {:.4} MPa at the end of stage `{stage}`, where {points:.2} points stand on the cohesive zone: fronts of slip follow the \
                     mesh",
                    largest / 1e6
                ),
                format!("points {:.4e} m apart give three", self.spacing * points / ENOUGH),
            )
        })
    }
}
