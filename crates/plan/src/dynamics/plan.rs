//! The problem and its outputs, and their description before the run.

use crate::faults::{FaultView, PointView};
use crate::shared::checks::Checks;
use crate::shared::resolution::Resolution;
use crate::shared::words::{length, time};
use asperity_fem::mesh::Cells;
use asperity_mechanics::dynamics::{Problem, StableStep};
use asperity_output::bodies::view::MeshView;
use asperity_run::Warning;
use jiff::Timestamp;
use std::fmt::Write as _;

/// A station on a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Receiver {
    /// Its code.
    pub name: String,
    /// Position \[m\].
    pub at: Vec<f64>,
    /// Nodes of the cell in which it lies, with their shares.
    pub shares: Vec<(usize, f64)>,
}

/// Steps between outputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cadence {
    /// Between rows of seismograms, stations, energies and moment rate.
    pub rows: usize,
    /// Between profiles.
    pub profiles: usize,
    /// Between fields.
    pub fields: usize,
}

/// The problem and its outputs.
#[derive(Debug)]
pub struct Plan<const D: usize> {
    /// Title.
    pub title: String,
    /// Problem to compute.
    pub problem: Problem<D>,
    /// Largest stable step and the cell that sets it.
    pub stable: StableStep,
    /// Position of that cell \[m\].
    pub stiffest: [f64; D],
    /// Number of steps.
    pub steps: usize,
    /// Length of a step \[s\].
    pub dt: f64,
    /// Reason for that length.
    pub step_reason: String,
    /// Faults.
    pub faults: Vec<FaultView>,
    /// Points of the faults, fault by fault.
    pub points: Vec<PointView>,
    /// Resolution of faults on which friction weakens.
    pub resolution: Vec<Resolution>,
    /// Slip rate at which a point has ruptured \[m/s\].
    pub rupture_rate: f64,
    /// Slip rate that ends the run, the speed of shear waves at the faults \[m/s\].
    pub fastest: f64,
    /// Stations on bodies.
    pub receivers: Vec<Receiver>,
    /// Time zero.
    pub epoch: Timestamp,
    /// Steps between outputs.
    pub cadence: Cadence,
    /// Mesh for fields.
    pub mesh: MeshView,
    /// Axes along which bodies move.
    pub axes: Vec<usize>,
    /// True if energies are per length out of the plane.
    pub per_length: bool,
    /// Description of the idealisation.
    pub kinematics: &'static str,
    /// Estimated memory \[bytes\].
    pub memory_bytes: usize,
    /// Warnings about settings that are probably not intended.
    pub warnings: Vec<Warning>,
    /// Notes for the user that are not warnings.
    pub notes: Vec<String>,
    /// Extents, counts of points and lengths of friction.
    pub checks: Checks,
}

impl<const D: usize> Plan<D> {
    /// Time at the end \[s\].
    #[must_use]
    pub fn end(&self) -> f64 {
        self.steps as f64 * self.dt
    }

    /// Time between rows \[s\].
    #[must_use]
    pub fn interval(&self) -> f64 {
        self.cadence.rows as f64 * self.dt
    }

    /// Summary to be read before the run.
    #[must_use]
    pub fn summary(&self) -> String {
        let mut text = String::from("plan\n");
        let mut line = |name: &str, value: String| {
            let _ = writeln!(text, "  {name:<9} {value}");
        };
        let strain = if self.problem.model.bodies.iter().any(|b| b.nonlinear.is_some()) {
            "some with a history or large strain"
        } else {
            "linear elastic, small strain"
        };
        line("physics", format!("bodies with mass, {strain}, {}", self.kinematics));
        for fault in &self.faults {
            let opens = self.problem.fault.as_ref().is_some_and(|f| f.opens);
            let parts = if opens { "and part" } else { "without opening" };
            line(
                "physics",
                format!("fault `{}`: {} split points that slide {parts}", fault.name, fault.points.len()),
            );
        }
        let locked = self.problem.fault.as_ref().map_or(0, |f| f.ties.len());
        if locked > 0 {
            line("physics", format!("{locked} points of the faults are locked"));
        }
        if !self.problem.absorbing.is_empty() {
            line("physics", format!("{} nodes of absorbing sides", self.problem.absorbing.len()));
        }
        line("stepper", self.steps_in_words());
        line("stepper", self.stable_in_words());
        line(
            "size",
            format!(
                "{} degrees of freedom, about {:.0} MB",
                self.problem.model.dofs(),
                self.memory_bytes as f64 / 1e6
            ),
        );
        let Cadence { rows, profiles, fields } = self.cadence;
        let each = |steps: usize| time(steps as f64 * self.dt);
        line(
            "output",
            format!(
                "rows every {}, profiles every {}, fields every {}",
                each(rows),
                each(profiles),
                each(fields)
            ),
        );
        for note in &self.notes {
            line("note", note.clone());
        }
        for warning in &self.warnings {
            line("warning", warning.to_string());
        }
        text
    }

    fn steps_in_words(&self) -> String {
        let viscosity = match self.problem.viscosity {
            0.0 => "no viscosity".into(),
            beta => format!("viscosity of {beta} steps"),
        };
        format!("explicit: {} steps of {:.6e} s, {viscosity}", self.steps, self.dt)
    }

    fn stable_in_words(&self) -> String {
        let block = &self.problem.model.mesh.blocks[self.stable.highest.block];
        let at: Vec<String> = self.stiffest.iter().map(|x| length(*x)).collect();
        format!(
            "the largest stable step is {:.6e} s, set by the {} at ({}); a step is {:.3} of it: {}",
            self.stable.step,
            block.kind.name(),
            at.join(", "),
            self.share(),
            self.step_reason
        )
    }

    /// A step over the largest stable one.
    #[must_use]
    pub fn share(&self) -> f64 {
        self.dt / self.stable.step
    }

    /// Number of cells.
    #[must_use]
    pub fn cells(&self) -> usize {
        self.problem.model.mesh.blocks.iter().map(Cells::len).sum()
    }
}

/// A plan in two or three dimensions.
#[derive(Debug)]
pub enum AnyPlan {
    /// Two-dimensional.
    Two(Box<Plan<2>>),
    /// Three-dimensional.
    Three(Box<Plan<3>>),
}

impl AnyPlan {
    /// Summary to be read before the run.
    #[must_use]
    pub fn summary(&self) -> String {
        match self {
            Self::Two(plan) => plan.summary(),
            Self::Three(plan) => plan.summary(),
        }
    }

    /// Extents, counts of points and lengths of friction.
    #[must_use]
    pub fn checks(&self) -> &Checks {
        match self {
            Self::Two(plan) => &plan.checks,
            Self::Three(plan) => &plan.checks,
        }
    }

    /// Notes for the user that are not warnings.
    #[must_use]
    pub fn notes(&self) -> &[String] {
        match self {
            Self::Two(plan) => &plan.notes,
            Self::Three(plan) => &plan.notes,
        }
    }

    /// Warnings.
    #[must_use]
    pub fn warnings(&self) -> &[Warning] {
        match self {
            Self::Two(plan) => &plan.warnings,
            Self::Three(plan) => &plan.warnings,
        }
    }

    /// Warnings, so that their positions in the scene can be added.
    pub fn warnings_mut(&mut self) -> &mut [Warning] {
        match self {
            Self::Two(plan) => &mut plan.warnings,
            Self::Three(plan) => &mut plan.warnings,
        }
    }
}
