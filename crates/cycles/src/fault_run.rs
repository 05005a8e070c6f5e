//! A run of faults and the sources of its events.

use super::catalogue::{Event, Thresholds};
use super::equations::{Equations, Fault, Pressed};
use super::heat::Memory;
use super::opening::Crack;
use super::run::Run;
use super::rupture::{Detector, Rupture};
use super::waves::Episode;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Progress of a run of faults.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Progress {
    /// Event detector of each source.
    pub(crate) detectors: Vec<Detector>,
    /// Heat received so far, where a fault is heated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) heat: Option<Memory>,
    /// Ruptures that bodies with mass computed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub episodes: Vec<Episode>,
    /// The point at which the integration failed, if its normal traction fell to zero or its opening did not converge.
    #[serde(skip)]
    pub opens: Option<usize>,
}

/// A run of faults. Source [`ALL`] of its events is all faults together; where there are several, source 1 + k is fault k.
pub type FaultRun = Run<Rupture, Progress>;

/// Source of the events of all faults together, defined by the fastest point of all.
pub const ALL: usize = 0;

impl FaultRun {
    /// A run at time 0 of faults with these points.
    #[must_use]
    pub fn new(unknowns: Vec<f64>, faults: &[Range<usize>], thresholds: Thresholds) -> Self {
        let all = 0..faults.iter().map(|points| points.end).max().unwrap_or(0);
        let apart = if faults.len() > 1 { faults } else { &[] };
        let sources = std::iter::once(&all).chain(apart);
        let detectors: Vec<_> = sources.map(|points| Detector::new(points.clone(), thresholds)).collect();
        Self::begin(
            unknowns,
            detectors.len(),
            Progress { detectors, heat: None, episodes: Vec::new(), opens: None },
        )
    }

    /// Slip rates \[m/s\] and normal tractions at the time that the run has reached.
    #[must_use]
    pub fn present(&self, fault: &Fault) -> (Vec<f64>, Pressed) {
        let mut equations = Equations::new(fault, Vec::new(), Vec::new());
        equations.remember(self.progress.heat.clone(), self.at, &self.unknowns);
        let mut rate = vec![0.0; equations.layout().m().end];
        equations.slip_rates(self.at, &self.unknowns, &mut rate);
        (rate, equations.pressed(self.at, &self.unknowns, &mut Crack::default()))
    }

    /// Finished events of all faults together.
    #[must_use]
    pub fn events(&self) -> &[Event<Rupture>] {
        self.catalogue.ended(ALL)
    }

    /// The unfinished event of all faults together.
    #[must_use]
    pub fn under_way(&self) -> Option<&Event<Rupture>> {
        self.catalogue.under_way(ALL)
    }
}
