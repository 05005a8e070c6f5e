//! Plots of faults in earthquake cycles: largest slip rate, slip contours, slip rate over space and time, phase portrait.
//!
//! Each plot reads the rows of a table twice: for the ranges of its axes and for drawing. Memory does not grow with the number of
//! rows.

use super::super::OutputError;
use super::axes::{Axis, Frame};
use super::colour::{Rgb, viridis};
use super::curves::{DECADES, Entry, Thinner, legend};
use super::field::Bar;
use super::figure::{Figure, Image, Point};
use super::paper::Paper;
use super::stretched::Stretched;
use super::title::title;
use super::units::{LENGTH, STRESS, TIME};
use crate::stems;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// A fault along a line.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Line {
    /// Name.
    pub name: String,
    /// Range of its columns in the rows of profiles.
    pub columns: Range<usize>,
    /// Distances of its points from the upper end, ascending \[m\].
    pub along: Vec<f64>,
}

/// A table of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Table {
    /// Time \[s\], log10 of the largest slip rate \[m/s\], its point, mean shear traction \[Pa\], mean slip \[m\].
    Largest,
    /// Time \[s\] and slip of all points \[m\].
    Slip,
    /// Time \[s\] and log10 of slip rates of all points \[m/s\].
    Rate,
}

/// Access to the tables of a run.
pub trait Rows {
    /// Passes the rows of a table to `look`, from the first to the last.
    ///
    /// # Errors
    /// If the table cannot be read.
    fn each(&self, table: Table, look: &mut dyn FnMut(&[f64])) -> Result<(), OutputError>;
}

/// Plots of a run.
pub(super) struct Cycles<'a> {
    /// Title of the scene.
    pub title: String,
    /// Faults along lines.
    pub lines: Vec<Line>,
    /// Tables of the run.
    pub rows: &'a dyn Rows,
    /// Times of onset and end of the events \[s\].
    pub events: Vec<(f64, f64)>,
    /// Time between slip contours, between events and during events, as text.
    pub intervals: [String; 2],
    /// First and last time shown \[s\]; all if there is none.
    pub window: Option<(f64, f64)>,
    /// Size of the figures.
    pub(super) paper: Paper,
}

/// Smallest and largest of the finite values seen.
#[derive(Clone, Copy, Debug)]
struct Bounds(f64, f64);

impl Bounds {
    const NONE: Self = Self(f64::INFINITY, f64::NEG_INFINITY);

    fn see(&mut self, value: f64) {
        if value.is_finite() {
            *self = Self(self.0.min(value), self.1.max(value));
        }
    }

    /// True if any value was seen.
    fn any(self) -> bool {
        self.0 <= self.1
    }

    /// Both values in a unit.
    fn over(self, factor: f64) -> impl Iterator<Item = f64> {
        [self.0 / factor, self.1 / factor].into_iter()
    }
}

/// Distance below which points of the phase portrait coincide: half a pixel of a screen.
const NEAR: f64 = 0.5;
/// Largest number of points of the phase portrait, enough for some hundred cycles; later ones lie on top of these.
const MOST_POINTS: usize = 200_000;

/// Colour of slip during events.
const SEISMIC: Rgb = [205, 92, 38];
/// Colour of slip between events.
const ASEISMIC: Rgb = [52, 84, 160];
/// Position of the frame.
const AT: Point = (96.0, 40.0);
/// Size of the frame.
const SIZE: Point = (560.0, 380.0);
/// Width right of the frame for a legend, for a colour bar, and for half a number.
const ROOMS: [f64; 3] = [230.0, 150.0, 40.0];
/// Height below the frame for numbers and a label.
const BELOW: f64 = 60.0;
/// Largest number of columns and rows of pixels of an image.
const PIXELS: (usize, usize) = (1120, 760);
/// Distance to the preceding contour, as a share of the axis, below which a contour is omitted: a pixel of a screen.
const TOGETHER: f64 = 2e-3;
/// Decades below the fastest rate shown by the image of slip rates. Slower points are locked.
const SHOWN: f64 = 14.0;

type Drawn = Result<Option<Figure>, OutputError>;

