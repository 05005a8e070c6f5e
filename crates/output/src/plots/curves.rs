//! Histories at the probes of an interface: relative displacement, friction coefficient and relative velocity over time.

use super::super::Recorder;
use super::super::record::PointHistory;
use super::axes::{Axis, Frame};
use super::colour::{INK, MARK, Rgb, of_curve};
use super::figure::{Anchor, Dash, Figure, Point};
use super::labels::position_labels;
use super::title::title;
use super::units::TIME;
use super::units::{self, Unit, Units};
use super::width::within;

/// A quantity plotted over time.
#[derive(Clone, Copy)]
pub(super) struct Quantity {
    /// Last part of its file name.
    pub file: &'static str,
    /// Name on the axis.
    name: &'static str,
    units: Units,
    /// True if a logarithmic axis is considered.
    rate: bool,
    read: fn(&PointHistory) -> &[f64],
}

/// Quantities plotted for each interface.
pub(super) const QUANTITIES: [Quantity; 3] = [
    Quantity {
        file: "relative_displacement",
        name: "Relative displacement",
        units: units::LENGTH,
        rate: false,
        read: |p| &p.relative_displacement,
    },
    Quantity {
        file: "friction",
        name: "Friction coefficient",
        units: units::NUMBER,
        rate: false,
        read: |p| &p.friction,
    },
    Quantity {
        file: "relative_velocity",
        name: "Relative velocity",
        units: units::VELOCITY,
        rate: true,
        read: |p| &p.slip_rate,
    },
];

/// Ratio of the largest to the time-weighted median velocity above which a linear axis would show only spikes.
const SPIKES: f64 = 1e3;

/// Most decades of a logarithmic axis; plate rates and seismic slip rates are about twelve decades apart.
pub(super) const DECADES: f64 = 14.0;

/// Columns into which a curve is thinned, keeping the extremes of each: twice the resolution of a screen.
const COLUMNS: usize = 2000;

/// Width right of the frame for the legend.
const LEGEND: f64 = 170.0;

/// Draws one quantity of one interface; `None` without probes or steps.
pub(super) fn history(recorder: &Recorder, interface: usize, quantity: &Quantity) -> Option<Figure> {
    let points = &recorder.histories().get(interface)?.points;
    let times = recorder.times();
    let (Some(&end), false) = (times.last(), points.is_empty()) else { return None };
    let series: Vec<&[f64]> = points.iter().map(quantity.read).collect();
    let (time, unit) = (TIME.of(end), quantity.units.of(largest(&series)));
    let log = quantity.rate && is_spiky(times, &series);
    let values = series.iter().flat_map(|s| s.iter()).map(|v| if log { v.abs() } else { *v } / unit.factor);
    let label = format!("{} [{}]", quantity.name, unit.name);
    let y = if log { Axis::logarithmic(values, DECADES, label) } else { Axis::linear(values, 0.08, label) };
    let frame = Frame {
        at: (96.0, 40.0),
        size: (560.0, 380.0),
        x: Axis::exact((0.0, end / time.factor), format!("Time [{}]", time.name)),
        y,
    };
    let mut figure = Figure::new(96.0 + 560.0 + LEGEND, 480.0);
    let mesh = &recorder.setup().interfaces[interface];
    title(&mut figure, &frame, &recorder.setup().title, &mesh.name);
    frame.grid(&mut figure);
    stage_marks(&mut figure, &frame, recorder, time);
    for (i, values) in series.iter().enumerate() {
        let colour = of_curve(i, series.len());
        for piece in pieces(times, values) {
            let line = piece.iter().map(|&(t, v)| {
                let v = if log { v.abs() } else { v };
                frame.point(t / time.factor, v / unit.factor)
            });
            figure.line(thin(line.collect()), 1.8, colour);
        }
    }
    frame.draw(&mut figure);
    let names = &recorder.setup().interfaces[interface].labels;
    let labels = if names.is_empty() {
        position_labels(points.iter().map(|p| p.position))
    } else {
        points.iter().map(|p| names[p.node].clone()).collect()
    };
    let entries = labels.into_iter().enumerate();
    let entries = entries.map(|(i, name)| Entry { name, colour: of_curve(i, series.len()), dash: &[] });
    legend(&mut figure, &frame, entries);
    Some(figure)
}

/// A curve in a legend.
#[derive(Clone, Debug)]
pub(super) struct Entry {
    pub name: String,
    pub colour: Rgb,
    pub dash: Dash,
}

/// Draws the names of the curves with their colours, right of the frame.
pub(super) fn legend(figure: &mut Figure, frame: &Frame, entries: impl Iterator<Item = Entry>) {
    let left = frame.at.0 + frame.size.0 + 16.0;
    let entries: Vec<Entry> = entries.collect();
    let room = figure.width - left - 40.0;
    let size = entries.iter().map(|e| within(&e.name, room, 12.5)).fold(12.5, f64::min);
    for (i, Entry { name, colour, dash }) in entries.into_iter().enumerate() {
        let y = frame.at.1 + 12.0 + 22.0 * i as f64;
        figure.dashed(vec![(left, y), (left + 26.0, y)], dash, 2.2, colour);
        figure.text((left + 34.0, y), name, size, Anchor::Start, INK);
    }
}

/// Draws a dashed line at the end of each stage but the last, and the names of the stages along the top.
fn stage_marks(figure: &mut Figure, frame: &Frame, recorder: &Recorder, time: Unit) {
    let (left, top) = frame.at;
    let (mut from, shown) = (0.0, frame.x.range.1);
    for (name, end) in &recorder.setup().stages {
        let to = (end / time.factor).min(shown);
        let middle = frame.x.place((from + to) / 2.0);
        // Names that do not fit their stage, at 7.5 units per character, are omitted.
        if (to - from) / shown * frame.size.0 > 7.5 * name.chars().count() as f64 {
            figure.text((left + middle * frame.size.0, top + 11.0), name, 11.5, Anchor::Middle, MARK);
        }
        if to >= shown {
            break;
        }
        let x = left + frame.x.place(to) * frame.size.0;
        figure.dashed(vec![(x, top), (x, top + frame.size.1)], &[5.0, 4.0], 1.0, MARK);
        from = to;
    }
}

