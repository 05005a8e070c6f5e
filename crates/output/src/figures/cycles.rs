//! Plots of faults in earthquake cycles: largest slip rate, slip contours, slip rate, state and coupling over space and time,
//! coupling at chosen times, phase portrait.
//!
//! Each plot reads the rows of a table twice: for the ranges of its axes and for drawing. Memory does not grow with the number of
//! rows.

mod coupling;
mod mapped_quantity;
mod maps;
mod portrait;

pub use mapped_quantity::MappedQuantity;
pub use portrait::Portrait;

use super::axes::{Axis, Frame};
use super::colour::{Rgb, viridis};
use super::curves::{CurveThinner, DECADES};
use super::figure::{Figure, Point};
use super::framed_figure::{AT, BELOW, FramedFigure, SIZE};
use super::legend::Entry;
use super::paper::Paper;
use super::title::title;
use crate::OutputError;
use crate::stems;
use crate::units::{LENGTH, TIME};
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
    /// Quantities that it has profiles of, beside slip and slip rate.
    #[serde(default)]
    pub mapped: Vec<MappedQuantity>,
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
    /// Time \[s\] and states of all points: log10 of θ \[s\], or the first state variable of a law without θ.
    State,
    /// Time \[s\] and coupling of all points, between events.
    Coupling,
}

/// Access to the tables of a run.
pub trait Rows {
    /// Passes the rows of a table to `look`, from the first to the last.
    ///
    /// # Errors
    /// If the table cannot be read.
    fn each(&self, table: Table, look: &mut dyn FnMut(&[f64])) -> Result<(), OutputError>;

    /// Passes the rows of the file of a station to `look`, from the first to the last.
    ///
    /// # Errors
    /// If the file cannot be read.
    fn station(&self, path: &str, look: &mut dyn FnMut(&[f64])) -> Result<(), OutputError>;
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
    pub events: Vec<[f64; 2]>,
    /// Time between slip contours, between events and during events, as text.
    pub intervals: [String; 2],
    /// The same in seconds, where it is known.
    pub spacing: Option<[f64; 2]>,
    /// Names and times of the profiles of coupling that are shown \[s\].
    pub chosen: Vec<(String, f64)>,
    /// Stations of the phase portrait, all of which slip in events; without any it is of means.
    pub stations: Vec<Portrait>,
    /// First and last time shown \[s\]; all if there is none.
    pub window: Option<[f64; 2]>,
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

/// Colour of slip during events.
const SEISMIC: Rgb = [205, 92, 38];
/// Colour of slip between events.
const ASEISMIC: Rgb = [52, 84, 160];
/// Width right of the frame for a colour bar.
const ROOM: f64 = 136.0;
/// Largest number of contours of an event, and between two events; more would make an area.
const MOST_CONTOURS: f64 = 60.0;
/// Part of the time between contours that rounding may take.
const ROUNDING: f64 = 1e-6;
/// Distance to the preceding contour, as a share of the axis, below which a contour is omitted: a pixel of a screen.
const TOGETHER: f64 = 2e-3;

type FigureResult = Result<Option<Figure>, OutputError>;

impl Cycles<'_> {
    /// All figures with their file names, and why others are missing.
    pub(super) fn figures(&self) -> (Vec<(String, Figure)>, Vec<OutputError>) {
        let (mut figures, mut failed) = (Vec::new(), Vec::new());
        let mut add = |name: String, drawn: FigureResult| match drawn {
            Ok(figure) => figures.extend(figure.map(|f| (name, f))),
            Err(why) => failed.push(why),
        };
        add("largest_rate".into(), self.largest_rate());
        add("phase_portrait".into(), self.portrait());
        for (stem, line) in stems(self.lines.iter().map(|l| l.name.as_str())).iter().zip(&self.lines) {
            add(format!("{stem}_slip"), self.contours(line));
            add(format!("{stem}_rate"), self.map(line, MappedQuantity::Rate));
            for &mapped in &line.mapped {
                add(format!("{stem}_{}", mapped.stem()), self.map(line, mapped));
            }
            if line.mapped.contains(&MappedQuantity::Coupling) {
                add(format!("{stem}_coupling_profiles"), self.coupling(line));
            }
        }
        (figures, failed)
    }

