//! Openings during a run.

use super::moment::Moment;
use super::problem::Problem;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Openings so far, point by point.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Opened {
    /// Time open \[s\].
    time: Vec<f64>,
    /// Largest opening \[m\].
    largest: Vec<f64>,
    /// Time of the largest opening \[s\].
    when: Vec<f64>,
    /// Total time \[s\].
    duration: f64,
}

impl Opened {
    /// Adds an accepted step. A point that is open at one end of it counts as open for half of it.
    pub(crate) fn step(&mut self, problem: &Problem, moment: &Moment<'_>) {
        let Some(opening) = &problem.fault.opening else { return };
        for list in [&mut self.time, &mut self.largest, &mut self.when] {
            list.resize(problem.areas.len(), 0.0);
        }
        self.duration += moment.dt;
        let before = moment.step.as_ref().map_or(moment.pressed, |step| step.start_pressed);
        for &p in opening.points() {
            let ends = [before.opening[p], moment.pressed.opening[p]];
            let open = ends.iter().filter(|o| **o > 0.0).count();
            self.time[p] += 0.5 * open as f64 * moment.dt;
            if ends[1] > self.largest[p] {
                (self.largest[p], self.when[p]) = (ends[1], moment.at.seconds());
            }
        }
    }

    /// Summary for these points.
    #[must_use]
    pub fn of(&self, points: Range<usize>) -> Widest {
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
