//! Axis of time along the rows of a table, which are closest where most happens.

use super::axes::{Axis, Frame};
use super::colour::{INK, Rgb};
use super::figure::{Anchor, Figure};
use crate::units::{TIME, Unit};

/// Distance between ticks, as a share of the axis.
const APART: f64 = 0.11;
/// Least distance between ticks, for a time of some digits with its unit.
const LABEL: f64 = 66.0;
/// Number of ticks of a run without events.
const EVEN: usize = 6;
/// Digits of the latest time.
const DIGITS: i32 = 4;
/// Digits of a time since another.
const SINCE: i32 = 3;
/// Colours of marks over an image, light on dark, so that they are seen on any of its colours.
const OVER: [Rgb; 2] = [INK, [255, 255, 255]];
/// Widths of lines of these colours.
const WIDTHS: [f64; 2] = [2.4, 1.0];
/// Dashes of marks.
const DASH: &[f64] = &[3.0, 3.0];
/// Em size of the numbers of events.
const NUMBER: f64 = 12.0;
/// Distance between numbers of events, as a share of the axis.
const NUMBERS_APART: f64 = 0.03;

/// Rows of a table along an axis, and the rows in which events begin and end.
pub(super) struct StretchedAxis {
    /// Times of the rows, ascending \[s\].
    times: Vec<f64>,
    /// Positions of onset and end of each event along the axis.
    events: Vec<[f64; 2]>,
    unit: Unit,
}

impl StretchedAxis {
    /// Axis of rows at these times \[s\], with the times of onset and end of events \[s\].
    pub(super) fn new(times: &[f64], events: &[[f64; 2]]) -> Self {
        let place = |time: f64| {
            let row = times.partition_point(|&t| t < time);
            row as f64 / times.len().max(1) as f64
        };
        let events = events.iter().map(|times| times.map(place)).collect();
        let latest = times.iter().fold(0.0_f64, |most, t| most.max(t.abs()));
        Self { times: times.to_vec(), events, unit: TIME.choose(latest) }
    }

    /// The axis of a frame of this width, with the times of onsets, or of evenly spaced rows where there are few.
    pub(super) fn axis(&self, width: f64) -> Axis {
        let apart = APART.max(LABEL / width);
        let mut at: Vec<f64> = Vec::new();
        let even = (0..EVEN).map(|k| k as f64 / EVEN as f64);
        for place in self.events.iter().map(|e| e[0]).chain([0.0]).chain(even) {
            if place < 1.0 && at.iter().all(|other| (other - place).abs() >= apart) {
                at.push(place);
            }
        }
        at.sort_by(f64::total_cmp);
        let ticks = self.texts(&at);
        let since = if ticks.iter().any(|tick| tick.1.starts_with('+')) { "; + since the last" } else { "" };
        let label = format!("Time [{}], stretched where slip rates change{since}", self.unit.name);
        Axis { own: ticks, ..Axis::exact([0.0, 1.0], label) }
    }

    /// Ticks at ascending positions with their times. A time that would read as the one before is given as the time since
    /// that one, as in an event of seconds after years; a time that is the one before has no tick.
    fn texts(&self, at: &[f64]) -> Vec<(f64, String)> {
        let mut ticks: Vec<(f64, String)> = Vec::new();
        let mut full: Option<(f64, String)> = None;
        let mut last = f64::NEG_INFINITY;
        for &place in at {
            let time = self.time(place);
            if time <= last {
                continue;
            }
            last = time;
            let text = self.text(time);
            let text = match &full {
                Some((from, same)) if *same == text => since(time - from),
                _ => {
                    full = Some((time, text.clone()));
                    text
                }
            };
            if ticks.iter().all(|(_, other)| *other != text) {
                ticks.push((place, text));
            }
        }
        ticks
    }

    /// Time of the row at a position \[s\].
    fn time(&self, place: f64) -> f64 {
        let row = (place * self.times.len() as f64).round() as usize;
        self.times.get(row).copied().unwrap_or_default()
    }

    /// A time \[s\] as text, with as many decimals as the latest one needs.
    fn text(&self, time: f64) -> String {
        let latest = self.times.last().map_or(0.0, |t| (t / self.unit.factor).abs());
        let before = if latest > 0.0 { 1 + latest.log10().floor() as i32 } else { DIGITS };
        let decimals = (DIGITS - before).clamp(0, DIGITS) as usize;
        format!("{:.decimals$}", time / self.unit.factor)
    }

