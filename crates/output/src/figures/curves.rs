//! Histories at the probes of an interface: relative displacement, friction coefficient and relative velocity over time.

use super::axes::{Axis, Frame};
use super::colour::{MARK, curve_colour};
use super::figure::{Anchor, Dash, Figure, Point};
use super::framed_figure::FramedFigure;
use super::legend::Entry;
use super::paper::Paper;
use super::title::title;
use crate::bodies::Recorder;
use crate::labels::position_labels;
use crate::numbers;
use crate::units::{self, TIME, Unit, Units};
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Histories at the probes of an interface.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Histories {
    /// Beginning of the file names.
    pub(super) stem: String,
    /// Title of the scene.
    title: String,
    /// Name of the interface.
    name: String,
    /// Names and ends of the stages \[s\].
    stages: Vec<(String, f64)>,
    /// Times \[s\].
    times: Vec<f64>,
    /// Probes.
    points: Vec<Probe>,
    /// True if the state of the probes is log10 of θ \[s\], otherwise a state variable.
    #[serde(default)]
    theta: bool,
}

/// History at a probe.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Probe {
    label: String,
    #[serde(deserialize_with = "numbers::or_nan")]
    relative_displacement: Vec<f64>,
    #[serde(deserialize_with = "numbers::or_nan")]
    friction: Vec<f64>,
    #[serde(deserialize_with = "numbers::or_nan")]
    slip_rate: Vec<f64>,
    /// State; empty without one.
    #[serde(default, deserialize_with = "numbers::or_nan")]
    state: Vec<f64>,
    /// The state in steady state at the slip rate; empty if it is not known.
    #[serde(default, deserialize_with = "numbers::or_nan")]
    steady: Vec<f64>,
}

impl Histories {
    /// Histories of an interface of this number; `None` without probes or steps.
    pub(super) fn from_recorder(recorder: &Recorder, stem: &str, interface: usize) -> Option<Self> {
        let points = &recorder.histories().get(interface)?.points;
        if points.is_empty() || recorder.times().is_empty() {
            return None;
        }
        let setup = recorder.setup();
        let mesh = &setup.interfaces[interface];
        let labels = if mesh.labels.is_empty() {
            position_labels(points.iter().map(|p| p.position))
        } else {
            points.iter().map(|p| mesh.labels[p.node].clone()).collect()
        };
        let probe = |(label, p): (String, &crate::bodies::PointHistory)| Probe {
            label,
            relative_displacement: p.relative_displacement.clone(),
            friction: p.friction.clone(),
            slip_rate: p.slip_rate.clone(),
            state: mesh.theta_at(p.node).map_or_else(
                || p.state.clone(),
                |theta| p.state.iter().map(|s| theta.at_zero + theta.per_state * s).collect(),
            ),
            steady: mesh.theta_at(p.node).map_or_else(Vec::new, |theta| {
                p.slip_rate.iter().map(|v| theta.steady - v.abs().log10()).collect()
            }),
        };
        Some(Self {
            stem: stem.into(),
            title: setup.title.clone(),
            name: mesh.name.clone(),
            stages: setup.stages.clone(),
            times: recorder.times().to_vec(),
            points: labels.into_iter().zip(points).map(probe).collect(),
            theta: !mesh.theta.is_empty(),
        })
    }

    /// Figures with their names, of the steps from the first time to the last.
    pub(super) fn figures(&self, paper: Paper, window: Option<[f64; 2]>) -> Vec<(String, Figure)> {
        let [from, to] = window.unwrap_or([0.0, f64::INFINITY]);
        let first = self.times.partition_point(|t| *t < from);
        let last = self.times.partition_point(|t| *t <= to).max(first);
        let one = |quantity: &Quantity| {
            let figure = self.figure(quantity, (from, first..last), paper)?;
            Some((format!("{}_{}", self.stem, quantity.file), figure))
        };
        let state = if self.theta { &THETA } else { &STATE };
        let has_state = self.points.iter().all(|p| p.state.len() == self.times.len());
        QUANTITIES.iter().chain(has_state.then_some(state)).filter_map(one).collect()
    }
}

/// Distance to the values themselves up to which references are drawn: a locked point has a steady state far away.
pub(super) const REACH: f64 = 3.0;
/// Dashes of references.
const DASHED: Dash = &[5.0, 3.0];

/// A quantity plotted over time.
#[derive(Clone, Copy)]
struct Quantity {
    /// Last part of its file name.
    file: &'static str,
    /// Name on the axis.
    name: &'static str,
    units: Units,
    /// True if a logarithmic axis is considered.
    rate: bool,
    read: fn(&Probe) -> &[f64],
    /// Reference drawn with dashes, empty where there is none.
    reference: fn(&Probe) -> &[f64],
}

/// θ with that in steady state at the slip rate.
const THETA: Quantity = Quantity {
    file: "state",
    name: "log₁₀ of state θ (dashed: steady at V)",
    units: units::SECONDS,
    rate: false,
    read: |p| &p.state,
    reference: |p| &p.steady,
};

/// State variable of a law without θ.
const STATE: Quantity =
    Quantity { name: "State variable", units: units::NUMBER, reference: |_| &[], ..THETA };

