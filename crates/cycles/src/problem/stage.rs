//! Stages and steps as processes see them, and their saved states.

use super::point_tractions::PointTractions;
use asperity_friction::fault::Unknowns;
use asperity_friction::points::Components;
use asperity_ode::Clock;
use serde::{Deserialize, Serialize};

/// State of a fault, for one of its processes.
#[derive(Clone, Copy, Debug)]
pub struct FaultState<'a> {
    /// Time.
    pub at: Clock,
    /// Unknowns of friction.
    pub friction: Unknowns<'a>,
    /// Normal tractions of the bodies \[Pa\].
    pub normal: &'a [f64],
    /// Unknowns of the process.
    pub own: &'a [f64],
}

/// Time of a stage.
#[derive(Clone, Copy, Debug)]
pub struct Time {
    /// Time \[s\].
    pub at: f64,
    /// Time at which the integration ends \[s\]. A change at that time is not seen.
    pub until: f64,
}

/// Tractions that processes change.
#[derive(Debug)]
pub struct Tractions<'a> {
    /// Normal tractions \[Pa\]; empty where no process changes them.
    pub normal: &'a mut [f64],
    /// Rates, where they are computed.
    pub rates: Option<Rates<'a>>,
}

/// Rates of slip and of tractions.
#[derive(Debug)]
pub struct Rates<'a> {
    /// Slip rates \[m/s\].
    pub slip: Components<&'a [f64]>,
    /// Rates of normal tractions \[Pa/s\]; empty where they do not change.
    pub normal: &'a mut [f64],
    /// Rates of shear tractions \[Pa/s\].
    pub shear: Components<&'a mut [f64]>,
}

/// A step, for the energy of a process.
#[derive(Clone, Copy, Debug)]
pub struct Stretch<'a> {
    /// Length \[s\].
    pub length: f64,
    /// Areas of the points \[m²; m per metre of thickness\].
    pub areas: &'a [f64],
    /// Values of processes at both ends.
    pub pressed: [&'a PointTractions; 2],
    /// Their rates.
    pub rates: [&'a PointTractions; 2],
    /// Pressure of fluid less the normal traction of loads at both ends \[Pa\], and its rate \[Pa/s\].
    pub parting: [&'a [[f64; 2]]; 2],
}

/// An accepted step, for the statistics of a process.
#[derive(Clone, Copy, Debug)]
pub struct Passage<'a> {
    /// Time at its end \[s\].
    pub at: f64,
    /// Length \[s\]; 0 at the start.
    pub length: f64,
    /// Slip at its end \[m\].
    pub slip: Components<&'a [f64]>,
    /// Tractions at its end.
    pub pressed: &'a PointTractions,
    /// Slip and tractions at its start; none at the start of the run.
    pub start: Option<(Components<&'a [f64]>, &'a PointTractions)>,
    /// True if an event is under way.
    pub in_event: bool,
    /// True if an event ends in it.
    pub ended: bool,
}

/// Saved state of a process or of its account.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProcessRecord {
    /// Name of the process.
    pub process: String,
    /// Time, where one is saved.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at: Option<Clock>,
    /// Lists of numbers.
    pub lists: Vec<Vec<f64>>,
}

impl ProcessRecord {
    /// State of lists of numbers.
    #[must_use]
    pub fn new<const N: usize>(process: &str, lists: [&[f64]; N]) -> Self {
        Self { process: process.into(), at: None, lists: lists.map(<[f64]>::to_vec).into() }
    }

    /// State of a process among those of others.
    #[must_use]
    pub fn find<'a>(all: &'a [Self], process: &str) -> Option<&'a Self> {
        all.iter().find(|saved| saved.process == process)
    }

    /// A list; empty if it was not saved.
    #[must_use]
    pub fn list(&self, number: usize) -> &[f64] {
        self.lists.get(number).map_or(&[], Vec::as_slice)
    }
}
