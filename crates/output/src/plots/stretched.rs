//! Axis of time along the rows of a table, which are closest where most happens.

use super::axes::{Axis, Frame};
use super::colour::Rgb;
use super::figure::{Anchor, Figure};
use super::units::{TIME, Unit};

/// Distance between ticks, as a share of the axis.
const APART: f64 = 0.11;
/// Number of ticks of a run without events.
const EVEN: usize = 6;
/// Digits of the latest time.
const DIGITS: i32 = 4;
/// Colour of marks over an image.
const OVER: Rgb = [255, 255, 255];
/// Dashes of marks.
const DASH: &[f64] = &[3.0, 3.0];
/// Em size of the numbers of events.
const NUMBER: f64 = 12.0;
/// Distance between numbers of events, as a share of the axis.
const NUMBERS_APART: f64 = 0.03;

/// Rows of a table along an axis, and the rows in which events begin and end.
pub(super) struct Stretched {
    /// Times of the rows, ascending \[s\].
    times: Vec<f64>,
    /// Positions of onset and end of each event along the axis.
    events: Vec<(f64, f64)>,
    unit: Unit,
}

impl Stretched {
    /// Axis of rows at these times \[s\], with the times of onset and end of events \[s\].
    pub(super) fn new(times: &[f64], events: &[(f64, f64)]) -> Self {
        let place = |time: f64| {
            let row = times.partition_point(|&t| t < time);
            row as f64 / times.len().max(1) as f64
        };
        let events = events.iter().map(|&(onset, end)| (place(onset), place(end))).collect();
        let latest = times.iter().fold(0.0_f64, |most, t| most.max(t.abs()));
        Self { times: times.to_vec(), events, unit: TIME.of(latest) }
    }

    /// The axis, with the times of onsets, or of evenly spaced rows where there are few.
    pub(super) fn axis(&self) -> Axis {
        let mut at: Vec<f64> = Vec::new();
        let even = (0..EVEN).map(|k| k as f64 / EVEN as f64);
        for place in self.events.iter().map(|e| e.0).chain([0.0]).chain(even) {
            if place < 1.0 && at.iter().all(|other| (other - place).abs() >= APART) {
                at.push(place);
            }
        }
        at.sort_by(f64::total_cmp);
        let label = format!("Time [{}], stretched where slip rates change", self.unit.name);
        let ticks = at.into_iter().map(|place| (place, self.text(place))).collect();
        Axis { own: ticks, ..Axis::exact((0.0, 1.0), label) }
    }

    /// Time at a position, as text.
    fn text(&self, place: f64) -> String {
        let row = (place * self.times.len() as f64).round() as usize;
        let time = |row: usize| self.times.get(row).map_or(0.0, |t| t / self.unit.factor);
        let latest = time(self.times.len().saturating_sub(1)).abs();
        let before = if latest > 0.0 { 1 + latest.log10().floor() as i32 } else { DIGITS };
        let decimals = (DIGITS - before).clamp(0, DIGITS) as usize;
        format!("{:.decimals$}", time(row))
    }

    /// Draws lines at the onset and end of each event over the image, and the numbers of events above it.
    pub(super) fn mark(&self, figure: &mut Figure, frame: &Frame) {
        let ((left, top), (width, height)) = (frame.at, frame.size);
        let mut last = f64::NEG_INFINITY;
        for (number, &(onset, end)) in self.events.iter().enumerate() {
            for place in [onset, end] {
                let x = left + place * width;
                figure.dashed(vec![(x, top), (x, top + height)], DASH, 1.0, OVER);
            }
            let middle = 0.5 * (onset + end);
            if middle - last >= NUMBERS_APART {
                let at = (left + middle * width, top + NUMBER);
                figure.text(at, (number + 1).to_string(), NUMBER, Anchor::Middle, OVER);
                last = middle;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_have_the_times_of_onsets_and_lie_apart() {
        const YEAR: f64 = 31_557_600.0;
        let times: Vec<f64> = (0..100).map(|k| f64::from(k) * YEAR).collect();
        let onsets = [30.0, 31.0, 60.0].map(|k| (k * YEAR, (k + 2.0) * YEAR));
        let axis = Stretched::new(&times, &onsets).axis();
        assert_eq!(axis.label, "Time [yr], stretched where slip rates change");
        let texts: Vec<&str> = axis.own.iter().map(|t| t.1.as_str()).collect();
        assert_eq!(texts, ["0.00", "17.00", "30.00", "60.00", "83.00"]);
        assert!(axis.own.windows(2).all(|pair| pair[1].0 - pair[0].0 >= APART), "{:?}", axis.own);
    }

    #[test]
    fn a_run_without_events_or_rows_has_an_axis() {
        assert_eq!(Stretched::new(&[0.0, 1.0, 2.0, 3.0], &[]).axis().own.len(), EVEN);
        assert!(Stretched::new(&[], &[]).axis().own.iter().all(|t| t.1 == "0"));
    }
}
