//! Histories of points of bodies, of forces on sets and of springs in runs that write them by change, as CSV.

use super::tables::{force_columns, point_columns, point_values, spring_columns};
use super::view::{ForceMark, PointMark, Samples, SpringMark};
use crate::OutputFile;
use crate::names::stems;
use crate::tables::Column;
use crate::tables::describe::FileParts;
use crate::tables::history::number;

/// Points of bodies.
pub(super) const POINTS: OutputFile =
    OutputFile::new("points/*.csv", "positions in bodies, at every step (CSV)");
/// Forces on sets.
pub(super) const FORCES: OutputFile = OutputFile::new("forces/*.csv", "forces on sets, at every step (CSV)");
/// Springs.
pub(super) const SPRINGS: OutputFile = OutputFile::new("springs/*.csv", "springs, at every step (CSV)");

/// Points, sets and springs that are sampled.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SampleSites {
    /// Points.
    pub points: Vec<PointMark>,
    /// Sets whose forces are sampled.
    pub forces: Vec<ForceMark>,
    /// Springs.
    pub springs: Vec<SpringMark>,
    /// Unit of forces.
    pub unit: &'static str,
}

impl SampleSites {
    /// Paths of the files below the folder of a run, with their columns: points, then forces, then springs.
    #[must_use]
    pub fn tables(&self) -> Vec<FileParts<Column>> {
        let springs: Vec<String> = self.springs.iter().map(SpringMark::name).collect();
        let all: [(OutputFile, Vec<&str>, Vec<Column>); 3] = [
            (POINTS, self.points.iter().map(|p| p.name.as_str()).collect(), point_columns()),
            (FORCES, self.forces.iter().map(|f| f.name.as_str()).collect(), force_columns(self.unit)),
            (SPRINGS, springs.iter().map(String::as_str).collect(), spring_columns(self.unit)),
        ];
        let of = |(place, names, columns): (OutputFile, Vec<&str>, Vec<Column>)| {
            let file = |stem: String| FileParts::new(place.named(&stem), columns.clone());
            stems(names.into_iter()).into_iter().map(file).collect::<Vec<_>>()
        };
        all.into_iter().flat_map(of).collect()
    }

    /// Row of each file at a time \[s\] of a stage, after a number of steps.
    #[must_use]
    pub fn rows(&self, time: f64, stage: usize, step: u64, samples: &Samples) -> Vec<String> {
        let when = || [format!("{time:.14e}"), stage.to_string(), step.to_string()].into_iter();
        let row = |values: &[f64]| line(when().chain(values.iter().map(|&v| number(v))));
        let points = samples.points.iter().map(|p| row(&point_values(p)));
        let forces = samples.forces.iter().map(|f| row(f));
        let springs = samples.springs.iter().map(|s| {
            let s = s.unwrap_or_default();
            row(&[s.load_point, s.displacement, s.force, s.friction])
        });
        points.chain(forces).chain(springs).collect()
    }
}

fn line(cells: impl Iterator<Item = String>) -> String {
    let mut line = cells.collect::<Vec<String>>().join(",");
    line.push('\n');
    line
}
