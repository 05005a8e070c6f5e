//! Use of the floors of normal traction during a run.

use crate::problem::{Account, Components, Passage, ProcessRecord, Quantity};
use std::ops::Range;

/// Normal tractions of the bodies, less the pressure of fluid, before the floor.
pub static BODIES: Quantity = Quantity {
    name: "bodies",
    unit: "Pa",
    meaning: "normal traction of the bodies, less the pressure of fluid; 0 where a point is open",
    over_events: None,
};

/// Use of the floors so far, point by point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FloorRecord {
    /// Floors \[Pa\]; minus infinity where there is none.
    least: Vec<f64>,
    /// Time below the floor \[s\].
    time: Vec<f64>,
    /// Slip below it \[m\].
    slip: Vec<f64>,
    /// Largest amount by which the normal traction of the bodies fell below the floor \[Pa\].
    below: Vec<f64>,
    /// Number of events during which a point was below its floor.
    events: usize,
    /// True if a point was below its floor in the current event.
    now: bool,
    /// Total slip \[m\].
    whole: Vec<f64>,
    /// Total time \[s\].
    duration: f64,
}

impl FloorRecord {
    /// Use of these floors, from a saved state if there is one.
    #[must_use]
    pub(super) fn new(least: Vec<f64>, saved: Option<&ProcessRecord>) -> Self {
        let Some(saved) = saved else { return Self { least, ..Self::default() } };
        let [time, slip, below, whole] = [0, 1, 2, 3].map(|k| saved.list(k).to_vec());
        let [events, now, duration] = [0, 1, 2].map(|k| saved.list(4).get(k).copied().unwrap_or(0.0));
        Self { least, time, slip, below, events: events as usize, now: now != 0.0, whole, duration }
    }

    /// Use of the floor at these points; `areas` holds the tributary areas of all points.
    #[must_use]
    pub fn summary(&self, points: Range<usize>, areas: &[f64]) -> FloorSummary {
        let of = |list: &[f64], p: usize| list.get(p).copied().unwrap_or(0.0);
        let points = || points.clone();
        let longest = points().max_by(|&a, &b| of(&self.time, a).total_cmp(&of(&self.time, b)));
        let over = |list: &[f64]| points().map(|p| of(list, p) * areas[p]).sum::<f64>();
        let share = |part: f64, whole: f64| if whole > 0.0 { part / whole } else { 0.0 };
        FloorSummary {
            points: points().filter(|&p| of(&self.time, p) > 0.0).count(),
            longest,
            time_share: share(longest.map_or(0.0, |p| of(&self.time, p)), self.duration),
            slip_share: share(over(&self.slip), over(&self.whole)),
            deepest: points().map(|p| of(&self.below, p)).fold(0.0, f64::max),
            events: self.events,
        }
    }
}

impl Account for FloorRecord {
    fn step(&mut self, step: &Passage<'_>) {
        let Some((start, before)) = step.start else { return };
        let n = self.least.len();
        for list in [&mut self.time, &mut self.slip, &mut self.below, &mut self.whole] {
            list.resize(n, 0.0);
        }
        self.duration += step.length;
        let by: Vec<f64> = step.slip.all().iter().zip(start.all()).map(|(b, a)| b - a).collect();
        let by = Components::new(by, n);
        let ends = [before, step.pressed].map(|pressed| pressed.values(&BODIES));
        let mut any = false;
        for p in 0..n {
            let least = self.least[p];
            let missing = ends.map(|bodies| least - bodies[p]);
            let slip = by.size(p);
            self.whole[p] += slip;
            // Normal tractions are taken as linear within the step.
            let share = match missing.map(|m| m > 0.0) {
                [true, true] => 1.0,
                [false, false] => continue,
                [first, _] => missing[usize::from(!first)] / (missing[0] - missing[1]).abs(),
            };
            any = true;
            self.time[p] += share * step.length;
            self.slip[p] += share * slip;
            self.below[p] = self.below[p].max(missing[1]);
        }
        self.now |= any && step.in_event;
        if step.ended {
            self.events += usize::from(self.now);
            self.now = false;
        }
    }

    fn save(&self) -> ProcessRecord {
        let rest = [self.events as f64, f64::from(u8::from(self.now)), self.duration];
        ProcessRecord::new("floor", [&self.time, &self.slip, &self.below, &self.whole, &rest])
    }
}

/// Use of the floor at a set of points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FloorSummary {
    /// Number of points that were ever below it.
    pub points: usize,
    /// The point that was below it longest.
    pub longest: Option<usize>,
    /// Share of the time which that point spent below it.
    pub time_share: f64,
    /// Share of the total slip, integrated over the area, that took place below it.
    pub slip_share: f64,
    /// Largest amount by which the normal traction of the bodies fell below the floor \[Pa\].
    pub deepest: f64,
    /// Number of events, of all faults, during which any point was below it.
    pub events: usize,
}