    /// Draws lines at the onset and end of each event over the image, and the numbers of events above it.
    pub(super) fn mark(&self, figure: &mut Figure, frame: &Frame) {
        let ((left, top), (width, height)) = (frame.at, frame.size);
        let mut last = f64::NEG_INFINITY;
        for (number, &[onset, end]) in self.events.iter().enumerate() {
            for place in [onset, end] {
                let x = left + place * width;
                for (colour, width) in OVER.into_iter().zip(WIDTHS) {
                    figure.dashed(vec![(x, top), (x, top + height)], DASH, width, colour);
                }
            }
            let middle = 0.5 * (onset + end);
            if middle - last >= NUMBERS_APART {
                // Inside the frame, on a field of its own.
                let text = (number + 1).to_string();
                let half = 0.5 * (0.64 * NUMBER * text.chars().count() as f64 + 4.0);
                let x = (left + middle * width).clamp(left + half, left + width - half);
                let (above, below) = (top + 2.0, top + NUMBER + 4.0);
                figure.area(
                    vec![(x - half, above), (x + half, above), (x + half, below), (x - half, below)],
                    OVER[0],
                );
                figure.text((x, 0.5 * (above + below)), text, NUMBER, Anchor::Middle, OVER[1]);
                last = middle;
            }
        }
    }
}

/// A time since another \[s\], with its unit.
fn since(time: f64) -> String {
    let unit = TIME.choose(time);
    let value = time / unit.factor;
    let decimals = (SINCE - 1 - value.log10().floor() as i32).clamp(0, SINCE) as usize;
    format!("+{value:.decimals$} {}", unit.name)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Width of a frame in which all ticks fit.
    const WIDTH: f64 = 900.0;

    #[test]
    fn ticks_of_a_narrow_frame_are_as_far_apart_as_their_labels_are_long() {
        let times: Vec<f64> = (0..100).map(f64::from).collect();
        for width in [200.0, 290.0, 420.0, 900.0] {
            let axis = StretchedAxis::new(&times, &[[30.0, 40.0], [55.0, 60.0]]).axis(width);
            let apart = |pair: &[(f64, String)]| (pair[1].0 - pair[0].0) * width;
            assert!(axis.own.windows(2).all(|pair| apart(pair) >= LABEL - 1e-9), "{width}: {:?}", axis.own);
        }
    }

    #[test]
    fn ticks_have_the_times_of_onsets_and_lie_apart() {
        const YEAR: f64 = 31_557_600.0;
        let times: Vec<f64> = (0..100).map(|k| f64::from(k) * YEAR).collect();
        let onsets = [30.0, 31.0, 60.0].map(|k| [k * YEAR, (k + 2.0) * YEAR]);
        let axis = StretchedAxis::new(&times, &onsets).axis(WIDTH);
        assert_eq!(axis.label, "Time [yr], stretched where slip rates change");
        let texts: Vec<&str> = axis.own.iter().map(|t| t.1.as_str()).collect();
        assert_eq!(texts, ["0.00", "17.00", "30.00", "60.00", "83.00"]);
        assert!(axis.own.windows(2).all(|pair| pair[1].0 - pair[0].0 >= APART), "{:?}", axis.own);
    }

    #[test]
    fn a_run_without_events_or_rows_has_an_axis() {
        // Four rows have four times, however many ticks would fit.
        assert_eq!(StretchedAxis::new(&[0.0, 1.0, 2.0, 3.0], &[]).axis(WIDTH).own.len(), 4);
        let texts: Vec<String> =
            StretchedAxis::new(&[], &[]).axis(WIDTH).own.into_iter().map(|t| t.1).collect();
        assert_eq!(texts, ["0"]);
    }

    #[test]
    fn no_two_ticks_have_the_same_label() {
        const YEAR: f64 = 31_557_600.0;
        // Events of some seconds, each with as many rows as the years before it; two rows at the same time.
        let event = |year: f64| (0..40).map(move |k| year * YEAR + 0.1 * f64::from(k));
        let years = |from: i32| (from..from + 10).map(|k| f64::from(k) * YEAR);
        let times: Vec<f64> = years(0)
            .chain(event(10.0))
            .chain([11.0 * YEAR; 30])
            .chain(years(12))
            .chain(event(23.0))
            .collect();
        let events = [(10.0, 1.0), (23.0, 3.9)].map(|(year, long)| [year * YEAR, year * YEAR + long]);
        for events in [&events[..], &events[..1], &[]] {
            let axis = StretchedAxis::new(&times, events).axis(WIDTH);
            let texts: Vec<&str> = axis.own.iter().map(|t| t.1.as_str()).collect();
            let mut once = texts.clone();
            once.sort_unstable();
            once.dedup();
            assert_eq!(once.len(), texts.len(), "{texts:?}");
            assert!(texts.iter().any(|t| t.starts_with('+') && t.ends_with(" s")), "{texts:?}");
            assert!(axis.label.ends_with("; + since the last"), "{}", axis.label);
        }
    }
}
