//! Times at which the points of an event first reach a slip rate, and their largest slip rates.

use crate::problem::Components;
use serde::{Deserialize, Serialize};

/// Rupture times and largest slip rates of the points of an event; empty before its first step.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Front {
    /// Time since the onset at which each point first reached the rate of rupture \[s\]; none where it did not.
    pub reached: Vec<Option<f64>>,
    /// Largest slip rate of each point at the ends of steps \[m/s\].
    pub peaks: Vec<f64>,
}

/// A step of an event.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stride<'a> {
    /// Its start, counted from the onset of the event, which may lie within it \[s\].
    pub start: f64,
    /// Its length \[s\].
    pub length: f64,
    /// Slip rates at its start and end \[m/s\].
    pub rates: [Components<&'a [f64]>; 2],
}

impl Front {
    /// True if no step has been seen.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.peaks.is_empty()
    }

    /// Sees a step; `rate` is the slip rate at which points rupture \[m/s\].
    pub(crate) fn see(&mut self, stride: Stride<'_>, rate: f64) {
        let Stride { start, length, rates: [first, last] } = stride;
        self.reached.resize(last.points(), None);
        self.peaks.resize(last.points(), 0.0);
        for p in 0..last.points() {
            let (before, after) = (first.size(p), last.size(p));
            self.peaks[p] = self.peaks[p].max(after);
            if self.reached[p].is_none() {
                // A point that was as fast before the onset has ruptured with it.
                let at = passed(before, after, rate).map(|share| (start + share * length).max(0.0));
                self.reached[p] = at;
            }
        }
    }
}

/// Share of a step after which a slip rate reaches `rate`; its logarithm is linear over the step. None if it does not reach it.
fn passed(before: f64, after: f64, rate: f64) -> Option<f64> {
    if before >= rate {
        return Some(0.0);
    }
    if after < rate {
        return None;
    }
    // A point that did not slip at all reaches any rate at the end.
    let share = (rate / before).ln() / (after / before).ln();
    Some(if share.is_finite() { share } else { 1.0 })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stride<'a>(start: f64, rates: [&'a [f64]; 2]) -> Stride<'a> {
        Stride { start, length: 2.0, rates: rates.map(|r| Components::new(r, r.len())) }
    }

    #[test]
    fn a_rate_that_grows_exponentially_is_passed_where_it_is() {
        let mut front = Front::default();
        // Rates exp(k t) of three points from t = 1 on, and one that is too slow.
        let of = |t: f64| [0.5, 1.0, 2.0, 0.1].map(|k: f64| (k * t).exp());
        let (first, last) = (of(1.0), of(3.0));
        front.see(stride(1.0, [&first, &last]), 4.0);
        let expected = [4f64.ln() / 0.5, 4f64.ln(), 1.0];
        for (found, expected) in front.reached.iter().zip(expected) {
            assert!((found.unwrap() - expected).abs() < 1e-12, "{found:?} {expected}");
        }
        assert_eq!((front.reached[3], front.peaks[2]), (None, last[2]));
    }

    #[test]
    fn the_first_time_stays_and_peaks_grow() {
        let mut front = Front::default();
        for (start, rates) in [(0.0, [[0.0, 0.0], [1.0, 0.0]]), (2.0, [[1.0, 0.0], [3.0, 8.0]])] {
            front.see(stride(start, [&rates[0], &rates[1]]), 1.0);
        }
        assert_eq!(front.reached, [Some(2.0), Some(4.0)]);
        assert_eq!(front.peaks, [3.0, 8.0]);
        front.see(stride(4.0, [&[3.0, 8.0], &[0.1, 0.1]]), 1.0);
        assert_eq!(front.peaks, [3.0, 8.0]);
    }
}
