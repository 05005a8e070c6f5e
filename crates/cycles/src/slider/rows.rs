//! Which rows a run writes.

use serde::{Deserialize, Serialize};

/// Change of ln V of which outputs show what lies between, where a scene says nothing: a twentieth of an e-fold is less than a hair
/// on a plot over sixteen decades.
pub const DEFAULT_CHANGE: f64 = 0.05;

/// Rows of histories: by change, at times, or both.
#[derive(Clone, Debug, PartialEq)]
pub struct Rows {
    /// A row of a slider is written when its ln V has changed by so much, and at its events; none: by times alone.
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
}

/// Requested times in sequence.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Due {
    /// Of the list: the next.
    listed: usize,
    /// Of the intervals: the next.
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
