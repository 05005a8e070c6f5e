//! Phase portrait: shear traction against slip rate.

use super::{Cycles, FigureResult, Table};
use crate::OutputError;
use crate::figures::axes::Axis;
use crate::figures::curves::DECADES;
use crate::figures::figure::Point;
use crate::figures::framed_figure::FramedFigure;
use crate::figures::legend::Entry;
use crate::figures::style::Style;
use crate::figures::title::title;
use crate::units::STRESS;
use serde::{Deserialize, Serialize};

/// A station of the phase portrait.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Portrait {
    /// Name.
    pub name: String,
    /// Path of its file.
    pub path: String,
    /// Columns of log10 of the slip rate \[m/s\], one of each component, counted from 0.
    pub rate: Vec<usize>,
    /// Columns of the shear traction.
    pub shear: Vec<usize>,
    /// Unit of the shear traction \[Pa\].
    pub unit: f64,
}

/// Distance below which points of the phase portrait coincide: half a pixel of a screen.
const NEAR: f64 = 0.5;
/// Largest number of points of a curve, enough for some hundred cycles; later ones lie on top of these.
const MOST_POINTS: usize = 200_000;
/// Largest number of stations, more than a reader follows.
const MOST_STATIONS: usize = 8;

/// A name and pairs of slip rate \[m/s\] and shear traction \[Pa\].
type Curve = (String, Vec<(f64, f64)>);

impl Portrait {
    fn pair(&self, row: &[f64]) -> Option<(f64, f64)> {
        let all =
            |columns: &[usize]| columns.iter().map(|&c| row.get(c).copied()).collect::<Option<Vec<f64>>>();
        let size = |values: Vec<f64>| match values.as_slice() {
            [one] => *one,
            several => several.iter().map(|v| v * v).sum::<f64>().sqrt(),
        };
        let rates = all(&self.rate)?.into_iter().map(|log| 10.0_f64.powf(log)).collect();
        Some((size(rates), size(all(&self.shear)?) * self.unit))
    }
}

impl Cycles<'_> {
    /// Curves of stations that slip in events or, without any, of means over all points.
    fn phases(&self) -> Result<Vec<Curve>, OutputError> {
        let mut curves = Vec::new();
        for station in self.stations.iter().take(MOST_STATIONS) {
            let mut pairs = Vec::new();
            self.rows.station(&station.path, &mut |row| {
                if self.window.is_none_or(|[from, to]| from <= row[0] && row[0] <= to) {
                    pairs.extend(station.pair(row));
                }
            })?;
            curves.push((station.name.clone(), pairs));
        }
        if curves.is_empty() {
            let mut pairs = Vec::new();
            self.rows.each(Table::Largest, &mut |row| pairs.push((10.0_f64.powf(row[1]), row[3])))?;
            curves.push((String::new(), pairs));
        }
        for (_, pairs) in &mut curves {
            pairs.retain(|p| p.0.is_finite() && p.1.is_finite());
        }
        curves.retain(|(_, pairs)| !pairs.is_empty());
        Ok(curves)
    }

    /// The portrait. Points that only creep have no curve: they would hide the cycles of the others.
    pub(super) fn portrait(&self) -> FigureResult {
        let curves = self.phases()?;
        let all = || curves.iter().flat_map(|c| &c.1);
        let Some(largest) = all().map(|p| p.1.abs()).reduce(f64::max) else { return Ok(None) };
        let unit = STRESS.choose(largest);
        let of_means = self.stations.is_empty();
        let [rate, shear, what] = if of_means {
            ["Largest slip rate", "Mean shear traction", "means over all points"]
        } else {
            ["Slip rate", "Shear traction", "stations that slip in events"]
        };
        let x = Axis::logarithmic(all().map(|p| p.0), DECADES, format!("{rate} [m/s]"));
        let y = Axis::linear(all().map(|p| p.1 / unit.factor), 0.05, format!("{shear} [{}]", unit.name));
        let entry = |(k, (name, _)): (usize, &Curve)| Entry {
            name: name.clone(),
            colour: Style::from_curve(k).colour,
            dash: Style::from_curve(k).dash,
        };
        let named = curves.iter().enumerate().filter(|_| !of_means);
        let mut page = FramedFigure::new(self.paper, x, y, &named.map(entry).collect::<Vec<_>>());
        let FramedFigure { figure, frame, .. } = &mut page;
        title(figure, frame, &self.title, &format!("phase portrait of {what}"));
        frame.grid(figure);
        for (k, (_, pairs)) in curves.iter().enumerate() {
            let mut curve: Vec<Point> = Vec::new();
            for (rate, shear) in pairs {
                let (x, y) = frame.point(*rate, shear / unit.factor);
                let apart = curve.last().is_none_or(|last| (x - last.0).hypot(y - last.1) >= NEAR);
                if apart && curve.len() < MOST_POINTS {
                    curve.push((x, y));
                }
            }
            figure.dashed(curve, Style::from_curve(k).dash, 1.2, Style::from_curve(k).colour);
        }
        Ok(Some(page.finish()))
    }
}
