//! Values of the bodies around faults through time: at points, on sets, and of the springs that load sides.

use super::bodies::BodiesView;
use crate::shared::views;
use asperity_cycles::{Moment, OPENING};
use asperity_mechanics::{ForeignLoads, Model, SampleRequest, SpringStart, SpringState, Stage, StressField};
use asperity_output::bodies::SampleSites;
use asperity_output::bodies::view::Samples;

/// Points, sets and springs that are sampled, and the bodies that have their values.
#[derive(Debug)]
pub struct Sampling {
    /// Points, sets and springs.
    pub sampled: SampleSites,
    /// Name of the stage in which faults slide.
    pub stage: String,
    /// Number of that stage.
    pub number: usize,
    bodies: Box<dyn Sample>,
    /// Tributary areas of the points of the faults \[m²; m\].
    areas: Vec<f64>,
}

/// Bodies that are sampled.
trait Sample: Send + Sync + std::fmt::Debug {
    /// Values for a change of all displacements since the start \[m\], at a time \[s\], with the normal forces on all faults \[N; N/m\].
    fn at(&self, change: Vec<f64>, time: f64, normal: f64) -> Samples;
}

/// The bodies of a scene, as sampled.
#[derive(Debug)]
pub(super) struct SampledBodies<const D: usize> {
    /// The mesh with its blocks of cells.
    pub model: Model<D>,
    /// Initial stress of each body.
    pub initial_stress: Vec<Option<StressField>>,
    /// Points and sets.
    pub wanted: SampleRequest,
    /// The stage in which faults slide.
    pub stage: Stage,
    /// Loads on the nodes of each set that do not belong to it.
    pub beside: Vec<ForeignLoads>,
    /// Displacements at its start \[m\].
    pub start: Vec<f64>,
    /// Springs at its start.
    pub springs: Vec<SpringStart>,
}

impl Sampling {
    pub(super) fn new<const D: usize>(
        bodies: SampledBodies<D>,
        areas: Vec<f64>,
        unit: &'static str,
        number: usize,
    ) -> Self {
        let sampled = SampleSites {
            points: bodies.wanted.points.iter().map(views::point_mark).collect(),
            forces: bodies.wanted.forces.iter().map(views::force_mark).collect(),
            springs: views::spring_marks(std::slice::from_ref(&bodies.stage)),
            unit,
        };
        Self { sampled, stage: bodies.stage.name.clone(), number, bodies: Box::new(bodies), areas }
    }

    /// Values at a moment.
    pub fn at(&self, view: &BodiesView, now: &Moment<'_>) -> Samples {
        self.values(
            view,
            [now.slip().all(), now.pressed.values(&OPENING)],
            now.at.seconds(),
            &now.pressed.normal,
        )
    }

    /// Values under this slip and opening of the points \[m\] at a time \[s\], with these normal tractions \[Pa\].
    pub fn values(&self, view: &BodiesView, jumps: [&[f64]; 2], time: f64, normal: &[f64]) -> Samples {
        let force = self.areas.iter().zip(normal).map(|(area, normal)| area * normal).sum();
        self.bodies.at(view.bodies.displacement(&view.jumps(jumps, time), time), time, force)
    }
}

impl<const D: usize> Sample for SampledBodies<D> {
    fn at(&self, change: Vec<f64>, time: f64, normal: f64) -> Samples {
        let u: Vec<f64> = change.iter().zip(&self.start).map(|(change, start)| start + change).collect();
        let (model, stage) = (&self.model, &self.stage);
        let values = self.wanted.values(model, &model.blocks, &self.initial_stress, &u, time, &self.beside);
        let spring = |(spring, start): (&asperity_mechanics::Spring, &SpringStart)| {
            let drawn = spring.rate.drawn(stage.start, stage.end).at(time);
            SpringState::new(start, spring.stiffness, drawn, u[spring.dofs[0]])
        };
        let springs: Vec<SpringState> = stage.springs.iter().zip(&self.springs).map(spring).collect();
        let springs = views::springs(std::slice::from_ref(stage), stage, &springs, normal);
        views::samples(values, springs)
    }
}