impl Cycles<'_> {
    /// All figures with their file names.
    pub(super) fn figures(&self) -> Result<Vec<(String, Figure)>, OutputError> {
        let mut figures = Vec::new();
        let mut add = |name: String, figure: Option<Figure>| figures.extend(figure.map(|f| (name, f)));
        add("largest_rate".into(), self.largest_rate()?);
        add("phase_portrait".into(), self.portrait()?);
        for (stem, line) in stems(self.lines.iter().map(|l| l.name.as_str())).iter().zip(&self.lines) {
            add(format!("{stem}_slip"), self.contours(line)?);
            add(format!("{stem}_rate"), self.space_time(line)?);
        }
        Ok(figures)
    }

    fn frame(&self, x: Axis, y: Axis, room: f64) -> (Figure, Frame) {
        let size = self.paper.frame(SIZE, (AT.0 + room, AT.1 + BELOW));
        (Figure::new(AT.0 + size.0 + room, AT.1 + size.1 + BELOW), Frame { at: AT, size, x, y })
    }

    /// Ranges of time, largest slip rate and mean shear traction.
    fn ranges(&self) -> Result<[Bounds; 3], OutputError> {
        let mut ranges = [Bounds::NONE; 3];
        self.rows.each(Table::Largest, &mut |row| {
            for (range, value) in ranges.iter_mut().zip([row[0], 10.0_f64.powf(row[1]), row[3]]) {
                range.see(value);
            }
        })?;
        Ok(ranges)
    }

    fn largest_rate(&self) -> Drawn {
        let [times, rates, _] = self.ranges()?;
        if times.0 >= times.1 {
            return Ok(None);
        }
        let (first, last) = self.window.unwrap_or((times.0, times.1));
        let time = TIME.of(last);
        let label = format!("Time [{}]", time.name);
        let x = Axis::exact((first / time.factor, last / time.factor), label);
        let y = Axis::logarithmic(rates.over(1.0), DECADES, "Largest slip rate [m/s]".into());
        let (mut figure, frame) = self.frame(x, y, ROOMS[2]);
        title(&mut figure, &frame, &self.title, "largest slip rate");
        frame.grid(&mut figure);
        let mut curve = Thinner::new(AT.0, AT.0 + frame.size.0);
        self.rows.each(Table::Largest, &mut |row| {
            let point = frame.point(row[0] / time.factor, 10.0_f64.powf(row[1]));
            if point.0.is_finite() && point.1.is_finite() {
                curve.push(point);
            }
        })?;
        figure.line(curve.finish(), 1.4, viridis(0.3));
        frame.draw(&mut figure);
        Ok(Some(figure))
    }

    fn portrait(&self) -> Drawn {
        let [_, rates, shear] = self.ranges()?;
        if !shear.any() {
            return Ok(None);
        }
        let unit = STRESS.of(shear.0.abs().max(shear.1.abs()));
        let x = Axis::logarithmic(rates.over(1.0), DECADES, "Largest slip rate [m/s]".into());
        let y = Axis::linear(shear.over(unit.factor), 0.05, format!("Mean shear traction [{}]", unit.name));
        let (mut figure, frame) = self.frame(x, y, ROOMS[2]);
        title(&mut figure, &frame, &self.title, "phase portrait");
        frame.grid(&mut figure);
        let mut curve: Vec<Point> = Vec::new();
        self.rows.each(Table::Largest, &mut |row| {
            let (x, y) = frame.point(10.0_f64.powf(row[1]), row[3] / unit.factor);
            let apart = curve.last().is_none_or(|last| (x - last.0).hypot(y - last.1) >= NEAR);
            if apart && x.is_finite() && y.is_finite() && curve.len() < MOST_POINTS {
                curve.push((x, y));
            }
        })?;
        figure.line(curve, 1.2, viridis(0.3));
        frame.draw(&mut figure);
        Ok(Some(figure))
    }

    fn in_event(&self, time: f64) -> bool {
        let k = self.events.partition_point(|e| e.0 <= time);
        k > 0 && time <= self.events[k - 1].1
    }

    /// Axis along a fault, downwards, and its unit \[m\].
    fn along(line: &Line) -> Option<(Axis, f64)> {
        let (first, last) = (*line.along.first()?, *line.along.last()?);
        let unit = LENGTH.of(last.abs().max(first.abs()));
        let range = (last / unit.factor, first / unit.factor);
        (last > first)
            .then(|| (Axis::exact(range, format!("Distance along the fault [{}]", unit.name)), unit.factor))
    }

    /// Passes the times of a table of profiles and the values on a line to `look`.
    fn profiles(
        &self,
        table: Table,
        line: &Line,
        look: &mut dyn FnMut(f64, &[f64]),
    ) -> Result<(), OutputError> {
        self.rows.each(table, &mut |row| {
            if let Some(values) = row.get(1..).and_then(|all| all.get(line.columns.clone())) {
                look(row[0], values);
            }
        })
    }

    fn contours(&self, line: &Line) -> Drawn {
        let Some((y, scale)) = Self::along(line) else { return Ok(None) };
        let mut range = Bounds::NONE;
        self.profiles(Table::Slip, line, &mut |_, slip| slip.iter().for_each(|&s| range.see(s)))?;
        if !range.any() {
            return Ok(None);
        }
        let unit = LENGTH.of(range.0.abs().max(range.1.abs()));
        let x = Axis::linear(range.over(unit.factor), 0.02, format!("Slip [{}]", unit.name));
        let (mut figure, frame) = self.frame(x, y, ROOMS[0]);
        title(&mut figure, &frame, &self.title, &format!("slip of {}", line.name));
        frame.grid(&mut figure);
        let least = TOGETHER * unit.factor * (frame.x.range.1 - frame.x.range.0);
        let mut kept: [(Vec<Vec<Point>>, Vec<f64>); 2] = Default::default();
        self.profiles(Table::Slip, line, &mut |time, slip| {
            let (curves, last) = &mut kept[usize::from(self.in_event(time))];
            if last.is_empty() || last.iter().zip(slip).any(|(a, b)| (a - b).abs() >= least) {
                *last = slip.to_vec();
                let points = slip.iter().zip(&line.along);
                curves.push(points.map(|(s, a)| frame.point(s / unit.factor, a / scale)).collect());
            }
        })?;
        // Slip between events is drawn over slip during events, which would hide it.
        let [between, within] = kept.map(|(curves, _)| curves);
        for (curves, colour, width) in [(within, SEISMIC, 0.5), (between, ASEISMIC, 0.9)] {
            curves.into_iter().for_each(|curve| figure.line(curve, width, colour));
        }
        frame.draw(&mut figure);
        let entries = [("between events, every", ASEISMIC, 0), ("in events, every", SEISMIC, 1)];
        let entries = entries.into_iter().map(|(words, colour, k)| {
            let name = format!("{words} {}", self.intervals[k]);
            Entry { name, colour, dash: &[] }
        });
        legend(&mut figure, &frame, entries);
        Ok(Some(figure))
    }

    /// Image of slip rates over distance and output rows. Rows are written by time and by change, so that events take as much
    /// room as the time between them; the axis has the times of rows.
    fn space_time(&self, line: &Line) -> Drawn {
        let Some((y, _)) = Self::along(line) else { return Ok(None) };
        let (mut times, mut range) = (Vec::new(), Bounds::NONE);
        self.profiles(Table::Rate, line, &mut |time, rates| {
            times.push(time);
            rates.iter().for_each(|&r| range.see(r));
        })?;
        let count = times.len();
        if !range.any() {
            return Ok(None);
        }
        let hi = range.1.ceil();
        let lo = range.0.floor().max(hi - SHOWN).min(hi - 1.0);
        let stretched = Stretched::new(&times, &self.events);
        let (mut figure, frame) = self.frame(stretched.axis(), y, ROOMS[1]);
        title(&mut figure, &frame, &self.title, &format!("slip rate of {}", line.name));
        let columns = count.clamp(1, PIXELS.0);
        let nearest = nearest(&line.along);
        // Each column shows the fastest of its rows, so that short events are not lost.
        let (mut fastest, mut row) = (vec![f64::MIN; columns * nearest.len()], 0);
        self.profiles(Table::Rate, line, &mut |_, rates| {
            row += 1;
            let column = (row * columns - 1) / count;
            for (k, &point) in nearest.iter().enumerate() {
                let shown = &mut fastest[k * columns + column];
                *shown = shown.max(rates[point]);
            }
        })?;
        let rgb = fastest.into_iter().map(|rate| viridis((rate - lo) / (hi - lo))).collect();
        figure.image(Image { at: frame.at, size: frame.size, columns, rgb });
        stretched.mark(&mut figure, &frame);
        frame.draw(&mut figure);
        Bar { range: (lo, hi), above: None, label: "log₁₀ of slip rate [m/s]".into() }
            .draw(&mut figure, &frame);
        Ok(Some(figure))
    }
}

