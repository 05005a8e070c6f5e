//! Curves of any two quantities against each other.

use super::axes::Axis;
use super::colour::{MARK, Rgb};
use super::curves::{DECADES, REACH, is_spiky, thin};
use super::figure::{Dash, Figure, Point};
use super::framed_figure::FramedFigure;
use super::legend::Entry;
use super::paper::Paper;
use super::style::Style;
use super::title::title;
use crate::units::{self, Units};
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
    /// Decadic logarithm of a time in seconds.
    LogSeconds,
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
            Self::LogSeconds => units::SECONDS,
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
    /// True if curves come in pairs of one colour, the second dashed.
    pub pairs: bool,
}

/// Largest number of curves named in the legend.
const NAMED: usize = 16;

impl Chart {
    /// The figure, with an axis of time from `start` \[s\]; `None` without points, and where nothing changes along the horizontal axis.
    pub(super) fn figure(&self, paper: Paper, start: f64) -> Option<Figure> {
        if self.pairs { self.near().drawn(paper, start) } else { self.drawn(paper, start) }
    }

    fn drawn(&self, paper: Paper, start: f64) -> Option<Figure> {
        let points = || self.curves.iter().flat_map(|c| c.1.iter());
        let largest = |pick: fn(&Point) -> f64| {
            points().map(|p| pick(p).abs()).filter(|v| v.is_finite()).fold(0.0, f64::max)
        };
        if !self.moves() {
            return None;
        }
        let (x_unit, y_unit) =
            (self.x.1.units().choose(largest(|p| p.0)), self.y.1.units().choose(largest(|p| p.1)));
        let log = self.y.1 == Measure::Velocity && self.curves.iter().any(|c| spiky(&c.1));
        let up = |v: f64| if log { v.abs() } else { v } / y_unit.factor;
        let label = format!("{} [{}]", self.y.0, y_unit.name);
        let y = Axis::over_time(points().map(|p| up(p.1)), log.then_some(DECADES), label);
        let label = format!("{} [{}]", self.x.0, x_unit.name);
        let x = match self.x.1 {
            Measure::Time => Axis::exact([start / x_unit.factor, largest(|p| p.0) / x_unit.factor], label),
            _ => Axis::linear(points().map(|p| p.0 / x_unit.factor), 0.0, label),
        };
        // A single curve is named in the title.
        let (entries, part) = match self.curves.as_slice() {
            [(name, _)] if !name.is_empty() => (Vec::new(), format!("{}, {name}", self.y.0.to_lowercase())),
            _ => (self.entries(), self.y.0.to_lowercase()),
        };
        let mut page = FramedFigure::new(paper, x, y, &entries);
        let FramedFigure { figure, frame, .. } = &mut page;
        title(figure, frame, &self.title, &part);
        frame.grid(figure);
        for (i, (_, curve)) in self.curves.iter().enumerate() {
            for piece in curve.split(|p| !(p.0.is_finite() && p.1.is_finite())).filter(|p| !p.is_empty()) {
                let line: Vec<Point> =
                    piece.iter().map(|p| frame.point(p.0 / x_unit.factor, up(p.1))).collect();
                // Thinning by columns is valid only for curves with monotonic x.
                let line = if self.x.1 == Measure::Time { thin(line) } else { line };
                let (colour, dash, width) = self.style(i);
                figure.dashed(line, dash, width, colour);
            }
        }
        Some(page.finish())
    }

    /// True if something changes along the horizontal axis: a run that has not passed its start has no time axis, and loads that do
    /// not move no axis of displacement.
    fn moves(&self) -> bool {
        let mut along = self.curves.iter().flat_map(|c| &c.1).map(|p| p.0);
        along.next().is_some_and(|first| along.any(|x| x != first))
    }

    /// The curves, with references only near the values that they are of.
    fn near(&self) -> Self {
        let own = self.curves.iter().step_by(2).flat_map(|c| &c.1).map(|p| p.1).filter(|v| v.is_finite());
        let (lo, hi) = own.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), v| (lo.min(v), hi.max(v)));
        let mut near = Self { pairs: true, ..self.clone() };
        for (_, reference) in near.curves.iter_mut().skip(1).step_by(2) {
            for point in reference.iter_mut().filter(|p| !(lo - REACH..=hi + REACH).contains(&p.1)) {
                point.1 = f64::NAN;
            }
        }
        near
    }

    /// Colour, dash and width of a curve.
    fn style(&self, curve: usize) -> (Rgb, Dash, f64) {
        if !self.pairs {
            let style = Style::from_curve(curve);
            return (style.colour, style.dash, 1.8);
        }
        let reference = curve % 2 == 1;
        let dash: Dash = if reference { &[5.0, 3.0] } else { &[] };
        (Style::from_curve(curve / 2).colour, dash, if reference { 1.1 } else { 1.8 })
    }

    /// Legend entries of the first curves, with a note if there are more.
    fn entries(&self) -> Vec<Entry> {
        let n = self.curves.len();
        let entry = |(i, curve): (usize, &(String, Vec<Point>))| Entry {
            name: curve.0.clone(),
            colour: self.style(i).0,
            dash: self.style(i).1,
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
    fn references_are_drawn_near_the_values_that_they_are_of() {
        let chart = Chart {
            file: "c".into(),
            title: "t".into(),
            x: ("Time".into(), Measure::Time),
            y: ("log".into(), Measure::LogSeconds),
            curves: vec![
                ("value".into(), vec![(0.0, 1.0), (1.0, 4.0)]),
                ("steady".into(), vec![(0.0, 60.0), (1.0, 6.5)]),
            ],
            pairs: true,
        };
        let near = chart.near();
        assert!(near.curves[1].1[0].1.is_nan() && near.curves[1].1[1].1 == 6.5);
        assert_eq!(near.curves[0], chart.curves[0]);
        assert_ne!(chart.style(0).1, chart.style(1).1);
        assert_eq!(chart.style(0).0, chart.style(1).0);
    }

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
            pairs: false,
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
