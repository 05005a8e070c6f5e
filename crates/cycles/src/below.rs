//! Use of floors of normal traction in a run.

use super::components::Components;
use super::moment::Moment;
use super::problem::Problem;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Use of floors until now, point by point.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Used {
    /// Time below the floor \[s\].
    time: Vec<f64>,
    /// Slip below it \[m\].
    slip: Vec<f64>,
    /// Lowest excess pressure of the bodies below it \[Pa\].
    below: Vec<f64>,
    /// Events in which a point was below its floor.
    events: usize,
    /// True if one was in the event under way.
    now: bool,
    /// Whole slip \[m\].
    whole: Vec<f64>,
    /// Whole time \[s\].
    duration: f64,
}

impl Used {
    /// Takes note of a step.
    pub(crate) fn step(&mut self, problem: &Problem, moment: &Moment<'_>, ended: bool) {
        let (Some(floor), Some(step)) = (&problem.fault.floor, &moment.step) else { return };
        let n = problem.areas.len();
        for list in [&mut self.time, &mut self.slip, &mut self.below, &mut self.whole] {
            list.resize(n, 0.0);
        }
        self.duration += moment.dt;
        let (end, start) = (moment.slip(), moment.layout.slip_of(step.start));
        let by: Vec<f64> = end.all().iter().zip(start.all()).map(|(b, a)| b - a).collect();
        let by = Components::new(by, n);
        let mut any = false;
        for p in 0..n {
            let least = floor.at(p);
            let missing = [step.start_pressed, moment.pressed].map(|pressed| least - pressed.bodies[p]);
            let slip = by.size(p);
            self.whole[p] += slip;
            // Linear within the step.
            let share = match missing.map(|m| m > 0.0) {
                [true, true] => 1.0,
                [false, false] => continue,
                [first, _] => missing[usize::from(!first)] / (missing[0] - missing[1]).abs(),
            };
            any = true;
            self.time[p] += share * moment.dt;
            self.slip[p] += share * slip;
            self.below[p] = self.below[p].max(missing[1]);
        }
        let in_event = ended || moment.under_way().is_some();
        self.now |= any && in_event;
        if ended {
            self.events += usize::from(self.now);
            self.now = false;
        }
    }

    /// Use of the floor of these points, which have the tributary areas `areas` among those of all.
    #[must_use]
    pub fn of(&self, points: Range<usize>, areas: &[f64]) -> Below {
        let of = |list: &[f64], p: usize| list.get(p).copied().unwrap_or(0.0);
        let points = || points.clone();
        let longest = points().max_by(|&a, &b| of(&self.time, a).total_cmp(&of(&self.time, b)));
        let over = |list: &[f64]| points().map(|p| of(list, p) * areas[p]).sum::<f64>();
        let share = |part: f64, whole: f64| if whole > 0.0 { part / whole } else { 0.0 };
        Below {
            points: points().filter(|&p| of(&self.time, p) > 0.0).count(),
            longest,
            time_share: share(longest.map_or(0.0, |p| of(&self.time, p)), self.duration),
            slip_share: share(over(&self.slip), over(&self.whole)),
            deepest: points().map(|p| of(&self.below, p)).fold(0.0, f64::max),
            events: self.events,
        }
    }
}

/// Use of the floor of some points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Below {
    /// Points that were below it at any time.
    pub points: usize,
    /// The point that was below it for longest.
    pub longest: Option<usize>,
    /// For what share of the time that was.
    pub time_share: f64,
    /// Share of all slip, over the area, that came about below it.
    pub slip_share: f64,
    /// Lowest excess pressure of the bodies below it \[Pa\].
    pub deepest: f64,
    /// Events, of all faults, in which any point was below.
    pub events: usize,
}
