//! Rows that a run writes.

use serde::{Deserialize, Serialize};

/// Default change of ln V between rows. A twentieth of an e-fold is invisible on a plot over sixteen decades.
pub const DEFAULT_CHANGE: f64 = 0.05;

/// Rows of histories: by change, at times, or both.
#[derive(Clone, Debug, PartialEq)]
pub struct Rows {
    /// Change of ln V after which a row of a slider is written, besides those at its events; none: rows at given times only.
    pub change: Option<f64>,
    /// Times at which rows are written, ascending \[s\].
    pub times: Vec<f64>,
    /// Time between rows, from 0 \[s\].
    pub interval: Option<f64>,
    /// Sliders with histories; none: all of them.
    pub histories: Option<Vec<usize>>,
}

impl Default for Rows {
    fn default() -> Self {
        Self { change: Some(DEFAULT_CHANGE), times: Vec::new(), interval: None, histories: None }
    }
}

impl Rows {
    /// True if the history of a slider is written.
    #[must_use]
    pub fn writes(&self, slider: usize) -> bool {
        self.histories.as_ref().is_none_or(|list| list.contains(&slider))
    }

    /// True if a row is requested at a time \[s\].
    pub(super) fn ask_for(&self, time: f64) -> bool {
        self.times.contains(&time) || self.interval.is_some_and(|dt| (time / dt).round() * dt == time)
    }
}

/// Requested times in sequence.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Due {
    /// Next of the list.
    listed: usize,
    /// Next of the intervals.
    interval: u64,
}

impl Due {
    /// Takes the next requested time up to `until`.
    pub fn next(&mut self, rows: &Rows, until: f64) -> Option<f64> {
        let listed = rows.times.get(self.listed).copied().unwrap_or(f64::INFINITY);
        let regular = rows.interval.map_or(f64::INFINITY, |dt| dt * self.interval as f64);
        let next = listed.min(regular);
        if next > until {
            return None;
        }
        self.listed += usize::from(listed == next);
        self.interval += u64::from(regular == next);
        Some(next)
    }
}
