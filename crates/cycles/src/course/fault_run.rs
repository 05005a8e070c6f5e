//! A run of faults and the sources of its events.

use super::run::Run;
use super::waves::Episode;
use crate::accounts::{Detector, Moment, Rupture};
use crate::equations::Equations;
use crate::problem::{Fault, PointTractions, ProcessRecord, Thresholds};
use asperity_run::{ALL, Event, Kind};
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Progress of a run of faults.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Progress {
    /// Event detector of each source.
    pub(crate) detectors: Vec<Detector>,
    /// States that processes remember.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) processes: Vec<ProcessRecord>,
    /// Ruptures that bodies with mass computed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub episodes: Vec<Episode>,
    /// First source of slow events, if there are any; those of all faults follow it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) slow: Option<usize>,
    /// The point at which the integration failed, if its normal traction fell to zero or its state in a process did not converge.
    #[serde(skip)]
    pub opens: Option<usize>,
    /// The point that outran shear waves beyond the last state, if that ended the run.
    #[serde(skip)]
    pub outrun: Option<Outrun>,
}

/// A point that slips faster than shear waves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outrun {
    /// Point.
    pub point: usize,
    /// Its slip rate in the state that was not kept \[m/s\].
    pub rate: f64,
}

/// A run of faults. Source [`ALL`] of its events is all faults together; where there are several, source 1 + k is fault k.
pub type FaultRun = Run<Rupture, Progress>;

/// Runs of faults, as a kind of run for observers.
#[derive(Clone, Copy, Debug)]
pub struct Faults;

impl Kind for Faults {
    type Setup = ();
    type Moment<'a> = Moment<'a>;
    type ResumeState = FaultRun;
}

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
            Progress {
                detectors,
                processes: Vec::new(),
                episodes: Vec::new(),
                slow: None,
                opens: None,
                outrun: None,
            },
        )
    }

    /// Adds sources of slow events, one of each fault, which begin and end at these lower slip rates.
    #[must_use]
    pub fn and_slow(mut self, thresholds: Thresholds) -> Self {
        let first = self.catalogue.sources();
        let faults = if first > 1 { &self.progress.detectors[1..] } else { &self.progress.detectors[..] };
        let slow: Vec<_> = faults.iter().map(|d| Detector::new(d.points(), thresholds)).collect();
        self.catalogue.add(slow.len());
        self.progress.detectors.extend(slow);
        self.progress.slow = Some(first);
        self
    }

    /// Number of sources of events that are not slow: all faults together and, where there are several, each fault.
    #[must_use]
    pub fn sources(&self) -> usize {
        self.progress.slow.unwrap_or_else(|| self.catalogue.sources())
    }

    /// Finished slow events of each fault, if there are sources of them. One that became as fast as an event of the others is
    /// part of that event.
    #[must_use]
    pub fn slow(&self) -> Option<Vec<Vec<&Event<Rupture>>>> {
        let fast = self.progress.detectors.first()?.thresholds().on;
        let of = |source| self.catalogue.ended(source).iter().filter(|e| e.peak < fast).collect();
        self.progress.slow.map(|first| (first..self.catalogue.sources()).map(of).collect())
    }

    /// Slip rates \[m/s\] and normal tractions at the time that the run has reached.
    #[must_use]
    pub fn present(&self, fault: &Fault) -> (Vec<f64>, PointTractions) {
        let mut equations = Equations::new(fault, Vec::new(), Vec::new());
        equations.remember(&self.progress.processes);
        let mut rate = vec![0.0; equations.layout().m().end];
        equations.slip_rates(self.at, &self.unknowns, &mut rate);
        (rate, equations.pressed(self.at, &self.unknowns))
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

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_ode::Clock;

    #[test]
    fn a_slow_event_that_became_fast_is_not_counted_twice() {
        let (fast, slow) = (Thresholds { on: 1e-3, off: 1e-4 }, Thresholds { on: 1e-8, off: 5e-9 });
        let mut run = FaultRun::new(vec![0.0; 4], &[0..2, 2..4], fast).and_slow(slow);
        assert_eq!((run.sources(), run.catalogue.sources()), (3, 5));
        // Of the second fault: a slow event, and one that became fast.
        for (time, peak) in [(1.0, 1e-6), (5.0, 2e-3)] {
            let at = Clock::new(time, 0.0);
            run.catalogue.begin(4, at, peak, Rupture::default());
            if let Some(event) = run.catalogue.open(4) {
                event.end = Some(at.later(1.0));
            }
        }
        let slow = run.slow().unwrap();
        assert_eq!(slow.iter().map(Vec::len).collect::<Vec<_>>(), [0, 1]);
        assert_eq!(slow[1][0].peak, 1e-6);
    }
}