fn largest(series: &[&[f64]]) -> f64 {
    let finite = series.iter().flat_map(|s| s.iter()).filter(|v| v.is_finite());
    finite.fold(0.0, |most, v| most.max(v.abs()))
}

/// True if the peak rate of the fastest point is far above its median rate over time.
pub(super) fn is_spiky(times: &[f64], series: &[&[f64]]) -> bool {
    let mut before = 0.0;
    let mut weighted: Vec<(f64, f64)> = Vec::with_capacity(times.len());
    for (i, &time) in times.iter().enumerate() {
        let fastest = series.iter().map(|s| s[i].abs()).filter(|v| v.is_finite()).fold(0.0, f64::max);
        if fastest > 0.0 {
            weighted.push((fastest, time - before));
        }
        before = time;
    }
    weighted.sort_by(|a, b| a.0.total_cmp(&b.0));
    let half = weighted.iter().map(|(_, weight)| weight).sum::<f64>() / 2.0;
    let mut sum = 0.0;
    let median = weighted.iter().find(|(_, weight)| {
        sum += weight;
        sum >= half
    });
    match (median, weighted.last()) {
        (Some((median, _)), Some((most, _))) => *most > SPIKES * median,
        _ => false,
    }
}

/// Parts of a curve with finite values.
fn pieces(times: &[f64], values: &[f64]) -> Vec<Vec<Point>> {
    let mut pieces = vec![Vec::new()];
    for (&time, &value) in times.iter().zip(values) {
        match pieces.last_mut() {
            Some(piece) if time.is_finite() && value.is_finite() => piece.push((time, value)),
            _ => pieces.push(Vec::new()),
        }
    }
    pieces.retain(|piece| !piece.is_empty());
    pieces
}

/// Thins a curve to the first, lowest, highest and last point of each column.
pub(super) fn thin(points: Vec<Point>) -> Vec<Point> {
    if points.len() <= 2 * COLUMNS {
        return points;
    }
    let mut thinner = Thinner::new(points[0].0, points[points.len() - 1].0);
    points.into_iter().for_each(|p| thinner.push(p));
    thinner.finish()
}

/// Largest number of points collected in a column before it is reduced to its extremes.
const GROUP: usize = 4096;

/// Thins a curve point by point.
#[derive(Debug)]
pub(super) struct Thinner {
    left: f64,
    width: f64,
    group: Vec<Point>,
    kept: Vec<Point>,
}

impl Thinner {
    /// Thinner of a curve from `left` to `right`.
    pub(super) fn new(left: f64, right: f64) -> Self {
        Self { left, width: right - left, group: Vec::new(), kept: Vec::new() }
    }

    fn column(&self, x: f64) -> usize {
        ((x - self.left) / self.width * COLUMNS as f64) as usize
    }

    pub(super) fn push(&mut self, point: Point) {
        if self.group.last().is_some_and(|last| self.column(last.0) != self.column(point.0)) {
            self.kept.extend(extremes(&self.group));
            self.group.clear();
        } else if self.group.len() >= GROUP {
            self.group = extremes(&self.group);
        }
        self.group.push(point);
    }

    pub(super) fn finish(mut self) -> Vec<Point> {
        self.kept.extend(extremes(&self.group));
        self.kept
    }
}

/// First, lowest, highest and last point of a group.
fn extremes(group: &[Point]) -> Vec<Point> {
    if group.is_empty() {
        return Vec::new();
    }
    let index = |pick: fn(f64, f64) -> bool| {
        (0..group.len()).fold(0, |best, i| if pick(group[i].1, group[best].1) { i } else { best })
    };
    let mut keep = vec![0, index(|a, b| a < b), index(|a, b| a > b), group.len() - 1];
    keep.sort_unstable();
    keep.dedup();
    keep.into_iter().map(|i| group[i]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thinning_keeps_ends_and_extremes() {
        let mut points: Vec<Point> =
            (0..100_000).map(|i| (f64::from(i), (f64::from(i) * 0.01).sin())).collect();
        points[54_321].1 = 9.0;
        points[12_345].1 = -9.0;
        let thinned = thin(points.clone());
        assert!(thinned.len() <= 4 * COLUMNS + 4);
        assert!(thinned.windows(2).all(|pair| pair[0].0 < pair[1].0));
        for i in [0, 12_345, 54_321, 99_999] {
            assert!(thinned.contains(&points[i]));
        }
    }

    #[test]
    fn a_curve_is_cut_where_it_is_not_finite() {
        let cut = pieces(&[0.0, 1.0, 2.0, 3.0], &[1.0, f64::NAN, 2.0, 3.0]);
        assert_eq!(cut, [vec![(0.0, 1.0)], vec![(2.0, 2.0), (3.0, 3.0)]]);
    }

    #[test]
    fn rare_events_ask_for_a_logarithmic_axis_and_steady_sliding_does_not() {
        let times: Vec<f64> = (1..=100).map(f64::from).collect();
        let steady: Vec<f64> = times.iter().map(|t| 1.0 - (-t / 20.0).exp()).collect();
        let events: Vec<f64> = (1..=100).map(|i| if i % 40 == 0 { 1.0 } else { 1e-9 }).collect();
        assert!(!is_spiky(&times, &[&steady]));
        assert!(is_spiky(&times, &[&events]));
    }
}
