//! A plan as data, and its summary for printing.

use super::events::EventPlan;
use super::start_gap::StartGap;
use crate::shared::checks::Checks;
use asperity_laws::Theta;
use asperity_mechanics::{Mass, Problem};
use asperity_output::bodies::FieldSchedule;
use asperity_run::Warning;
use schemars::JsonSchema;
use serde::Serialize;

/// Plan of the run.
#[derive(Debug)]
pub struct Plan<const D: usize> {
    /// Title of the scene.
    pub title: String,
    /// Problem to compute.
    pub problem: Problem<D>,
    /// Field outputs per stage.
    pub field_outputs: usize,
    /// Profile outputs per stage.
    pub profile_outputs: usize,
    /// Events of interfaces, if the scene asks for them.
    pub events: Option<EventPlan>,
    /// The state θ of the laws of each interface: one for all points, or one of each; empty where there is no θ.
    pub thetas: Vec<Vec<Theta>>,
    /// Summary for printing.
    pub summary: Summary,
    /// Extents, counts of points and lengths of friction.
    pub checks: Checks,
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
    /// Summary for printing.
    #[must_use]
    pub fn summary(&self) -> &Summary {
        match self {
            Self::Two(p) => &p.summary,
            Self::Three(p) => &p.summary,
        }
    }

    /// Extents, counts of points and lengths of friction.
    #[must_use]
    pub fn checks(&self) -> &Checks {
        match self {
            Self::Two(p) => &p.checks,
            Self::Three(p) => &p.checks,
        }
    }

    /// Warnings, so that their positions in the scene can be added.
    pub fn warnings_mut(&mut self) -> &mut [Warning] {
        match self {
            Self::Two(p) => &mut p.summary.warnings,
            Self::Three(p) => &mut p.summary.warnings,
        }
    }

    /// Field and profile outputs per stage.
    #[must_use]
    pub fn outputs(&self) -> FieldSchedule {
        let (fields, profiles) = match self {
            Self::Two(p) => (p.field_outputs, p.profile_outputs),
            Self::Three(p) => (p.field_outputs, p.profile_outputs),
        };
        FieldSchedule { fields, profiles }
    }
}

/// Summary of the plan.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct Summary {
    /// Physics included, and the reasons.
    pub physics: Vec<String>,
    /// System that is solved, and the reason.
    pub path: String,
    /// Linear solver, and the reason.
    pub solver: String,
    /// Stepper.
    pub stepper: String,
    /// Remarks: bodies held by contact alone, unpaired nodes.
    pub remarks: Vec<String>,
    /// Warnings about settings that are probably not intended.
    pub warnings: Vec<Warning>,
    /// Positions of the sides of the interfaces before the first step.
    pub start_gaps: Vec<StartGap>,
    /// Degrees of freedom of the bodies.
    pub dofs: usize,
    /// Degrees of freedom of the system solved in a step.
    pub system_dofs: usize,
    /// Size of the state variables of friction \[bytes\]; absent without interfaces.
    pub state_bytes: Option<usize>,
    /// Estimated memory \[bytes\].
    pub memory_bytes: usize,
}

impl Summary {
    /// Adds the inertia of the bodies.
    pub(super) fn add_inertia(&mut self, mass: &Mass) {
        let radius = mass.radius;
        self.physics
            .push(format!("inertia of all bodies, generalised-alpha method with spectral radius {radius:?}"));
        if let Some(h) = &mass.handover {
            let kinetic = if h.kinetic < 1.0 {
                format!(", and the kinetic energy has fallen to {:e} of its largest", h.kinetic)
            } else {
                String::new()
            };
            self.physics.push(format!(
                "inertia acts from a slip rate of {:e} m/s on, until rates have stayed below {:e} m/s for {:.2e} s, while a shear wave \
                 crosses the bodies and returns{kinetic}",
                h.above, h.below, h.wait
            ));
        }
    }
}

impl std::fmt::Display for Summary {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        writeln!(f, "plan")?;
        for line in &self.physics {
            writeln!(f, "  physics   {line}")?;
        }
        writeln!(f, "  path      {}", self.path)?;
        writeln!(f, "  solver    {}", self.solver)?;
        writeln!(f, "  stepper   {}", self.stepper)?;
        for start in &self.start_gaps {
            writeln!(f, "  start     {start}")?;
        }
        for line in &self.remarks {
            writeln!(f, "  note      {line}")?;
        }
        for warning in &self.warnings {
            writeln!(f, "  warning   {warning}")?;
        }
        writeln!(
            f,
            "  size      {} degrees of freedom, {} in each step's system, {}about {:.0} MB",
            self.dofs,
            self.system_dofs,
            self.state_bytes.map_or_else(String::new, |bytes| format!("{bytes} bytes of friction state, ")),
            self.memory_bytes as f64 / 1e6
        )
    }
}