/// Point nearest to each row of pixels.
fn nearest(along: &[f64]) -> Vec<usize> {
    let (first, last) = (along[0], along[along.len() - 1]);
    let nearest = |k: usize| {
        let at = first + (last - first) * (k as f64 + 0.5) / PIXELS.1 as f64;
        let k = along.partition_point(|&a| a < at).clamp(1, along.len() - 1);
        if at - along[k - 1] < along[k] - at { k - 1 } else { k }
    };
    (0..PIXELS.1).map(nearest).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Tables in memory.
    #[derive(Default)]
    struct Kept {
        largest: Vec<Vec<f64>>,
        slip: Vec<Vec<f64>>,
        rate: Vec<Vec<f64>>,
    }

    impl Rows for Kept {
        fn each(&self, table: Table, look: &mut dyn FnMut(&[f64])) -> Result<(), OutputError> {
            let rows = match table {
                Table::Largest => &self.largest,
                Table::Slip => &self.slip,
                Table::Rate => &self.rate,
            };
            rows.iter().for_each(|row| look(row));
            Ok(())
        }
    }

    fn kept() -> Kept {
        Kept {
            largest: vec![
                vec![0.0, -9.0, 0.0, 3e7, 0.0],
                vec![1e9, 0.5, 0.0, 2.5e7, 0.0],
                vec![2e9, -9.0, 0.0, 2.7e7, 0.0],
            ],
            slip: vec![vec![0.0, 9.0, 0.0, 0.0, 0.0], vec![1e9, 9.0, 1.0, 2.0, 3.0]],
            rate: vec![vec![0.0, 0.0, -9.0, -9.0, -9.0], vec![1e9, 0.0, 0.5, -3.0, -9.0]],
        }
    }

    fn sample(rows: &Kept) -> Cycles<'_> {
        Cycles {
            title: "t".into(),
            lines: vec![Line { name: "main".into(), columns: 1..4, along: vec![0.0, 1e4, 4e4] }],
            rows,
            events: vec![(0.9e9, 1.1e9)],
            intervals: ["2.5 d".into(), "3 min".into()],
            window: None,
            paper: Paper::default(),
        }
    }

    #[test]
    fn every_fault_along_a_line_has_its_figures() {
        let names: Vec<String> = sample(&kept()).figures().unwrap().into_iter().map(|f| f.0).collect();
        assert_eq!(names, ["largest_rate", "phase_portrait", "main_slip", "main_rate"]);
    }

    #[test]
    fn slip_in_an_event_is_told_from_slip_between() {
        let kept = kept();
        let cycles = sample(&kept);
        assert!(!cycles.in_event(0.0) && cycles.in_event(1e9) && !cycles.in_event(1.2e9));
    }

    #[test]
    fn the_image_has_the_colours_of_the_rates_with_the_upper_end_on_top() {
        let kept = kept();
        let cycles = sample(&kept);
        let figure = cycles.space_time(&cycles.lines[0]).unwrap().unwrap();
        let image = figure.shapes.iter().find_map(|s| match s {
            super::super::figure::Shape::Image(image) => Some(image),
            _ => None,
        });
        let image = image.unwrap();
        assert_eq!(image.columns, 2);
        // At the upper end the second row of rates is the fastest; the lower end is the slowest.
        assert_eq!(image.rgb[1], viridis((0.5 + 9.0) / 10.0));
        assert_eq!(image.rgb[image.rgb.len() - 1], viridis(0.0));
    }

    #[test]
    fn a_run_of_no_length_has_no_curves() {
        let empty = Kept::default();
        assert!(sample(&empty).figures().unwrap().is_empty());
    }

    #[test]
    fn legends_of_contours_tell_the_intervals_of_the_run() {
        let kept = kept();
        let cycles = sample(&kept);
        let figure = cycles.contours(&cycles.lines[0]).unwrap().unwrap();
        let texts: Vec<&str> = figure
            .shapes
            .iter()
            .filter_map(|s| match s {
                super::super::figure::Shape::Text(text) => Some(text.text.as_str()),
                _ => None,
            })
            .collect();
        assert!(
            texts.contains(&"between events, every 2.5 d") && texts.contains(&"in events, every 3 min"),
            "{texts:?}"
        );
    }
}
