//! The problem to be solved: bodies, interfaces and stages, with the methods chosen for them.

use super::solver::Solver;
use super::{
    CellBlock, Control, Mass, Model, Path, PlannedInterface, SampleRequest, Stage, Stepping, StressField,
};
use asperity_contact::Sliding;
use asperity_fem::nonlinear::Kinematics;

/// Bodies, interfaces, stages and methods of a run.
#[derive(Debug)]
pub struct Problem<const D: usize> {
    /// Bodies.
    pub model: Model<D>,
    /// Initial stress of each body, if it has one.
    pub initial_stress: Vec<Option<StressField>>,
    /// Interfaces.
    pub interfaces: Vec<PlannedInterface>,
    /// Stages.
    pub stages: Vec<Stage>,
    /// Path.
    pub path: Path,
    /// Solver of the linear systems.
    pub solver: Solver,
    /// Stepper.
    pub stepping: Stepping,
    /// Step control.
    pub control: Control,
    /// Inertia; `None` if the bodies move through states of equilibrium.
    pub mass: Option<Mass>,
    /// Points and sets of bodies evaluated in every step.
    pub samples: SampleRequest,
}

impl<const D: usize> Problem<D> {
    /// True if forces depend on the current position of the bodies (finite sliding or large deformation).
    #[must_use]
    pub fn moves(&self) -> bool {
        let deformed = |b: &CellBlock<D>| match b {
            CellBlock::Linear(_) => false,
            CellBlock::Nonlinear(b) => b.model().kinematics == Kinematics::UpdatedLagrangian,
        };
        self.interfaces.iter().any(|i| i.sliding == Sliding::Finite) || self.model.blocks.iter().any(deformed)
    }

    /// Largest rate that the stages prescribe \[m/s\].
    #[must_use]
    pub fn largest_rate(&self) -> f64 {
        self.stages.iter().map(Stage::largest_rate).fold(0.0, f64::max)
    }
}
