//! Curves of any two quantities against each other.

use super::axes::{Axis, Frame};
use super::colour::MARK;
use super::curves::{DECADES, Entry, is_spiky, legend, thin};
use super::figure::{Figure, Point};
use super::paper::Paper;
use super::style::Style;
use super::title::title;
use super::units::{self, Units};
use serde::{Deserialize, Serialize};

/// Quantity of an axis in SI units.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Measure {
    /// Time \[s\].
    Time,
    /// Length \[m\].
    Length,
    /// Velocity \[m/s\]; the axis is logarithmic if the velocity is mostly far below its largest value.
    Velocity,
    /// Stress \[Pa\].
    Stress,
    /// Energy \[J\].
    Energy,
    /// Dimensionless number \[-\].
    Number,
    /// Energy per length out of the plane \[J/m\].
    EnergyPerLength,
    /// Moment rate \[N m/s\].
    MomentRate,
    /// Moment rate per length out of the plane \[N/s\].
    MomentRatePerLength,
}

impl Measure {
    fn units(self) -> Units {
        match self {
            Self::Time => units::TIME,
            Self::Length => units::LENGTH,
            Self::Velocity => units::VELOCITY,
            Self::Stress => units::STRESS,
            Self::Energy => units::ENERGY,
            Self::Number => units::NUMBER,
            Self::EnergyPerLength => units::ENERGY_PER_LENGTH,
            Self::MomentRate => units::MOMENT_RATE,
            Self::MomentRatePerLength => units::MOMENT_RATE_PER_LENGTH,
        }
    }
}

/// Curves in one frame.
#[derive(Clone, Debug)]
pub struct Chart {
    /// Stem of the file names.
    pub file: String,
    /// Title of the scene.
    pub title: String,
    /// Name and quantity of the horizontal axis.
    pub x: (String, Measure),
    /// Name and quantity of the vertical axis.
    pub y: (String, Measure),
    /// Names and points of the curves.
    pub curves: Vec<(String, Vec<(f64, f64)>)>,
}

/// Position of the frame.
const AT: Point = (96.0, 40.0);
/// Size of the frame.
const SIZE: Point = (560.0, 380.0);
/// Width right of the frame for the legend.
const LEGEND: f64 = 170.0;
/// Height below the frame for numbers and a label.
const BELOW: f64 = 60.0;
/// Largest number of curves named in the legend.
const NAMED: usize = 16;

impl Chart {
    /// The figure, with an axis of time from `start` \[s\]; `None` without points, and where nothing changes along the horizontal axis.
    pub(super) fn figure(&self, paper: Paper, start: f64) -> Option<Figure> {
        let points = || self.curves.iter().flat_map(|c| c.1.iter());
        let first = points().next()?;
        let largest = |pick: fn(&Point) -> f64| {
            points().map(|p| pick(p).abs()).filter(|v| v.is_finite()).fold(0.0, f64::max)
        };
        // A run that has not passed its start has no time axis, and loads that do not move no axis of displacement.
        if !points().any(|p| p.0 != first.0) {
            return None;
        }
        let (x_unit, y_unit) = (self.x.1.units().of(largest(|p| p.0)), self.y.1.units().of(largest(|p| p.1)));
        let log = self.y.1 == Measure::Velocity && self.curves.iter().any(|c| spiky(&c.1));
        let up = |v: f64| if log { v.abs() } else { v } / y_unit.factor;
        let label = format!("{} [{}]", self.y.0, y_unit.name);
        let values = points().map(|p| up(p.1));
        let y =
            if log { Axis::logarithmic(values, DECADES, label) } else { Axis::linear(values, 0.08, label) };
        let label = format!("{} [{}]", self.x.0, x_unit.name);
        let x = match self.x.1 {
            Measure::Time => Axis::exact((start / x_unit.factor, largest(|p| p.0) / x_unit.factor), label),
            _ => Axis::linear(points().map(|p| p.0 / x_unit.factor), 0.0, label),
        };
        let size = paper.frame(SIZE, (AT.0 + LEGEND, AT.1 + BELOW));
        let frame = Frame { at: AT, size, x, y };
        let mut figure = Figure::new(AT.0 + size.0 + LEGEND, AT.1 + size.1 + BELOW);
        title(&mut figure, &frame, &self.title, &self.y.0.to_lowercase());
        frame.grid(&mut figure);
        for (i, (_, curve)) in self.curves.iter().enumerate() {
            for piece in curve.split(|p| !(p.0.is_finite() && p.1.is_finite())).filter(|p| !p.is_empty()) {
                let line: Vec<Point> =
                    piece.iter().map(|p| frame.point(p.0 / x_unit.factor, up(p.1))).collect();
                // Thinning by columns is valid only for curves with monotonic x.
                let line = if self.x.1 == Measure::Time { thin(line) } else { line };
                let style = Style::of(i);
                figure.dashed(line, style.dash, 1.8, style.colour);
            }
        }
        frame.draw(&mut figure);
        legend(&mut figure, &frame, self.entries().into_iter());
        Some(figure)
    }

    /// Legend entries of the first curves, with a note if there are more.
    fn entries(&self) -> Vec<Entry> {
        let n = self.curves.len();
        let entry = |(i, curve): (usize, &(String, Vec<Point>))| Entry {
            name: curve.0.clone(),
            colour: Style::of(i).colour,
            dash: Style::of(i).dash,
        };
        let mut entries: Vec<Entry> = self.curves.iter().enumerate().take(NAMED).map(entry).collect();
        if n > NAMED {
            entries.push(Entry { name: format!("and {} more", n - NAMED), colour: MARK, dash: &[1.0, 4.0] });
        }
        entries
    }
}

fn spiky(curve: &[Point]) -> bool {
    let (times, values): (Vec<f64>, Vec<f64>) = curve.iter().copied().unzip();
    is_spiky(&times, &[&values])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_that_turns_back_keeps_all_of_its_points() {
        let there = (0..30_000).map(|i| f64::from(i) * 1e-9);
        let points: Vec<Point> = there.clone().chain(there.rev()).map(|x| (x, 0.6)).collect();
        let n = points.len();
        let chart = Chart {
            file: "c".into(),
            title: "t".into(),
            x: ("Slip".into(), Measure::Length),
            y: ("Friction coefficient".into(), Measure::Number),
            curves: vec![("one".into(), points); 20],
        };
        let figure = chart.figure(Paper::default(), 0.0).unwrap();
        let longest = figure.shapes.iter().filter_map(|s| match s {
            super::super::figure::Shape::Line { points, .. } => Some(points.len()),
            _ => None,
        });
        assert_eq!(longest.max(), Some(n));
        assert_eq!(chart.entries().len(), NAMED + 1);
        let none = |curve| Chart {
            curves: vec![("none".into(), curve)],
            x: ("Time".into(), Measure::Time),
            ..chart.clone()
        };
        assert!(none(Vec::new()).figure(Paper::default(), 0.0).is_none());
        assert!(none(vec![(0.0, 0.6)]).figure(Paper::default(), 0.0).is_none());
    }
}
