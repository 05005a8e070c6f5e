//! Plots of faults through earthquake cycles: largest slip rate, slip contours, slip rate over space and time, phase portrait.

use super::super::files::stems;
use super::axes::{Axis, Frame};
use super::colour::{Rgb, viridis};
use super::curves::{DECADES, Entry, legend, thin, title};
use super::field::Bar;
use super::figure::{Figure, Image, Point};
use super::units::{LENGTH, STRESS, TIME};
use std::ops::Range;

/// A fault along a line.
#[derive(Clone, Debug, Default)]
pub struct Line {
    /// Name.
    pub name: String,
    /// Its columns in the rows of profiles.
    pub columns: Range<usize>,
    /// Distances of its points from its upper end, ascending \[m\].
    pub along: Vec<f64>,
}

/// What is drawn.
#[derive(Clone, Debug, Default)]
pub struct Cycles {
    /// Title of the scene.
    pub title: String,
    /// Faults along lines.
    pub lines: Vec<Line>,
    /// Time \[s\], log10 of the largest slip rate \[m/s\], mean shear traction \[Pa\].
    pub largest: Vec<[f64; 3]>,
    /// Time \[s\] and slip of all points \[m\].
    pub slip: Vec<(f64, Vec<f64>)>,
    /// Time \[s\] and log10 of slip rates of all points \[m/s\].
    pub rate: Vec<(f64, Vec<f64>)>,
    /// Onsets and ends of events \[s\].
    pub events: Vec<(f64, f64)>,
    /// Time between slip contours while nothing is fast, and in events, in words.
    pub intervals: [&'static str; 2],
}

/// Slip in events.
const SEISMIC: Rgb = [205, 92, 38];
/// Slip between them.
const ASEISMIC: Rgb = [52, 84, 160];
/// Place and size of the frame.
const AT: Point = (96.0, 40.0);
/// See [`AT`].
const SIZE: Point = (560.0, 380.0);
/// Room right of it.
const ROOM: f64 = 230.0;
/// Pixels of an image at most.
const PIXELS: (usize, usize) = (1120, 760);
/// Contours nearer to the one before than this share of the axis are left out: a pixel of a screen.
const TOGETHER: f64 = 2e-3;
/// Decades below the fastest that the image of slip rates shows: what lies lower is locked.
const SHOWN: f64 = 14.0;

impl Cycles {
    /// All figures with the names of their files.
    pub(super) fn figures(&self) -> Vec<(String, Figure)> {
        let mut figures = Vec::new();
        let mut add = |name: String, figure: Option<Figure>| figures.extend(figure.map(|f| (name, f)));
        add("largest_rate".into(), self.largest_rate());
        add("phase_portrait".into(), self.portrait());
        for (stem, line) in stems(self.lines.iter().map(|l| l.name.as_str())).iter().zip(&self.lines) {
            add(format!("{stem}_slip"), self.contours(line));
            add(format!("{stem}_rate"), self.space_time(line));
        }
        figures
    }

    fn frame(x: Axis, y: Axis) -> (Figure, Frame) {
        (Figure::new(AT.0 + SIZE.0 + ROOM, AT.1 + SIZE.1 + 60.0), Frame { at: AT, size: SIZE, x, y })
    }

    fn largest_rate(&self) -> Option<Figure> {
        let (first, last) = (self.largest.first()?[0], self.largest.last()?[0]);
        if last <= first {
            return None;
        }
        let time = TIME.of(last);
        let x = Axis::exact((first / time.factor, last / time.factor), format!("Time [{}]", time.name));
        let rates = self.largest.iter().map(|row| 10.0_f64.powf(row[1]));
        let (mut figure, frame) =
            Self::frame(x, Axis::logarithmic(rates, DECADES, "Largest slip rate [m/s]".into()));
        title(&mut figure, &frame, &self.title, "largest slip rate");
        frame.grid(&mut figure);
        let points = self.largest.iter().map(|r| frame.point(r[0] / time.factor, 10.0_f64.powf(r[1])));
        figure.line(thin(points.collect()), 1.4, viridis(0.3));
        frame.draw(&mut figure);
        Some(figure)
    }

