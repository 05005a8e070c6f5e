//! State of a system between two steps, as serialisable values. A run resumed from it takes the same steps, bit for bit, as if
//! it had never been interrupted.

use super::bodies::BodiesState;
use super::springs::Springs;
use super::{AssembledProblem, terms};
use crate::energy::StaticState;
use crate::inertia::{InertialSystem, MassState};
use crate::step::StepperState;
use crate::{SpringStart, Stage};
use asperity_contact::InterfaceState;
use asperity_fem::term::{Linearized, Restorable as _};
use serde::{Deserialize, Serialize};
use std::fmt;

/// State of a system between two steps.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SystemState {
    /// Time \[s\].
    time: f64,
    /// Unknowns of the system: displacements \[m\], followed by multipliers if they are unknowns.
    unknowns: Vec<f64>,
    /// Displacements of the mesh at the start of the present stage \[m\].
    begin: Vec<f64>,
    bodies: BodiesState,
    /// Interfaces, in the order of the problem.
    interfaces: Vec<InterfaceState>,
    stepper: StepperState,
    /// Inertia, if the bodies have mass.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    mass: Option<MassState>,
    /// Energy budget, if they have none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    energy: Option<StaticState>,
    /// Springs at the start of the present stage, in its order.
    springs: Vec<SpringStart>,
}

impl SystemState {
    /// Time \[s\].
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }
}

/// Reason why a state does not fit a system.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Mismatch {
    /// The numbers of unknowns differ.
    Unknowns {
        /// Number in the state.
        found: usize,
        /// Number in the system.
        expected: usize,
    },
    /// The numbers of nodes or the histories of cells differ.
    Bodies,
    /// The numbers of interfaces differ.
    Interfaces {
        /// Number in the state.
        found: usize,
        /// Number in the system.
        expected: usize,
    },
    /// The numbers of springs differ.
    Springs {
        /// Number in the state.
        found: usize,
        /// Number in the stage.
        expected: usize,
    },
    /// An interface has different points, another measure or another law.
    Interface(String),
    /// The linear systems differ.
    Stepper,
    /// The stage cannot be set up.
    SetUp(String),
}

impl fmt::Display for Mismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknowns { found, expected } => {
                write!(f, "it has {found} unknowns, and the scene has {expected}")
            }
            Self::Bodies => f.write_str("its bodies are not those of the scene"),
            Self::Interfaces { found, expected } => {
                write!(f, "it has {found} interfaces, and the scene has {expected}")
            }
            Self::Springs { found, expected } => {
                write!(f, "it has {found} springs, and the scene has {expected}")
            }
            Self::Interface(name) => write!(f, "its interface `{name}` is not that of the scene"),
            Self::Stepper => f.write_str("its linear system is not that of the scene"),
            Self::SetUp(reason) => f.write_str(reason),
        }
    }
}

impl std::error::Error for Mismatch {}

impl<const D: usize> AssembledProblem<'_, D> {
    /// State between two steps of the present stage.
    #[must_use]
    pub fn save(&mut self) -> SystemState {
        let interfaces = self.interfaces.iter().map(asperity_fem::term::Restorable::save).collect();
        let stepper = match &self.stepper {
            Some(stepper) => {
                let terms = terms(
                    self.bodies.as_mut(),
                    &mut self.springs,
                    &mut self.interfaces,
                    self.moving.as_mut(),
                );
                let terms: Vec<&mut dyn Linearized> = terms.into_iter().map(|t| t as _).collect();
                stepper.save(&terms)
            }
            None => StepperState::default(),
        };
        SystemState {
            time: self.state.time,
            unknowns: self.state.u.clone(),
            begin: self.begin.clone(),
            bodies: self.bodies.save(),
            interfaces,
            stepper,
            mass: self.moving.as_ref().map(InertialSystem::save),
            energy: self.moving.is_none().then(|| self.budget.save()),
            springs: self.springs.as_ref().map_or_else(Vec::new, Springs::starts),
        }
    }

    /// Restores a state of the same problem, in the stage in which it was saved.
    ///
    /// # Errors
    /// [`Mismatch`] if it is the state of another problem. The system is then only partly restored and must not be used.
    pub fn restore(&mut self, stage: &Stage, saved: &SystemState) -> Result<(), Mismatch> {
        let (found, expected) = (saved.unknowns.len(), self.state.u.len());
        if found != expected {
            return Err(Mismatch::Unknowns { found, expected });
        }
        if saved.begin.len() != self.problem.model.dofs() {
            return Err(Mismatch::Bodies);
        }
        let (found, expected) = (saved.interfaces.len(), self.interfaces.len());
        if found != expected {
            return Err(Mismatch::Interfaces { found, expected });
        }
        let (found, expected) = (saved.springs.len(), stage.springs.len());
        if found != expected {
            return Err(Mismatch::Springs { found, expected });
        }
        self.begin_from(stage, saved.begin.clone(), &saved.springs)
            .map_err(|e| Mismatch::SetUp(e.to_string()))?;
        for ((interface, saved), planned) in
            self.interfaces.iter_mut().zip(&saved.interfaces).zip(&self.problem.interfaces)
        {
            if !interface.restore(saved) {
                return Err(Mismatch::Interface(planned.name.clone()));
            }
        }
        (self.state.time, self.state.u) = (saved.time, saved.unknowns.clone());
        if !self.bodies.restore(&saved.bodies) {
            return Err(Mismatch::Bodies);
        }
        let fits = match (&mut self.moving, &saved.mass, &saved.energy) {
            (Some(moving), Some(mass), _) => moving.restore(mass, &self.state.u),
            (None, None, Some(energy)) => self.budget.restore(energy, self.numbering.dofs, &self.interfaces),
            _ => false,
        };
        if !fits {
            return Err(Mismatch::Bodies);
        }
        let Some(stepper) = &mut self.stepper else { return Err(Mismatch::Stepper) };
        let terms =
            terms(self.bodies.as_mut(), &mut self.springs, &mut self.interfaces, self.moving.as_mut());
        let mut terms: Vec<&mut dyn Linearized> = terms.into_iter().map(|t| t as _).collect();
        if stepper.restore(&saved.stepper, &mut terms) { Ok(()) } else { Err(Mismatch::Stepper) }
    }
}
