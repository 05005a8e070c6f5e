//! Values of the bodies around faults through time: at points, on sets, and of the springs that draw sides.

use super::bodies::BodiesView;
use super::plan::Plan;
use super::tables::{Course, Table};
use crate::views;
use asperity_cycles::Moment;
use asperity_mechanics::{Beside, Model, SpringNow, SpringStart, Stage, StressField, Wanted};
use asperity_ode::Clock;
use asperity_output::Sampled;
use asperity_output::view::Samples;
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};

/// Points, sets and springs that are sampled, and the bodies that have their values.
#[derive(Debug)]
pub struct Sampling {
    /// Points, sets and springs.
    pub sampled: Sampled,
    /// Name of the stage in which faults slide.
    pub stage: String,
    /// Number of that stage.
    pub number: usize,
    bodies: Box<dyn Sample>,
    /// Tributary areas of the points of the faults \[m²; m\].
    areas: Vec<f64>,
}

/// Tables of the values of bodies; all follow the largest slip rate. The bodies are solved for once a moment.
pub(super) fn tables(plan: &Plan) -> Vec<Table<'_>> {
    let (Some(sampling), Some(view)) = (&plan.sampling, &plan.bodies) else { return Vec::new() };
    let rows = Arc::new(Mutex::new(Lately::default()));
    let heads = sampling.sampled.heads().into_iter().enumerate();
    let table = |(k, (path, head)): (usize, (String, String))| {
        let rows = Arc::clone(&rows);
        let row = move |now: &Moment<'_>, step: u64| {
            let mut rows = rows.lock().unwrap_or_else(PoisonError::into_inner);
            rows.of((now.at, step), || {
                let when = (now.at.seconds(), sampling.number, step);
                sampling.sampled.rows(when, &sampling.at(view, now))
            })[k]
                .clone()
        };
        Table { path, head, course: Course::Largest, row: Box::new(row) }
    };
    heads.map(table).collect()
}

/// Rows of all tables at the two moments sampled last.
#[derive(Default)]
struct Lately(VecDeque<((Clock, u64), Vec<String>)>);

impl Lately {
    /// Rows at a moment, computed if they are not known.
    fn of(&mut self, when: (Clock, u64), rows: impl FnOnce() -> Vec<String>) -> &[String] {
        let known = self.0.iter().position(|(at, _)| *at == when);
        let k = known.unwrap_or_else(|| {
            self.0.truncate(1);
            self.0.push_front((when, rows()));
            0
        });
        &self.0[k].1
    }
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
    pub wanted: Wanted,
    /// The stage in which faults slide.
    pub stage: Stage,
    /// Loads on the nodes of each set that do not belong to it.
    pub beside: Vec<Beside>,
    /// Displacements at its start \[m\].
    pub start: Vec<f64>,
    /// Springs at its start.
    pub springs: Vec<SpringStart>,
}

impl Sampling {
    pub(super) fn new<const D: usize>(
        bodies: SampledBodies<D>,
        areas: Vec<f64>,
        (unit, number): (&'static str, usize),
    ) -> Self {
        let sampled = Sampled {
            points: bodies.wanted.points.iter().map(views::point_mark).collect(),
            forces: bodies.wanted.forces.iter().map(views::force_mark).collect(),
            springs: views::spring_marks(std::slice::from_ref(&bodies.stage)),
            unit,
        };
        Self { sampled, stage: bodies.stage.name.clone(), number, bodies: Box::new(bodies), areas }
    }

    /// Values at a moment.
    pub(super) fn at(&self, view: &BodiesView, now: &Moment<'_>) -> Samples {
        self.values(view, [now.slip().all(), &now.pressed.opening], now.at.seconds(), &now.pressed.normal)
    }

    /// Values under this slip and opening of the points \[m\] at a time \[s\], with these normal tractions \[Pa\].
    pub(super) fn values(&self, view: &BodiesView, jumps: [&[f64]; 2], time: f64, normal: &[f64]) -> Samples {
        let force = self.areas.iter().zip(normal).map(|(area, normal)| area * normal).sum();
        self.bodies.at(view.bodies.displacement(&view.jumps(jumps, time), time), time, force)
    }
}

impl<const D: usize> Sample for SampledBodies<D> {
    fn at(&self, change: Vec<f64>, time: f64, normal: f64) -> Samples {
        let u: Vec<f64> = change.iter().zip(&self.start).map(|(change, start)| start + change).collect();
        let (model, stage) = (&self.model, &self.stage);
        let values =
            self.wanted.values(model, (&model.blocks, &self.initial_stress), (&u, time), &self.beside);
        let spring = |(spring, start): (&asperity_mechanics::Spring, &SpringStart)| {
            let drawn = spring.rate.drawn((stage.start, stage.end)).at(time);
            SpringNow::of(start, spring.stiffness, drawn, u[spring.dofs[0]])
        };
        let springs: Vec<SpringNow> = stage.springs.iter().zip(&self.springs).map(spring).collect();
        let springs = views::springs(std::slice::from_ref(stage), stage, &springs, normal);
        views::samples(values, springs)
    }
}