    fn portrait(&self) -> Option<Figure> {
        let most = self.largest.iter().map(|r| r[2].abs()).reduce(f64::max)?;
        let unit = STRESS.of(most);
        let rates = || self.largest.iter().map(|row| 10.0_f64.powf(row[1]));
        let x = Axis::logarithmic(rates(), DECADES, "Largest slip rate [m/s]".into());
        let y = Axis::linear(
            self.largest.iter().map(|r| r[2] / unit.factor),
            0.05,
            format!("Mean shear traction [{}]", unit.name),
        );
        let (mut figure, frame) = Self::frame(x, y);
        title(&mut figure, &frame, &self.title, "phase portrait");
        frame.grid(&mut figure);
        let points = self.largest.iter().zip(rates()).map(|(r, v)| frame.point(v, r[2] / unit.factor));
        figure.line(points.collect(), 1.2, viridis(0.3));
        frame.draw(&mut figure);
        Some(figure)
    }

    fn in_event(&self, time: f64) -> bool {
        let k = self.events.partition_point(|e| e.0 <= time);
        k > 0 && time <= self.events[k - 1].1
    }

    /// The axis along a fault, downwards, and its unit.
    fn along(line: &Line) -> Option<(Axis, f64)> {
        let (first, last) = (*line.along.first()?, *line.along.last()?);
        let unit = LENGTH.of(last.abs().max(first.abs()));
        let range = (last / unit.factor, first / unit.factor);
        (last > first)
            .then(|| (Axis::exact(range, format!("Distance along the fault [{}]", unit.name)), unit.factor))
    }

    fn contours(&self, line: &Line) -> Option<Figure> {
        let (y, scale) = Self::along(line)?;
        let part = |row: &(f64, Vec<f64>)| row.1.get(line.columns.clone()).map(<[f64]>::to_vec);
        let rows: Vec<(f64, Vec<f64>)> =
            self.slip.iter().filter_map(|row| Some((row.0, part(row)?))).collect();
        let values = || rows.iter().flat_map(|r| r.1.iter().copied());
        let unit = LENGTH.of(values().fold(0.0, |most: f64, v| most.max(v.abs())));
        let x = Axis::linear(values().map(|v| v / unit.factor), 0.02, format!("Slip [{}]", unit.name));
        let (mut figure, frame) = Self::frame(x, y);
        title(&mut figure, &frame, &self.title, &format!("slip of {}", line.name));
        frame.grid(&mut figure);
        // Slip between events over that in events, which would hide it.
        let least = TOGETHER * unit.factor * (frame.x.range.1 - frame.x.range.0);
        for (fast, colour, width) in [(true, SEISMIC, 0.5), (false, ASEISMIC, 0.9)] {
            let mut last: Option<&[f64]> = None;
            for (_, slip) in rows.iter().filter(|row| self.in_event(row.0) == fast) {
                let apart = |l: &[f64]| l.iter().zip(slip).any(|(a, b)| (a - b).abs() >= least);
                if !last.is_none_or(apart) {
                    continue;
                }
                last = Some(slip);
                let points = slip.iter().zip(&line.along);
                let line = points.map(|(s, a)| frame.point(s / unit.factor, a / scale));
                figure.line(line.collect(), width, colour);
            }
        }
        frame.draw(&mut figure);
        let entries = [("between events, every", ASEISMIC, 0), ("in events, every", SEISMIC, 1)];
        let entries = entries.into_iter().map(|(words, colour, k)| {
            let name = format!("{words} {}", self.intervals[k]);
            Entry { name, colour, dashed: false }
        });
        legend(&mut figure, &frame, entries);
        Some(figure)
    }

