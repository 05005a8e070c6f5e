//! Coupling along a line at chosen times.

use super::{Cycles, FigureResult, Line, Table};
use crate::figures::axes::Axis;
use crate::figures::figure::Point;
use crate::figures::framed_figure::FramedFigure;
use crate::figures::legend::Entry;
use crate::figures::style::Style;
use crate::figures::title::title;

/// Least coupling shown: where a rupture nucleates or afterslip decays, it is far below.
const LEAST: f64 = -0.25;
/// Largest coupling shown, a little beyond that of a locked point.
const MOST: f64 = 1.05;

impl Cycles<'_> {
    /// The last profile of coupling up to each of the chosen times.
    pub(super) fn coupling(&self, line: &Line) -> FigureResult {
        let Some((y, scale)) = Self::along(line) else { return Ok(None) };
        let mut found: Vec<Option<Vec<f64>>> = vec![None; self.chosen.len()];
        self.profiles(Table::Coupling, line, &mut |time, values| {
            for ((_, until), found) in self.chosen.iter().zip(&mut found) {
                if time <= *until {
                    *found = Some(values.to_vec());
                }
            }
        })?;
        if found.iter().flatten().next().is_none() {
            return Ok(None);
        }
        let x = Axis::exact([LEAST, MOST], format!("Coupling [–], shown from {LEAST}").replace('-', "−"));
        let named = self.chosen.iter().zip(&found).enumerate().filter(|(_, (_, found))| found.is_some());
        let entry = |(k, ((name, _), _)): (usize, (&(String, f64), _))| Entry {
            name: name.clone(),
            colour: Style::from_curve(k).colour,
            dash: Style::from_curve(k).dash,
        };
        let entries: Vec<Entry> = named.map(entry).collect();
        let mut page = FramedFigure::new(self.paper, x, y, &entries);
        let FramedFigure { figure, frame, .. } = &mut page;
        title(figure, frame, &self.title, &format!("coupling of {}", line.name));
        frame.grid(figure);
        let shown = |c: f64| (LEAST..=MOST).contains(&c);
        for (k, profile) in found.iter().enumerate() {
            let points: Vec<(f64, f64)> =
                profile.iter().flatten().copied().zip(line.along.iter().copied()).collect();
            for piece in points.split(|p| !shown(p.0)).filter(|piece| piece.len() > 1) {
                let curve: Vec<Point> = piece.iter().map(|&(c, at)| frame.point(c, at / scale)).collect();
                let style = Style::from_curve(k);
                figure.dashed(curve, style.dash, 1.8, style.colour);
            }
        }
        Ok(Some(page.finish()))
    }
}
