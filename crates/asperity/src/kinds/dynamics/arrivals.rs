//! Rupture times: when the slip rate of each point first reaches a threshold.

use asperity_friction::points::Components;
use asperity_output::OutputFile;
use asperity_output::tables::column::{self, Column, Sign};
use serde::{Deserialize, Serialize};

/// The table at the end.
pub(super) const FILE: OutputFile =
    OutputFile::new("rupture_times.csv", "rupture time and largest slip rate of each point");

/// Rupture times so far.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Arrivals {
    /// Time of each point \[s\]; `None` where it has not ruptured.
    pub times: Vec<Option<f64>>,
    /// Largest slip rate of each point \[m/s\].
    pub fastest: Vec<f64>,
    /// Time and slip rates of the step before.
    before: (f64, Vec<f64>),
}

impl Arrivals {
    /// None so far, at this many points.
    pub fn new(points: usize) -> Self {
        Self { times: vec![None; points], fastest: vec![0.0; points], before: (0.0, vec![0.0; points]) }
    }

    /// Sees the slip rates at a time. Between two steps the rate is taken as linear.
    pub fn see(&mut self, time: f64, rates: &Components<Vec<f64>>, threshold: f64) {
        let (earlier, old) = (self.before.0, &mut self.before.1);
        for (point, arrival) in self.times.iter_mut().enumerate() {
            let (rate, was) = (rates.size(point), old[point]);
            if arrival.is_none() && rate >= threshold {
                let share = if rate > was { ((threshold - was) / (rate - was)).max(0.0) } else { 1.0 };
                *arrival = Some(earlier + share * (time - earlier));
            }
            self.fastest[point] = self.fastest[point].max(rate);
            old[point] = rate;
        }
        self.before.0 = time;
    }
}

/// Columns of the table of rupture times.
pub(super) fn columns() -> Vec<Column> {
    let fault = Column::new("fault", "", Sign::None, "fault of the point");
    let time = Column::new("time", "s", Sign::None, "time at which the point ruptured; NaN without rupture");
    let rate = Column::new("largest slip_rate", "m/s", Sign::Size, "largest slip rate");
    [fault].into_iter().chain(column::position()).chain([time, rate]).collect()
}
