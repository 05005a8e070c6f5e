//! The problem that explicit dynamics computes.

use super::{Dashpot, Fault};
use crate::{Model, Stage};

/// Bodies with mass, the faults between them, and what acts on both.
#[derive(Debug)]
pub struct Problem<const D: usize> {
    /// Bodies.
    pub model: Model<D>,
    /// Density of each block of cells \[kg/m³\].
    pub density: Vec<f64>,
    /// Step over the largest stable one, below 1 \[-\].
    pub courant: f64,
    /// β: relaxation time of Kelvin-Voigt damping over the step \[-\]; 0 without damping.
    pub viscosity: f64,
    /// Faults, if there are any.
    pub fault: Option<Fault>,
    /// Dashpots of absorbing sides, by ascending nodes.
    pub absorbing: Vec<Dashpot>,
    /// Stages.
    pub stages: Vec<Stage>,
    /// Velocity of each degree of freedom at the start \[m/s\]; empty for bodies at rest.
    pub velocity: Vec<f64>,
}