    /// Size of the frame of an image.
    fn image_size(&self) -> Point {
        self.paper.frame(SIZE, (AT.0 + ROOM, AT.1 + BELOW))
    }

    /// A figure with room for a colour bar.
    fn image_frame(&self, x: Axis, y: Axis) -> (Figure, Frame) {
        let size = self.image_size();
        (Figure::new(AT.0 + size.0 + ROOM, AT.1 + size.1 + BELOW), Frame { at: AT, size, x, y })
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

    fn largest_rate(&self) -> FigureResult {
        let [times, rates, _] = self.ranges()?;
        if times.0 >= times.1 {
            return Ok(None);
        }
        let [first, last] = self.window.unwrap_or([times.0, times.1]);
        let time = TIME.choose(last);
        let label = format!("Time [{}]", time.name);
        let x = Axis::exact([first / time.factor, last / time.factor], label);
        let y = Axis::logarithmic(rates.over(1.0), DECADES, "Largest slip rate [m/s]".into());
        let mut page = FramedFigure::new(self.paper, x, y, &[]);
        let FramedFigure { figure, frame, .. } = &mut page;
        title(figure, frame, &self.title, "largest slip rate");
        frame.grid(figure);
        let mut curve = CurveThinner::new(frame.at.0, frame.at.0 + frame.size.0);
        self.rows.each(Table::Largest, &mut |row| {
            let point = frame.point(row[0] / time.factor, 10.0_f64.powf(row[1]));
            if point.0.is_finite() && point.1.is_finite() {
                curve.push(point);
            }
        })?;
        figure.line(curve.finish(), 1.4, viridis(0.3));
        Ok(Some(page.finish()))
    }

    fn in_event(&self, time: f64) -> bool {
        let k = self.events.partition_point(|e| e[0] <= time);
        k > 0 && time <= self.events[k - 1][1]
    }

    /// Axis along a fault, downwards, and its unit \[m\].
    fn along(line: &Line) -> Option<(Axis, f64)> {
        let (first, last) = (*line.along.first()?, *line.along.last()?);
        let unit = LENGTH.choose(last.abs().max(first.abs()));
        let range = [last / unit.factor, first / unit.factor];
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

    fn contours(&self, line: &Line) -> FigureResult {
        let Some((y, scale)) = Self::along(line) else { return Ok(None) };
        let mut range = Bounds::NONE;
        self.profiles(Table::Slip, line, &mut |_, slip| slip.iter().for_each(|&s| range.see(s)))?;
        if !range.any() {
            return Ok(None);
        }
        let unit = LENGTH.choose(range.0.abs().max(range.1.abs()));
        let x = Axis::linear(range.over(unit.factor), 0.02, format!("Slip [{}]", unit.name));
        let multiples = self.multiples();
        let entries = [("between events, every", ASEISMIC, 0), ("in events, every", SEISMIC, 1)];
        let entries = entries.map(|(words, colour, k)| {
            let name = format!("{words} {}", self.interval(k, multiples[k]));
            Entry { name, colour, dash: &[] }
        });
        let mut page = FramedFigure::new(self.paper, x, y, &entries);
        let FramedFigure { figure, frame, .. } = &mut page;
        title(figure, frame, &self.title, &format!("slip of {}", line.name));
        frame.grid(figure);
        let least = TOGETHER * unit.factor * (frame.x.range.1 - frame.x.range.0);
        // Slip between events is drawn over slip during events, which would hide it.
        let [between, within] = self.contour_curves(line, least, multiples, &|slip, along| {
            frame.point(slip / unit.factor, along / scale)
        })?;
        for (curves, colour, width) in [(within, SEISMIC, 0.6), (between, ASEISMIC, 0.9)] {
            curves.into_iter().for_each(|curve| figure.line(curve, width, colour));
        }
        Ok(Some(page.finish()))
    }

    /// Contours between events and in them that are `least` of slip and multiples of the times between profiles apart.
    fn contour_curves(
        &self,
        line: &Line,
        least: f64,
        multiples: [f64; 2],
        place: &dyn Fn(f64, f64) -> Point,
    ) -> Result<[Vec<Vec<Point>>; 2], OutputError> {
        let mut curves = [Vec::new(), Vec::new()];
        let mut last: [(Vec<f64>, f64); 2] = std::array::from_fn(|_| (Vec::new(), f64::NEG_INFINITY));
        self.profiles(Table::Slip, line, &mut |time, slip| {
            let k = usize::from(self.in_event(time));
            let (before, drawn) = &mut last[k];
            let apart = before.is_empty() || before.iter().zip(slip).any(|(a, b)| (a - b).abs() >= least);
            let spacing = self.spacing.map_or(0.0, |all| all[k] * multiples[k] * (1.0 - ROUNDING));
            if apart && time - *drawn >= if multiples[k] > 1.0 { spacing } else { 0.0 } {
                (*before, *drawn) = (slip.to_vec(), time);
                curves[k].push(slip.iter().zip(&line.along).map(|(s, a)| place(*s, *a)).collect());
            }
        })?;
        Ok(curves)
    }

    /// Multiples of the times between profiles at which contours are drawn, between events and in them: 1, 2, 5, 10 and so on.
    fn multiples(&self) -> [f64; 2] {
        let Some(spacing) = self.spacing else { return [1.0; 2] };
        let longest = |spans: &mut dyn Iterator<Item = f64>| spans.fold(0.0_f64, f64::max);
        let within = longest(&mut self.events.iter().map(|e| e[1] - e[0]));
        let between = longest(&mut self.events.windows(2).map(|w| w[1][0] - w[0][1]));
        let of = |time: f64, spacing: f64| {
            let powers = (0..12).map(|k| 10.0_f64.powi(k));
            let mut all = powers.flat_map(|power| [1.0, 2.0, 5.0].map(|digit| digit * power));
            all.find(|m| time <= MOST_CONTOURS * m * spacing).unwrap_or(1.0)
        };
        [of(between, spacing[0]), of(within, spacing[1])]
    }

    /// Time between contours as text.
    fn interval(&self, kind: usize, multiple: f64) -> String {
        let Some(spacing) = self.spacing.filter(|_| multiple > 1.0) else {
            return self.intervals[kind].clone();
        };
        let time = multiple * spacing[kind];
        let unit = TIME.choose(time);
        let value = format!("{:.3}", time / unit.factor);
        format!("{} {}", value.trim_end_matches('0').trim_end_matches('.'), unit.name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Tables in memory.
    #[derive(Default)]
    struct MemoryTables {
        largest: Vec<Vec<f64>>,
        slip: Vec<Vec<f64>>,
        rate: Vec<Vec<f64>>,
        coupling: Vec<Vec<f64>>,
        station: Vec<Vec<f64>>,
    }

    impl Rows for MemoryTables {
        fn each(&self, table: Table, look: &mut dyn FnMut(&[f64])) -> Result<(), OutputError> {
            let rows = match table {
                Table::Largest => &self.largest,
                Table::Slip => &self.slip,
                Table::Rate => &self.rate,
                Table::State | Table::Coupling => &self.coupling,
            };
            rows.iter().for_each(|row| look(row));
            Ok(())
        }

        fn station(&self, _: &str, look: &mut dyn FnMut(&[f64])) -> Result<(), OutputError> {
            self.station.iter().for_each(|row| look(row));
            Ok(())
        }
    }

    fn kept() -> MemoryTables {
        MemoryTables {
            largest: vec![
                vec![0.0, -9.0, 0.0, 3e7, 0.0],
                vec![1e9, 0.5, 0.0, 2.5e7, 0.0],
                vec![2e9, -9.0, 0.0, 2.7e7, 0.0],
            ],
            slip: vec![vec![0.0, 9.0, 0.0, 0.0, 0.0], vec![1e9, 9.0, 1.0, 2.0, 3.0]],
            rate: vec![vec![0.0, 0.0, -9.0, -9.0, -9.0], vec![1e9, 0.0, 0.5, -3.0, -9.0]],
            coupling: vec![
                vec![0.0, 9.0, 1.0, 0.5, 0.0],
                vec![0.5e9, 9.0, 0.9, 0.4, -30.0],
                vec![1.5e9, 9.0, 0.8, 0.3, f64::NAN],
            ],
            station: vec![vec![0.0, 0.0, -9.0, 20.0], vec![1.0, 0.0, 0.0, 25.0], vec![2.0, 0.0, -8.0, 21.0]],
        }
    }

    fn sample(rows: &MemoryTables) -> Cycles<'_> {
        Cycles {
            title: "t".into(),
            lines: vec![Line {
                name: "main".into(),
                columns: 1..4,
                along: vec![0.0, 1e4, 4e4],
                mapped: vec![MappedQuantity::Theta, MappedQuantity::Coupling],
            }],
            rows,
            spacing: None,
            chosen: vec![("midway".into(), 0.6e9), ("before".into(), 0.89e9)],
            stations: Vec::new(),
            events: vec![[0.9e9, 1.1e9]],
            intervals: ["2.5 d".into(), "3 min".into()],
            window: None,
            paper: Paper::default(),
        }
    }

    #[test]
    fn every_fault_along_a_line_has_its_figures() {
        let names: Vec<String> = sample(&kept()).figures().0.into_iter().map(|f| f.0).collect();
        assert_eq!(
            names,
            [
                "largest_rate",
                "phase_portrait",
                "main_slip",
                "main_rate",
                "main_state",
                "main_coupling",
                "main_coupling_profiles"
            ]
        );
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
        let figure = cycles.map(&cycles.lines[0], MappedQuantity::Rate).unwrap().unwrap();
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
        let empty = MemoryTables::default();
        assert!(sample(&empty).figures().0.is_empty());
    }

    fn text(shape: &super::super::figure::Shape) -> Option<&str> {
        match shape {
            super::super::figure::Shape::Text(text) => Some(text.text.as_str()),
            _ => None,
        }
    }

    fn texts(figure: &Figure) -> Vec<&str> {
        figure.shapes.iter().filter_map(text).collect()
    }

    #[test]
    fn coupling_has_the_colours_of_zero_to_one_and_its_profiles_their_names() {
        let kept = kept();
        let cycles = sample(&kept);
        let map = cycles.map(&cycles.lines[0], MappedQuantity::Coupling).unwrap().unwrap();
        assert!(texts(&map).contains(&"Coupling [–], below 0 as 0"), "{:?}", texts(&map));
        let profiles = cycles.coupling(&cycles.lines[0]).unwrap().unwrap();
        assert!(["midway", "before"].iter().all(|name| texts(&profiles).contains(name)));
        let none = Cycles { chosen: Vec::new(), ..sample(&kept) };
        assert!(none.coupling(&none.lines[0]).unwrap().is_none());
    }

    #[test]
    fn the_phase_portrait_is_of_stations_where_there_are_any_and_its_title_has_which() {
        let kept = kept();
        let station =
            Portrait { name: "10 km".into(), path: "s".into(), rate: vec![2], shear: vec![3], unit: 1e6 };
        let of = |stations| {
            let cycles = Cycles { stations, ..sample(&kept) };
            let figure = cycles.portrait().unwrap().unwrap();
            texts(&figure).iter().map(|t| (*t).to_string()).collect::<Vec<_>>()
        };
        let stations = of(vec![station]);
        assert!(stations.iter().any(|t| t == "t: phase portrait of stations that slip in events"));
        assert!(
            stations.iter().any(|t| t == "10 km") && stations.iter().any(|t| t == "Shear traction [MPa]")
        );
        assert!(of(Vec::new()).iter().any(|t| t == "t: phase portrait of means over all points"));
    }

    #[test]
    fn legends_of_contours_tell_the_intervals_of_the_run() {
        let kept = kept();
        let cycles = sample(&kept);
        let figure = cycles.contours(&cycles.lines[0]).unwrap().unwrap();
        let texts = texts(&figure);
        assert!(
            texts.contains(&"between events, every 2.5 d") && texts.contains(&"in events, every 3 min"),
            "{texts:?}"
        );
        // An event of 2e8 s with profiles every 1e6 s would have 200 contours.
        let many = Cycles { spacing: Some([1e9, 1e6]), ..sample(&kept) };
        assert_eq!(many.multiples(), [1.0, 5.0]);
        assert_eq!([many.interval(0, 1.0), many.interval(1, 5.0)], ["2.5 d", "57.87 d"]);
    }
}
