//! Largest temperatures and pore pressures during a run.

use super::quantities::{PRESSURE, TEMPERATURE};
use crate::problem::{Account, Passage, ProcessRecord};
use std::ops::Range;

/// Largest temperatures and pressures so far, point by point; no values without heat.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HeatRecord {
    /// Largest temperature \[K\]; 0 at points that are not heated.
    temperature: Vec<f64>,
    /// Time of it \[s\].
    when: Vec<f64>,
    /// Largest pore pressure in excess of that at the start \[Pa\].
    pressure: Vec<f64>,
}

impl HeatRecord {
    /// Statistics from a saved state, if there is one.
    #[must_use]
    pub(super) fn new(saved: Option<&ProcessRecord>) -> Self {
        let [temperature, when, pressure] =
            [0, 1, 2].map(|k| saved.map_or_else(Vec::new, |saved| saved.list(k).to_vec()));
        Self { temperature, when, pressure }
    }

    /// Summary for these points, with the number of those that exceeded a temperature \[K\].
    #[must_use]
    pub fn summary(&self, points: Range<usize>, limit: f64) -> Warmest {
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

impl Account for HeatRecord {
    fn step(&mut self, step: &Passage<'_>) {
        let [temperatures, pressures] =
            [&TEMPERATURE, &PRESSURE].map(|quantity| step.pressed.values(quantity));
        for list in [&mut self.temperature, &mut self.when, &mut self.pressure] {
            list.resize(temperatures.len(), 0.0);
        }
        for (p, &temperature) in temperatures.iter().enumerate() {
            if temperature > self.temperature[p] {
                (self.temperature[p], self.when[p]) = (temperature, step.at);
            }
            self.pressure[p] = self.pressure[p].max(pressures[p]);
        }
    }

    fn save(&self) -> ProcessRecord {
        ProcessRecord::new("heat", [&self.temperature, &self.when, &self.pressure])
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
