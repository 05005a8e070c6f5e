//! Curves, from tables of a run or kept.

use super::event::EventOnset;
use super::request::FigureRequest;
use super::tables::Tables;
use crate::figures::chart::{Chart, Measure};
use crate::{OutputError, numbers};
use serde::{Deserialize, Serialize};

/// Curves in one frame.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Curves {
    /// Stem of the file names.
    pub file: String,
    /// Title of the scene.
    pub title: String,
    /// Name and quantity of the horizontal axis.
    pub x: (String, Measure),
    /// Name and quantity of the vertical axis.
    pub y: (String, Measure),
    /// Names and points of the curves.
    pub curves: Vec<(String, Points)>,
    /// The event that they are of; otherwise the curves are of a run through time.
    pub event: Option<EventOnset>,
    /// True if curves that are zero throughout are left out.
    pub without_zero: bool,
    /// Share of the largest value at whose last crossing a curve ends, if it ends before its last point.
    pub until: Option<f64>,
    /// True if curves come in pairs of one colour, the second dashed: a value and its reference.
    #[serde(default)]
    pub pairs: bool,
}

/// Points of a curve.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum Points {
    /// Columns of a table in the output directory, counted from 0.
    Table {
        /// Path of the table.
        table: String,
        /// Column of the horizontal axis.
        x: usize,
        /// Column of the vertical axis.
        y: usize,
        /// True if only the sizes of the horizontal axis are shown.
        size: bool,
    },
    /// A linear function of a column of a table over its first one, the time.
    Linear {
        /// Path of the table.
        table: String,
        /// True for a table whose columns are apart by spaces, as those of stations are.
        spaced: bool,
        /// The column, counted from 0.
        column: usize,
        /// True if the logarithm of its size counts.
        logarithm: bool,
        /// Value where the column is 0.
        at_zero: f64,
        /// Value per value of the column.
        slope: f64,
    },
    /// Points kept beside the tables, which no table has.
    Kept {
        /// Times \[s\]; empty where the horizontal axis is time, or is not of a run through time.
        times: Vec<f64>,
        /// Values along the horizontal axis.
        #[serde(deserialize_with = "numbers::or_nan")]
        x: Vec<f64>,
        /// Values along the vertical axis.
        #[serde(deserialize_with = "numbers::or_nan")]
        y: Vec<f64>,
    },
}

impl Points {
    /// Points of a curve over time.
    #[must_use]
    pub fn over_time(points: impl Iterator<Item = (f64, f64)>) -> Self {
        let (x, y) = points.unzip();
        Self::Kept { times: Vec::new(), x, y }
    }

    fn read(
        &self,
        tables: &Tables<'_>,
        request: &FigureRequest,
        through_time: bool,
    ) -> Result<Vec<(f64, f64)>, OutputError> {
        let mut points = Vec::new();
        match self {
            Self::Table { table, x, y, size } => {
                let mut look = |row: &[f64]| {
                    if let (Some(&x), Some(&y)) = (row.get(*x), row.get(*y)) {
                        points.push((if *size { x.abs() } else { x }, y));
                    }
                };
                if through_time { tables.shown(table, &mut look)? } else { tables.each(table, &mut look)? }
            }
            Self::Linear { table, spaced, column, logarithm, at_zero, slope } => {
                let mut look = |row: &[f64]| {
                    if let (Some(&time), Some(&value)) = (row.first(), row.get(*column)) {
                        let value = if *logarithm { value.abs().log10() } else { value };
                        points.push((time, at_zero + slope * value));
                    }
                };
                if *spaced {
                    tables.station_shown(table, &mut look)?
                } else {
                    tables.shown(table, &mut look)?
                }
            }
            Self::Kept { times, x, y } => {
                let times = if times.is_empty() { x } else { times };
                let all = times.iter().zip(x.iter().zip(y));
                let shown = all.filter(|(time, _)| !through_time || request.shows(**time));
                points.extend(shown.map(|(_, (x, y))| (*x, *y)));
            }
        }
        Ok(points)
    }
}

impl Curves {
    /// The curves with their points within the window.
    pub(super) fn chart(&self, tables: &Tables<'_>) -> Result<Chart, OutputError> {
        let through_time = self.event.is_none();
        let mut curves = Vec::new();
        for (name, points) in &self.curves {
            let mut points = points.read(tables, tables.request, through_time)?;
            if let Some(share) = self.until {
                without_tail(&mut points, share);
            }
            if !self.without_zero || points.iter().any(|p| p.1 != 0.0) {
                curves.push((name.clone(), points));
            }
        }
        let (file, title) = (self.file.clone(), self.title.clone());
        let pairs = self.pairs;
        Ok(Chart { file, title, x: self.x.clone(), y: self.y.clone(), curves, pairs })
    }

    /// First time shown \[s\].
    pub(super) fn start(&self, request: &FigureRequest) -> f64 {
        if self.event.is_none() { request.start() } else { 0.0 }
    }
}

/// Cuts a curve where it has fallen below a share of its largest value for good.
fn without_tail(curve: &mut Vec<(f64, f64)>, share: f64) {
    let most = curve.iter().map(|p| p.1).fold(0.0, f64::max);
    if let Some(last) = curve.iter().rposition(|p| p.1 >= share * most) {
        curve.truncate(last + 2);
    }
}