    /// Slip rates over distance and output rows, which come by time and by change, so that events take as much room as what lies
    /// between them.
    fn space_time(&self, line: &Line) -> Option<Figure> {
        let (y, _) = Self::along(line)?;
        let rows: Vec<&[f64]> = self.rate.iter().filter_map(|row| row.1.get(line.columns.clone())).collect();
        let values = || rows.iter().flat_map(|r| r.iter().copied()).filter(|v| v.is_finite());
        let hi = values().reduce(f64::max)?.ceil();
        let lo = values().reduce(f64::min)?.floor().max(hi - SHOWN).min(hi - 1.0);
        let x = Axis::exact(
            (0.0, rows.len() as f64),
            "Rows of rate_profiles.csv, by time and by change of slip rate".into(),
        );
        let (mut figure, frame) = Self::frame(x, y);
        title(&mut figure, &frame, &self.title, &format!("slip rate of {}", line.name));
        let columns = rows.len().clamp(1, PIXELS.0);
        let (first, last) = (line.along[0], line.along[line.along.len() - 1]);
        let nearest: Vec<usize> = (0..PIXELS.1)
            .map(|k| {
                let at = first + (last - first) * (k as f64 + 0.5) / PIXELS.1 as f64;
                let k = line.along.partition_point(|&a| a < at).clamp(1, line.along.len() - 1);
                if at - line.along[k - 1] < line.along[k] - at { k - 1 } else { k }
            })
            .collect();
        let mut rgb = Vec::with_capacity(columns * nearest.len());
        for &point in &nearest {
            for column in 0..columns {
                // The fastest of the rows in a column: what is short is not lost.
                let (a, b) = (column * rows.len() / columns, (column + 1) * rows.len() / columns);
                let fastest = rows[a..b.max(a + 1)].iter().map(|r| r[point]).fold(f64::MIN, f64::max);
                rgb.push(viridis((fastest - lo) / (hi - lo)));
            }
        }
        figure.image(Image { at: frame.at, size: frame.size, columns, rgb });
        frame.draw(&mut figure);
        Bar { range: (lo, hi), above: None, label: "log₁₀ of slip rate [m/s]".into() }
            .draw(&mut figure, &frame);
        Some(figure)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> Cycles {
        Cycles {
            title: "t".into(),
            lines: vec![Line { name: "main".into(), columns: 1..4, along: vec![0.0, 1e4, 4e4] }],
            largest: vec![[0.0, -9.0, 3e7], [1e9, 0.5, 2.5e7], [2e9, -9.0, 2.7e7]],
            slip: vec![(0.0, vec![9.0, 0.0, 0.0, 0.0]), (1e9, vec![9.0, 1.0, 2.0, 3.0])],
            rate: vec![(0.0, vec![0.0, -9.0, -9.0, -9.0]), (1e9, vec![0.0, 0.5, -3.0, -9.0])],
            events: vec![(0.9e9, 1.1e9)],
            intervals: ["5 a", "1 s"],
        }
    }

    #[test]
    fn every_fault_along_a_line_has_its_figures() {
        let names: Vec<String> = sample().figures().into_iter().map(|f| f.0).collect();
        assert_eq!(names, ["largest_rate", "phase_portrait", "main_slip", "main_rate"]);
    }

    #[test]
    fn slip_in_an_event_is_told_from_slip_between() {
        let cycles = sample();
        assert!(!cycles.in_event(0.0) && cycles.in_event(1e9) && !cycles.in_event(1.2e9));
    }

    #[test]
    fn the_image_has_the_colours_of_the_rates_with_the_upper_end_on_top() {
        let cycles = sample();
        let figure = cycles.space_time(&cycles.lines[0]).unwrap();
        let image = figure.shapes.iter().find_map(|s| match s {
            super::super::figure::Shape::Image(image) => Some(image),
            _ => None,
        });
        let image = image.unwrap();
        assert_eq!(image.columns, 2);
        // The second row of rates at the upper end is the fastest, the lower end the slowest.
        assert_eq!(image.rgb[1], viridis((0.5 + 9.0) / 10.0));
        assert_eq!(image.rgb[image.rgb.len() - 1], viridis(0.0));
    }

    #[test]
    fn a_run_of_no_length_has_no_curves() {
        let none = Cycles::default();
        assert!(none.figures().is_empty());
    }
}
