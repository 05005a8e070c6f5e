//! Maps of a fault in space at chosen times, from the snapshots of a run.

use super::tables::Tables;
use super::{NamedFigures, Sheet};
use crate::OutputError;
use crate::fields::vtu;
use crate::figures::paper::Paper;
use crate::figures::rupture::{Shape, StillMap};
use crate::words::time as time_text;
use serde::{Deserialize, Serialize};

/// A fault in space at chosen times.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Stills {
    /// Beginning of the file names.
    pub stem: String,
    /// Name of the fault.
    pub name: String,
    /// Beginning of the paths of its snapshots, which a number of five digits and `.vtu` follow.
    pub snapshots: String,
    /// Table of the snapshots: their numbers and times.
    pub list: String,
    /// Number of its shape.
    pub shape: usize,
    /// Words for the file names, words for the titles and times \[s\]: the last snapshot until then is shown.
    pub chosen: Vec<(String, String, f64)>,
    /// Quantities.
    pub stills: Vec<Still>,
}

/// A quantity of a snapshot.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Still {
    /// Name of its array.
    pub array: String,
    /// End of the file names.
    pub file: String,
    /// Name in titles.
    pub name: String,
    /// Label of its colours.
    pub label: String,
    /// Values at the ends of the colours; those of the snapshot where there are none.
    pub range: Option<(f64, f64)>,
    /// Largest difference of values that the colours show, below the largest value.
    pub span: Option<f64>,
}

impl Sheet {
    pub(super) fn stills(
        &self,
        stills: &Stills,
        tables: &Tables<'_>,
        paper: Paper,
    ) -> Result<NamedFigures, OutputError> {
        let Some(Shape::Surface(surface)) = self.shapes.get(stills.shape) else { return Ok(Vec::new()) };
        let mut found: Vec<Option<(usize, f64)>> = vec![None; stills.chosen.len()];
        tables.shown(&stills.list, &mut |row| {
            // Times are in the second column of the list.
            for ((_, _, until), found) in stills.chosen.iter().zip(&mut found) {
                if row[1] <= *until {
                    *found = Some((row[0] as usize, row[1]));
                }
            }
        })?;
        let mut figures = Vec::new();
        for ((file, when, _), found) in stills.chosen.iter().zip(found) {
            let Some((number, time)) = found else { continue };
            let path = tables.folder.join(format!("{}{number:05}.vtu", stills.snapshots));
            for still in &stills.stills {
                let values = vtu::array(&path, &still.array)?;
                let map = StillMap {
                    title: self.title.clone(),
                    what: format!("{} of {}, {when}, t = {}", still.name, stills.name, time_text(time)),
                    label: still.label.clone(),
                    range: still.range,
                    span: still.span,
                };
                let figure = map.figure(surface, &values, paper);
                let name = format!("{}_{file}_{}", stills.stem, still.file);
                figures.extend(figure.map(|figure| (name, figure)));
            }
        }
        Ok(figures)
    }
}
