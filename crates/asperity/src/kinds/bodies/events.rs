//! Events of interfaces, in the form of those of faults: detected by the slip rate of the fastest point, and located within steps.

use asperity_contact::Interface;
use asperity_cycles::{Components, Detector, Rupture, Values};
use asperity_mechanics::AssembledProblem;
use asperity_ode::Clock;
use asperity_plan::bodies::{EventPlan, Plan};
use asperity_run::{ALL, Catalogue};
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Values of all points of the interfaces that have events.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Moment {
    /// Time \[s\].
    pub time: f64,
    /// Magnitudes of slip rates \[m/s\].
    pub rate: Vec<f64>,
    /// Slip, component by component \[m\].
    pub slip: Vec<f64>,
    /// Friction without the part that is radiated, component by component \[Pa\].
    pub shear: Vec<f64>,
}

impl Moment {
    /// Present values. Without a law a point has no rate, so that frictionless stages have no events.
    pub fn from_system<const D: usize>(
        plan: &Plan<D>,
        events: &EventPlan,
        system: &AssembledProblem<'_, D>,
    ) -> Self {
        let own: Vec<(&Interface<D>, f64)> = events
            .interfaces
            .iter()
            .map(|&i| (&system.interfaces()[i], plan.problem.interfaces[i].damping.unwrap_or(0.0)))
            .collect();
        let rate = own.iter().flat_map(|(i, _)| {
            let acts = i.has_law();
            i.points().slip_rate.iter().map(move |v| if acts { v.abs() } else { 0.0 })
        });
        let (mut slip, mut shear) = (Vec::new(), Vec::new());
        for component in 0..if D == 2 { 1 } else { D } {
            for (i, damping) in &own {
                let p = i.points();
                // Along the tangent in two dimensions, where slip rates are signed.
                let along = |v: &[f64; D], e: &[f64; D]| match D {
                    2 => v.iter().zip(e).map(|(v, e)| v * e).sum(),
                    _ => v[component],
                };
                slip.extend(p.slip.iter().zip(&p.tangent).map(|(s, e)| along(s, e)));
                let each = p.mean_shear.iter().zip(&p.tangent).zip(p.shear_measure.iter().zip(&p.slip_rate));
                shear.extend(each.map(|((t, e), (size, v))| {
                    // Radiation is along the traction, and part of it.
                    let radiated = if *size == 0.0 { 0.0 } else { damping * v / size };
                    along(t, e) * (1.0 - radiated)
                }));
            }
        }
        Self { time: system.time(), rate: rate.collect(), slip, shear }
    }

    /// The fastest of these points and its rate \[m/s\].
    fn fastest(&self, among: Range<usize>) -> (usize, f64) {
        let start = among.start;
        let faster =
            |best: (usize, f64), p: usize| if self.rate[p] > best.1 { (p, self.rate[p]) } else { best };
        among.fold((start, 0.0), faster)
    }
}

/// Events so far, and the detectors of all interfaces together and, if there are several, of each.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Events {
    /// Events of the run.
    pub catalogue: Catalogue<Rupture>,
    detectors: Vec<Detector>,
}

impl Events {
    /// No events.
    pub fn new(plan: &EventPlan) -> Self {
        let apart = if plan.points.len() > 1 { plan.points.as_slice() } else { &[] };
        let all = 0..plan.points.last().map_or(0, |p| p.end);
        let detectors: Vec<Detector> =
            std::iter::once(&all).chain(apart).map(|p| Detector::new(p.clone(), plan.thresholds)).collect();
        Self { catalogue: Catalogue::new(detectors.len()), detectors }
    }

    /// Number of events of all interfaces together that have ended.
    pub fn ended(&self) -> usize {
        self.catalogue.ended(ALL).len()
    }

    /// Finds the onsets and ends of events within the step between two moments.
    pub fn step(&mut self, before: &Moment, after: &Moment) {
        for (source, detector) in self.detectors.iter_mut().enumerate() {
            let points = detector.points();
            let (from, (fastest, to)) = (before.fastest(points.clone()).1, after.fastest(points));
            note_peak(&mut self.catalogue, source, to);
            while let Some(crossing) = detector.crossing(to) {
                let share = Share::new(detector.passed(crossing).0, from, to);
                let at = Clock::new(before.time, share.time * (after.time - before.time));
                let n = after.rate.len();
                let between = |a: &[f64], b: &[f64], s: f64| -> Vec<f64> {
                    a.iter().zip(b).map(|(a, b)| a + s * (b - a)).collect()
                };
                let slip = between(&before.slip, &after.slip, share.slip);
                let shear = between(&before.shear, &after.shear, share.time);
                let values = Values {
                    at,
                    fastest,
                    slip: Components::new(&slip, n),
                    shear: Components::new(&shear, n),
                    fields: &[],
                };
                detector.pass(&mut self.catalogue, source, crossing, values);
                note_peak(&mut self.catalogue, source, to);
            }
        }
    }
}

fn note_peak(catalogue: &mut Catalogue<Rupture>, source: usize, largest: f64) {
    if let Some(event) = catalogue.open(source) {
        event.peak = event.peak.max(largest);
    }
}

/// Shares of a step that have passed when the largest slip rate is `passed`. Rates grow and fall exponentially within a step,
/// whose length is bounded by their change.
pub struct Share {
    /// Share of the time.
    pub time: f64,
    /// Share of the slip.
    pub slip: f64,
}

impl Share {
    /// Shares where the rate, which goes from one value to another, is `passed`.
    pub fn new(passed: f64, from: f64, to: f64) -> Self {
        let (change, part) = ((to / from).ln(), (passed / from).ln());
        let time = part / change;
        if !(time > 0.0 && time < 1.0) {
            // Passed before, by a threshold that begins or ends within the same step.
            let end = if time.is_finite() && time <= 0.0 { 0.0 } else { 1.0 };
            return Self { time: end, slip: end };
        }
        Self { time, slip: part.exp_m1() / change.exp_m1() }
    }
}
