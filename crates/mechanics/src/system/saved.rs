//! The state of a system between two steps, as values: what a run that is resumed needs to take the same steps, bit for bit, as if it had
//! never been interrupted.

use super::Assembled;
use super::bodies::BodiesState;
use crate::Stage;
use crate::step::StepperState;
use asperity_contact::InterfaceState;
use asperity_fem::term::{Limited, Linearized, Saved as _};
use serde::{Deserialize, Serialize};
use std::fmt;

/// See the module.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SystemState {
    /// Time \[s\].
    time: f64,
    /// Unknowns of the system: displacements \[m\], then multipliers where they are unknowns.
    unknowns: Vec<f64>,
    /// Displacements of the mesh when the present stage began \[m\].
    begin: Vec<f64>,
    bodies: BodiesState,
    /// Interfaces, in the order of the problem.
    interfaces: Vec<InterfaceState>,
    stepper: StepperState,
}

impl SystemState {
    /// Time \[s\].
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }
}

/// Reason why a state is not that of a system.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Mismatch {
    /// The number of unknowns is another.
    Unknowns {
        /// Of the state.
        found: usize,
        /// Of the system.
        expected: usize,
    },
    /// The number of nodes or the histories of cells are others.
    Bodies,
    /// The number of interfaces is another.
    Interfaces {
        /// In the state.
        found: usize,
        /// In the system.
        expected: usize,
    },
    /// An interface has other points, another measure or another law.
    Interface(String),
    /// The linear system is another.
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
            Self::Interface(name) => write!(f, "its interface `{name}` is not that of the scene"),
            Self::Stepper => f.write_str("its linear system is not that of the scene"),
            Self::SetUp(reason) => f.write_str(reason),
        }
    }
}

impl std::error::Error for Mismatch {}

impl<const D: usize> Assembled<'_, D> {
    /// The state between two steps of the present stage.
    #[must_use]
    pub fn save(&mut self) -> SystemState {
        let interfaces = self.interfaces.iter().map(asperity_fem::term::Saved::save).collect();
        let stepper = match &self.stepper {
            Some(stepper) => {
                let mut terms = self.bodies.terms();
                terms.extend(self.interfaces.iter_mut().map(|i| i as &mut dyn Limited));
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
        }
    }

    /// Takes up a state of the same problem, in the stage in which it was saved.
    ///
    /// # Errors
    /// [`Mismatch`] where it is the state of another problem; what was restored until then is of no use.
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
        self.begin_from(stage, saved.begin.clone()).map_err(Mismatch::SetUp)?;
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
        let Some(stepper) = &mut self.stepper else { return Err(Mismatch::Stepper) };
        let mut terms = self.bodies.terms();
        terms.extend(self.interfaces.iter_mut().map(|i| i as &mut dyn Limited));
        let mut terms: Vec<&mut dyn Linearized> = terms.into_iter().map(|t| t as _).collect();
        if stepper.restore(&saved.stepper, &mut terms) { Ok(()) } else { Err(Mismatch::Stepper) }
    }
}
