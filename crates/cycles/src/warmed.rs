//! Largest temperatures and pore pressures during a run.

use super::moment::Moment;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Largest temperatures and pressures so far, point by point; no values without heat.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Warmed {
    /// Largest temperature \[K\]; 0 at points that are not heated.
    temperature: Vec<f64>,
    /// Time of it \[s\].
    when: Vec<f64>,
    /// Largest pore pressure in excess of that at the start \[Pa\].
    pressure: Vec<f64>,
}

impl Warmed {
    /// Adds the end of an accepted step.
    pub(crate) fn step(&mut self, moment: &Moment<'_>) {
        let surface = &moment.pressed.surface;
        for list in [&mut self.temperature, &mut self.when, &mut self.pressure] {
            list.resize(surface.temperature.len(), 0.0);
        }
        for (p, &temperature) in surface.temperature.iter().enumerate() {
            if temperature > self.temperature[p] {
                (self.temperature[p], self.when[p]) = (temperature, moment.at.seconds());
            }
            self.pressure[p] = self.pressure[p].max(surface.pressure[p]);
        }
    }

    /// Summary for these points, with the number of those that exceeded a temperature \[K\].
    #[must_use]
    pub fn of(&self, points: Range<usize>, limit: f64) -> Warmest {
        let of = |list: &[f64], p: usize| list.get(p).copied().unwrap_or(0.0);
        let point =
            points.clone().max_by(|&a, &b| of(&self.temperature, a).total_cmp(&of(&self.temperature, b)));
        Warmest {
            point,
            temperature: point.map_or(0.0, |p| of(&self.temperature, p)),
            when: point.map_or(0.0, |p| of(&self.when, p)),
            pressure: points.clone().map(|p| of(&self.pressure, p)).fold(0.0, f64::max),
            beyond: points.filter(|&p| of(&self.temperature, p) > limit).count(),
        }
    }
}

/// Summary of the heat of some points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Warmest {
    /// The point with the largest temperature.
    pub point: Option<usize>,
    /// The largest temperature \[K\].
    pub temperature: f64,
    /// Time of it \[s\].
    pub when: f64,
    /// The largest pore pressure in excess of that at the start \[Pa\].
    pub pressure: f64,
    /// Number of points that exceeded the limit.
    pub beyond: usize,
}
