//! Plots of dynamic rupture: slip rate over space and time, at successive times, and the time at which each point ruptures.
//!
//! Each plot reads the profiles of slip rate from the first to the last. Memory does not grow with their number.

mod arrivals;
mod film_strips;
mod isolines;
mod slip;
mod space_time;
mod still_map;
mod strip;
mod surface;

pub use surface::Surface;

use super::axes::Axis;
use super::figure::{Figure, Point};
use super::paper::Paper;
use crate::OutputError;
use crate::stems;
use crate::units::LENGTH;
pub(super) use film_strips::{VelocityFrame, moment, velocities};
use serde::{Deserialize, Serialize};
pub(super) use slip::EventOnFault;
use std::ops::Range;
pub(super) use still_map::StillMap;

/// Points of a fault as a figure shows them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Shape {
    /// Along a line.
    Line(Line),
    /// On a surface.
    Surface(Surface),
}

/// Points along a line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Line {
    /// Name of the coordinate.
    pub label: String,
    /// Coordinates of the points, in any order \[m\].
    pub along: Vec<f64>,
    /// True if the coordinate grows downwards.
    pub down: bool,
}

/// A fault and the times at which it ruptured.
#[derive(Clone, Debug)]
pub(super) struct RupturedFault {
    /// Name.
    pub name: String,
    /// Range of its points in the profiles.
    pub points: Range<usize>,
    /// Positions of its points.
    pub shape: Shape,
    /// Rupture times of its points \[s\]; NaN where it did not rupture.
    pub arrivals: Vec<f64>,
}

/// Access to the profiles of a run.
pub(super) trait Profiles {
    /// Passes the times \[s\] and the slip rates of all points \[m/s\] to `look`, from the first to the last.
    ///
    /// # Errors
    /// If the profiles cannot be read.
    fn each(&self, look: &mut dyn FnMut(f64, &[f64])) -> Result<(), OutputError>;
}

/// Plots of a run.
pub(super) struct Ruptures<'a> {
    /// Title of the scene.
    pub title: String,
    /// Faults.
    pub faults: Vec<RupturedFault>,
    /// Profiles of slip rate.
    pub rates: &'a dyn Profiles,
    /// Size of the figures.
    pub paper: Paper,
}

/// Position of the frame.
const AT: Point = (84.0, 40.0);
/// Size of the frame.
const SIZE: Point = (420.0, 300.0);
/// Width right of the frame for a colour bar.
const ROOM: f64 = 136.0;
/// Height below the frame for numbers and a label, and for a note below them.
const BELOW: [f64; 2] = [60.0, 84.0];

/// Largest size of a map with a colour bar.
fn room(paper: Paper) -> Point {
    paper.frame(SIZE, (AT.0 + ROOM, AT.1 + BELOW[1]))
}

type FigureResult = Result<Option<Figure>, OutputError>;

impl Ruptures<'_> {
    /// All figures with their file names.
    pub(super) fn figures(&self) -> Result<Vec<(String, Figure)>, OutputError> {
        let mut figures = Vec::new();
        let mut add = |name: String, figure: Option<Figure>| figures.extend(figure.map(|f| (name, f)));
        for (stem, fault) in stems(self.faults.iter().map(|f| f.name.as_str())).iter().zip(&self.faults) {
            add(format!("{stem}_rupture_times"), self.arrivals(fault));
            add(format!("{stem}_slip_rate"), self.space_time(fault)?);
            add(format!("{stem}_film"), self.successive(fault)?);
        }
        Ok(figures)
    }

    /// Number of profiles, and the times of the first and last.
    fn span(&self) -> Result<Option<(usize, f64, f64)>, OutputError> {
        let mut span: Option<(usize, f64, f64)> = None;
        self.rates.each(&mut |time, _| {
            span = Some(span.map_or((1, time, time), |(count, first, _)| (count + 1, first, time)));
        })?;
        Ok(span.filter(|(count, first, last)| *count > 1 && last > first))
    }
}

impl Line {
    /// Indices of the points in ascending order of the coordinate.
    fn order(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.along.len()).collect();
        order.sort_by(|&a, &b| self.along[a].total_cmp(&self.along[b]));
        order
    }

    /// Axis of the coordinate and its unit \[m\]; upright axes of coordinates that grow downwards fall. `None` without an extent.
    fn axis(&self, upright: bool) -> Option<(Axis, f64)> {
        let bounds = |low: fn(f64, f64) -> f64| self.along.iter().copied().reduce(low);
        let (lo, hi) = (bounds(f64::min)?, bounds(f64::max)?);
        let unit = LENGTH.choose(lo.abs().max(hi.abs()));
        let (from, to) = if upright && self.down { (hi, lo) } else { (lo, hi) };
        let label = format!("{} [{}]", self.label, unit.name);
        (hi > lo).then(|| (Axis::exact([from / unit.factor, to / unit.factor], label), unit.factor))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Profiles in memory.
    pub(super) struct MemoryProfiles(pub Vec<(f64, Vec<f64>)>);

    impl Profiles for MemoryProfiles {
        fn each(&self, look: &mut dyn FnMut(f64, &[f64])) -> Result<(), OutputError> {
            self.0.iter().for_each(|(time, rates)| look(*time, rates));
            Ok(())
        }
    }

    /// A pulse that leaves the origin at 1 km/s in both directions.
    pub(super) fn pulse() -> MemoryProfiles {
        let rate = |time: f64, x: f64| if x.abs() < 1e3 * time { (x.abs() / 1e3 - time).exp() } else { 0.0 };
        let row = |k: u32| {
            let time = f64::from(k) * 0.1;
            (time, (-20..=20).map(|i| rate(time, f64::from(i) * 100.0)).collect())
        };
        MemoryProfiles((0..=20).map(row).collect())
    }

    pub(super) fn line() -> RupturedFault {
        let along: Vec<f64> = (-20..=20).map(|i| f64::from(i) * 100.0).collect();
        let arrivals = along.iter().map(|x| x.abs() / 1e3).collect();
        let shape = Shape::Line(Line { label: "x".into(), along, down: false });
        RupturedFault { name: "main".into(), points: 0..41, shape, arrivals }
    }

    #[test]
    fn every_fault_has_its_figures() {
        let kept = pulse();
        let ruptures =
            Ruptures { title: "t".into(), faults: vec![line()], rates: &kept, paper: Paper::default() };
        let names: Vec<String> = ruptures.figures().unwrap().into_iter().map(|f| f.0).collect();
        assert_eq!(names, ["main_rupture_times", "main_slip_rate", "main_film"]);
    }

    #[test]
    fn a_run_without_profiles_and_without_rupture_has_no_figures() {
        let kept = MemoryProfiles(Vec::new());
        let fault = RupturedFault { arrivals: vec![f64::NAN; 41], ..line() };
        let ruptures =
            Ruptures { title: "t".into(), faults: vec![fault], rates: &kept, paper: Paper::default() };
        assert!(ruptures.figures().unwrap().is_empty());
    }

    #[test]
    fn a_depth_grows_downwards_only_on_upright_axes() {
        let line = Line { label: "Depth".into(), along: vec![0.0, 4e4], down: true };
        assert_eq!(line.axis(true).unwrap().0.range, (40.0, 0.0));
        assert_eq!(line.axis(false).unwrap().0.range, (0.0, 40.0));
    }
}
