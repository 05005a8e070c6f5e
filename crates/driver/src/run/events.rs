//! Events of interfaces, in the form of those of faults: detected by the slip rate of the fastest point, and located within steps.

use crate::plan::{EventPlan, Plan};
use asperity_contact::Interface;
use asperity_cycles::{ALL, Catalogue, Components, Detector, Rupture, Values};
use asperity_mechanics::Assembled;
use asperity_ode::Clock;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Values of all points of the interfaces that have events.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Moment {
    /// Time \[s\].
    time: f64,
    /// Magnitudes of slip rates \[m/s\].
    rate: Vec<f64>,
    /// Slip, component by component \[m\].
    slip: Vec<f64>,
    /// Friction without the part that is radiated, component by component \[Pa\].
    shear: Vec<f64>,
}

impl Moment {
    /// Present values. Without a law a point has no rate, so that frictionless stages have no events.
    pub fn of<const D: usize>(plan: &Plan<D>, events: &EventPlan, system: &Assembled<'_, D>) -> Self {
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
pub(super) struct Events {
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
                let share = Share::new(detector.passed(crossing).0, (from, to));
                let at = Clock::new(before.time, share.time * (after.time - before.time));
                let n = after.rate.len();
                let between = |a: &[f64], b: &[f64], s: f64| -> Vec<f64> {
                    a.iter().zip(b).map(|(a, b)| a + s * (b - a)).collect()
                };
                let slip = between(&before.slip, &after.slip, share.slip);
                let shear = between(&before.shear, &after.shear, share.time);
                let values = Values {
                    slip: Components::new(&slip, n),
                    shear: Components::new(&shear, n),
                    opening: &[],
                };
                detector.pass((&mut self.catalogue, source), crossing, (at, fastest), values);
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
struct Share {
    time: f64,
    /// Share of the slip.
    slip: f64,
}

impl Share {
    fn new(passed: f64, (from, to): (f64, f64)) -> Self {
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

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_cycles::Thresholds;

    /// A point whose rate is exp(t) times 1e-6 m/s for 20 s and falls again likewise, in steps of `dt`.
    fn hill(dt: f64) -> Events {
        let thresholds = Thresholds { on: 1e-3, off: 1e-4 };
        let plan = EventPlan {
            thresholds,
            stop_after: None,
            interfaces: vec![0],
            points: std::iter::once(0..1).collect(),
            ground: Vec::new(),
        };
        let rate = |t: f64| 1e-6 * (if t <= 20.0 { t } else { 40.0 - t }).exp();
        let slip = |t: f64| if t <= 20.0 { rate(t) - 1e-6 } else { 2.0 * rate(20.0) - rate(t) - 1e-6 };
        let at = |t: f64| Moment { time: t, rate: vec![rate(t)], slip: vec![slip(t)], shear: vec![-t] };
        let mut events = Events::new(&plan);
        let steps = (40.0 / dt).round() as usize;
        for k in 0..steps {
            events.step(&at(k as f64 * dt), &at((k + 1) as f64 * dt));
        }
        events
    }

    #[test]
    fn an_event_is_located_within_steps() {
        for dt in [0.01, 0.7, 2.0] {
            let events = hill(40.0 / (40.0_f64 / dt / 2.0).round() / 2.0);
            let [event] = events.catalogue.ended(ALL) else { panic!("one event") };
            let (onset, end) = (1e3_f64.ln(), 40.0 - 1e2_f64.ln());
            assert!((event.onset.seconds() - onset).abs() < 1e-9, "{dt}: {event:?}");
            assert!((event.end.unwrap().seconds() - end).abs() < 1e-9, "{dt}");
            assert!((event.peak / (1e-6 * 20.0_f64.exp()) - 1.0).abs() < 1e-12);
            assert!((event.details.above - (40.0 - 2.0 * onset)).abs() < 1e-9);
            let slip = 2e-6 * 20.0_f64.exp() - 1e-4 - 1e-3;
            assert!((event.details.slip.all()[0] / slip - 1.0).abs() < 1e-9);
            assert!((event.details.drop.all()[0] - (end - onset)).abs() < 1e-9);
        }
    }

    #[test]
    fn a_threshold_outside_a_step_is_passed_at_its_end() {
        for (passed, rates, expected) in
            [(1.0, (2.0, 3.0), 0.0), (1.0, (0.1, 0.5), 1.0), (1.0, (0.0, 2.0), 1.0)]
        {
            let share = Share::new(passed, rates);
            assert_eq!((share.time, share.slip), (expected, expected), "{rates:?}");
        }
    }
}