/// Quantities plotted for each interface.
const QUANTITIES: [Quantity; 3] = [
    Quantity {
        file: "relative_displacement",
        name: "Relative displacement",
        units: units::LENGTH,
        rate: false,
        read: |p| &p.relative_displacement,
        reference: |_| &[],
    },
    Quantity {
        file: "friction",
        name: "Friction coefficient",
        units: units::NUMBER,
        rate: false,
        read: |p| &p.friction,
        reference: |_| &[],
    },
    Quantity {
        file: "relative_velocity",
        name: "Relative velocity",
        units: units::VELOCITY,
        rate: true,
        read: |p| &p.slip_rate,
        reference: |_| &[],
    },
];

/// Ratio of the largest to the time-weighted median velocity above which a linear axis would show only spikes.
const SPIKES: f64 = 1e3;

/// Most decades of a logarithmic axis; plate rates and seismic slip rates are about twelve decades apart.
pub(super) const DECADES: f64 = 14.0;

/// Columns into which a curve is thinned, keeping the extremes of each: twice the resolution of a screen.
const COLUMNS: usize = 2000;

impl Histories {
    /// A quantity of the steps in a range; the axis begins at a time \[s\]. `None` without steps.
    fn figure(
        &self,
        quantity: &Quantity,
        (from, steps): (f64, Range<usize>),
        paper: Paper,
    ) -> Option<Figure> {
        let times = &self.times[steps.clone()];
        let &end = times.last().filter(|end| **end > from)?;
        let series: Vec<&[f64]> = self.points.iter().map(|p| &(quantity.read)(p)[steps.clone()]).collect();
        let references = self.references(quantity, &series, &steps);
        let references: Vec<&[f64]> = references.iter().map(Vec::as_slice).collect();
        let (time, unit) = (TIME.choose(end), quantity.units.choose(largest(&series)));
        let log = quantity.rate && is_spiky(times, &series);
        let values = series
            .iter()
            .chain(&references)
            .flat_map(|s| s.iter())
            .map(|v| if log { v.abs() } else { *v } / unit.factor);
        let label = format!("{} [{}]", quantity.name, unit.name);
        let y = Axis::over_time(values, log.then_some(DECADES), label);
        let x = Axis::exact([from / time.factor, end / time.factor], format!("Time [{}]", time.name));
        let mut page = FramedFigure::new(paper, x, y, &self.entries());
        let FramedFigure { figure, frame, .. } = &mut page;
        title(figure, frame, &self.title, &self.name);
        frame.grid(figure);
        stage_marks(figure, frame, &self.stages, time);
        let up = |v: f64| if log { v.abs() } else { v } / unit.factor;
        for (all, dash, width) in [(&references, DASHED, 1.1), (&series, &[] as Dash, 1.8)] {
            for (i, values) in all.iter().enumerate() {
                for piece in pieces(times, values) {
                    let line = piece.iter().map(|&(t, v)| frame.point(t / time.factor, up(v)));
                    figure.dashed(thin(line.collect()), dash, width, curve_colour(i, series.len()));
                }
            }
        }
        Some(page.finish())
    }

    /// Legend of the points.
    fn entries(&self) -> Vec<Entry> {
        let entry = |(i, p): (usize, &Probe)| Entry {
            name: p.label.clone(),
            colour: curve_colour(i, self.points.len()),
            dash: &[],
        };
        self.points.iter().enumerate().map(entry).collect()
    }

    /// References of a quantity in a range of steps, where they are near the series.
    fn references(&self, quantity: &Quantity, series: &[&[f64]], steps: &Range<usize>) -> Vec<Vec<f64>> {
        let own = series.iter().flat_map(|s| s.iter()).copied().filter(|v| v.is_finite());
        let (lo, hi) = own.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), v| (lo.min(v), hi.max(v)));
        let near = |v: &f64| if (lo - REACH..=hi + REACH).contains(v) { *v } else { f64::NAN };
        let references = self.points.iter().filter_map(|p| (quantity.reference)(p).get(steps.clone()));
        references.map(|r| r.iter().map(near).collect()).collect()
    }
}

/// Draws a dashed line at the end of each stage but the last, and the names of the stages along the top.
fn stage_marks(figure: &mut Figure, frame: &Frame, stages: &[(String, f64)], time: Unit) {
    let (left, top) = frame.at;
    let (mut from, shown) = frame.x.range;
    let span = shown - from;
    for (name, end) in stages {
        let to = (end / time.factor).min(shown);
        if to < from {
            continue;
        }
        let middle = frame.x.place((from + to) / 2.0);
        // Names that do not fit their stage, at 7.5 units per character, are omitted.
        if (to - from) / span * frame.size.0 > 7.5 * name.chars().count() as f64 {
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
    let mut thinner = CurveThinner::new(points[0].0, points[points.len() - 1].0);
    points.into_iter().for_each(|p| thinner.push(p));
    thinner.finish()
}

/// Largest number of points collected in a column before it is reduced to its extremes.
const GROUP: usize = 4096;

/// Thins a curve point by point.
#[derive(Debug)]
pub(super) struct CurveThinner {
    left: f64,
    width: f64,
    group: Vec<Point>,
    kept: Vec<Point>,
}

impl CurveThinner {
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
