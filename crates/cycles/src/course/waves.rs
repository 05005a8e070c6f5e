//! The seam to bodies with mass, which compute the ruptures of a run.
//!
//! A rupture is a perturbation of the state at which it is handed over: bodies begin at rest and undeformed, and the
//! tractions that load the fault are those of equilibrium, from which waves then take their part.

use asperity_friction::points::{Components, PerPoint};
use asperity_ode::Control;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::error::Error;

/// Slip rates between which faults pass to bodies with mass and back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Handover {
    /// Largest slip rate from which bodies have mass \[m/s\].
    pub above: f64,
    /// Largest slip rate below which they may lose it again \[m/s\].
    pub below: f64,
    /// Time for which it must have stayed below \[s\].
    pub quiet: f64,
    /// Largest kinetic energy with which they lose it, over the largest of the rupture \[-\].
    pub kinetic: f64,
}

/// Bodies with mass, and when they are used.
pub struct Dynamics<'a> {
    /// Slip rates of the hand-overs.
    pub handover: Handover,
    /// Tributary areas of the points \[m²; m per metre of thickness\].
    pub areas: &'a [f64],
    /// The bodies.
    pub waves: &'a mut dyn Waves,
}

/// State of the faults at which a rupture begins.
#[derive(Clone, Debug, PartialEq)]
pub struct Start {
    /// Shear tractions in equilibrium, without radiation damping \[Pa\].
    pub loading: Components<Vec<f64>>,
    /// Their rates under the loads alone \[Pa/s\].
    pub loading_rate: Components<Vec<f64>>,
    /// Friction \[Pa\].
    pub friction: Components<Vec<f64>>,
    /// Normal tractions \[Pa\].
    pub normal: Vec<f64>,
    /// Slip rates \[m/s\].
    pub rate: Components<Vec<f64>>,
    /// State variables.
    pub states: PerPoint<Vec<f64>>,
}

/// State of the faults at a step of a rupture.
pub struct Shaken<'a> {
    /// Time since its start \[s\].
    pub time: f64,
    /// Slip since its start \[m\].
    pub slip: Components<&'a [f64]>,
    /// Slip rates \[m/s\].
    pub rate: Components<&'a [f64]>,
    /// Shear tractions \[Pa\].
    pub shear: Components<&'a [f64]>,
    /// Normal tractions \[Pa\].
    pub normal: &'a [f64],
    /// State variables.
    pub states: PerPoint<&'a [f64]>,
    /// Kinetic energy \[J; J per metre of thickness in the plane\].
    pub kinetic: f64,
    /// Energy that has left the fault since the start: that of the bodies, what they dissipated, and what was absorbed.
    pub energy: &'a mut dyn FnMut() -> f64,
}

/// Error of bodies with mass.
pub type WavesError = Box<dyn Error + Send + Sync>;

/// Bodies with mass around the faults.
pub trait Waves {
    /// Computes a rupture from its start. Each step is shown to `see`, which ends the rupture.
    ///
    /// # Errors
    /// The reason why the steps cannot continue.
    fn rupture(
        &mut self,
        start: &Start,
        see: &mut dyn FnMut(Shaken<'_>) -> Control,
    ) -> Result<(), WavesError>;
}

/// A rupture computed by bodies with mass, and the errors of the hand-overs at its ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Episode {
    /// Time at which it began \[s\].
    pub begin: f64,
    /// Time at which it ended \[s\].
    pub end: f64,
    /// Steps.
    pub steps: usize,
    /// Largest slip rate at its start \[m/s\].
    pub rate: f64,
    /// Largest η V at its start over a f_n \[-\]: the change of ln V by what equilibrium leaves out.
    pub radiation: f64,
    /// Largest change of shear traction in the first step over a f_n \[-\].
    pub first: f64,
    /// Largest difference at its end between the shear tractions with waves and in equilibrium over a f_n \[-\].
    pub unbalanced: f64,
    /// The same over the largest drop of shear traction \[-\].
    pub unbalanced_drop: f64,
    /// Largest drop of shear traction over the rupture \[Pa\].
    pub drop: f64,
    /// Largest slip \[m\].
    pub slip: f64,
    /// Energy that waves took \[J; J per metre of thickness in the plane\].
    pub radiated: f64,
    /// Kinetic energy at its end, which equilibrium does not have, over the largest one \[-\].
    pub kinetic: f64,
}
