//! Tables of a value over time, in a scene or in a file.

use crate::defaults;
use crate::key_default::usual;
use crate::spanned::Spanned;
use crate::units::{Dimension, Time};
use schemars::JsonSchema;
use serde::Deserialize;
use std::ops::Deref;

/// A value over time: pairs of time since the stage began \[s\] and value in SI units, linear in between.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TimeSeries {
    /// The pairs; those of a file once it has been read.
    points: Vec<(f64, f64)>,
    /// The file that has them.
    file: Option<TableFile>,
}

impl TimeSeries {
    /// A table that a file has.
    #[must_use]
    pub fn in_file(file: TableFile) -> Self {
        Self { points: Vec::new(), file: Some(file) }
    }

    /// The file that has the pairs.
    #[must_use]
    pub fn file(&self) -> Option<&TableFile> {
        self.file.as_ref()
    }

    /// Sets the pairs to those that have been read from the file.
    pub fn fill(&mut self, read: Self) {
        self.points = read.points;
    }

    /// The part over a stage that begins at the time `from`, with times since then, up to its `duration` if it is known; `None` if
    /// there is no entry in it. Of two entries at one time, a jump, the stage has that within it. Values that `hold` are those of
    /// the entry before, others linear in between.
    #[must_use]
    pub fn part(&self, from: f64, duration: Option<f64>, hold: bool) -> Option<Self> {
        let points = &self.points;
        let end = duration.map_or(f64::INFINITY, |duration| from + duration);
        let begin = points.partition_point(|p| p.0 <= from);
        let stop = points.partition_point(|p| p.0 < end);
        let last = points.last().filter(|last| from < last.0)?;
        let between = |k: usize, t: f64| {
            let ((t0, v0), (t1, v1)) = (points[k - 1], points[k]);
            if hold { v0 } else { v0 + (v1 - v0) * ((t - t0) / (t1 - t0)) }
        };
        let first = (begin > 0).then(|| (0.0, between(begin, from)));
        let inside = points[begin..stop].iter().map(|&(t, v)| (t - from, v));
        let cut =
            duration.filter(|_| end <= last.0 && stop > 0).map(|duration| (duration, between(stop, end)));
        let all: Vec<(f64, f64)> = first.into_iter().chain(inside).chain(cut).collect();
        (!all.is_empty()).then(|| all.into())
    }
}

impl From<Vec<(f64, f64)>> for TimeSeries {
    fn from(points: Vec<(f64, f64)>) -> Self {
        Self { points, file: None }
    }
}

impl Deref for TimeSeries {
    type Target = [(f64, f64)];

    fn deref(&self) -> &Self::Target {
        &self.points
    }
}

/// Columns of time and value in a CSV file.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TableFile {
    /// Path of a CSV file, relative to the folder of the scene.
    pub file: Spanned<String>,
    /// Column of the values.
    pub column: Spanned<String>,
    /// Column of the times since the stage began.
    #[schemars(extend("x-default" = usual(defaults::TIME_COLUMN)))]
    pub time: Option<Spanned<String>>,
    /// Time in the file at which the stage begins; entries outside the stage are then left out \[s\].
    pub from: Option<Spanned<Time>>,
    /// `true`: values count from the first of the column, as those of an instrument that is set to zero.
    pub tare: Option<Spanned<bool>>,
}

/// A table that a file may fill.
pub(crate) struct TableOver<'a> {
    /// The table.
    pub table: &'a mut TimeSeries,
    /// Dimension of its values.
    pub dimension: Dimension,
    /// Keys under which it stands, as the table of plausible values has them.
    pub keys: &'static [&'static str],
    /// Duration of its stage, if it belongs to one \[s\].
    pub duration: Option<f64>,
    /// True if each value holds until the next entry; others are linear in between.
    pub holds: bool,
}

#[cfg(test)]
mod tests {
    use super::TimeSeries;

    const RECORD: [(f64, f64); 4] = [(0.0, 1.0), (10.0, 3.0), (10.0, 5.0), (20.0, 5.0)];

    fn part(record: &[(f64, f64)], from: f64, duration: Option<f64>, hold: bool) -> Option<Vec<(f64, f64)>> {
        TimeSeries::from(record.to_vec()).part(from, duration, hold).map(|part| part.to_vec())
    }

    #[test]
    fn parts_of_a_record_meet_where_stages_do() {
        let stages = [(0.0, 4.0), (4.0, 8.0), (12.0, 8.0)]
            .map(|(from, t)| part(&RECORD, from, Some(t), false).unwrap());
        assert_eq!(stages[0], [(0.0, 1.0), (4.0, 1.8)]);
        assert_eq!(stages[1], [(0.0, 1.8), (6.0, 3.0), (6.0, 5.0), (8.0, 5.0)]);
        assert_eq!(stages[2], [(0.0, 5.0), (8.0, 5.0)]);
    }

    #[test]
    fn a_jump_at_a_joint_belongs_to_neither_stage() {
        assert_eq!(part(&RECORD, 8.0, Some(2.0), false).unwrap(), [(0.0, 2.6), (2.0, 3.0)]);
        assert_eq!(part(&RECORD, 10.0, Some(5.0), false).unwrap(), [(0.0, 5.0), (5.0, 5.0)]);
    }

    #[test]
    fn a_value_that_holds_is_that_of_the_entry_before() {
        assert_eq!(part(&RECORD, 4.0, None, true).unwrap()[..2], [(0.0, 1.0), (6.0, 3.0)]);
    }

    #[test]
    fn a_record_may_begin_late_or_end_early_within_its_stage() {
        assert_eq!(part(&RECORD[1..], 5.0, Some(2.0), false), None);
        assert_eq!(part(&RECORD, 15.0, Some(50.0), false).unwrap(), [(0.0, 5.0), (5.0, 5.0)]);
        assert_eq!(part(&RECORD, 15.0, None, false).unwrap(), [(0.0, 5.0), (5.0, 5.0)]);
        assert_eq!(part(&RECORD, 20.0, Some(1.0), false), None);
    }
}
