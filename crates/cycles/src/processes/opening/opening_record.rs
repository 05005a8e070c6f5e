//! Statistics of openings in a run.

use crate::problem::{Account, OverEvents, Passage, ProcessRecord, Quantity};
use std::ops::Range;

/// Opening of points.
pub static OPENING: Quantity = Quantity {
    name: "opening",
    unit: "m",
    meaning: "distance by which both sides have parted",
    over_events: Some(OverEvents::Change),
};

/// Openings so far, point by point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OpeningRecord {
    /// Points that may open.
    points: Vec<usize>,
    /// Time open \[s\].
    time: Vec<f64>,
    /// Largest opening \[m\].
    largest: Vec<f64>,
    /// Time of the largest opening \[s\].
    when: Vec<f64>,
    /// Total time \[s\].
    duration: f64,
}

impl OpeningRecord {
    /// Statistics of these points, from a saved state if there is one.
    #[must_use]
    pub(super) fn new(points: &[usize], saved: Option<&ProcessRecord>) -> Self {
        let list = |k: usize| saved.map_or_else(Vec::new, |saved| saved.list(k).to_vec());
        let duration = list(3).first().copied().unwrap_or(0.0);
        Self { points: points.to_vec(), time: list(0), largest: list(1), when: list(2), duration }
    }

    /// Summary for these points.
    #[must_use]
    pub fn summary(&self, points: Range<usize>) -> Widest {
        let of = |list: &[f64], p: usize| list.get(p).copied().unwrap_or(0.0);
        let points = || points.clone();
        let point = points().max_by(|&a, &b| of(&self.largest, a).total_cmp(&of(&self.largest, b)));
        let longest = points().map(|p| of(&self.time, p)).fold(0.0, f64::max);
        Widest {
            points: points().filter(|&p| of(&self.largest, p) > 0.0).count(),
            point,
            largest: point.map_or(0.0, |p| of(&self.largest, p)),
            when: point.map_or(0.0, |p| of(&self.when, p)),
            time_share: if self.duration > 0.0 { longest / self.duration } else { 0.0 },
        }
    }
}

impl Account for OpeningRecord {
    /// Adds an accepted step. A point that is open at one end of it counts as open for half of it.
    fn step(&mut self, step: &Passage<'_>) {
        let opening = step.pressed.values(&OPENING);
        for list in [&mut self.time, &mut self.largest, &mut self.when] {
            list.resize(opening.len(), 0.0);
        }
        self.duration += step.length;
        let before = step.start.map_or(opening, |(_, pressed)| pressed.values(&OPENING));
        for &p in &self.points {
            let ends = [before[p], opening[p]];
            let open = ends.iter().filter(|o| **o > 0.0).count();
            self.time[p] += 0.5 * open as f64 * step.length;
            if ends[1] > self.largest[p] {
                (self.largest[p], self.when[p]) = (ends[1], step.at);
            }
        }
    }

    fn save(&self) -> ProcessRecord {
        ProcessRecord::new("opening", [&self.time, &self.largest, &self.when, &[self.duration]])
    }
}

/// Summary of the openings of some points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Widest {
    /// Number of points that were ever open.
    pub points: usize,
    /// The point with the largest opening.
    pub point: Option<usize>,
    /// Its largest opening \[m\].
    pub largest: f64,
    /// Time of the largest opening \[s\].
    pub when: f64,
    /// Largest share of the time during which a point was open.
    pub time_share: f64,
}
