//! Histories of sliders as CSV, with a row after each change or at requested times, and the data for plots.

use super::figures::{self, Source, Trace};
use super::thin::{Row, Thin};
use asperity_cycles::slider::{Problem, SliderState, Sliders};
use asperity_laws::Theta;
use asperity_ode::Control;
use asperity_output::decimals::{shortest, shortest_scientific};
use asperity_output::figures::{Plot, Sheet};
use asperity_output::tables::GrowingTable;
use asperity_output::tables::column::{self, Column, Sign};
use asperity_output::tables::describe::FileParts;
use asperity_output::{OutputError, OutputFile, atomic};
use asperity_run::{ObserveError, Observer};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// Histories of sliders.
pub const HISTORIES: OutputFile = OutputFile::new("history/*.csv", "sliders over time (CSV)");

/// Writes `history/<slider>.csv`; each file grows by whole rows.
#[derive(Debug)]
pub struct Histories {
    sliders: Vec<SliderRecord>,
    /// True if plots will be drawn.
    traced: bool,
}

/// Record of a slider.
#[derive(Debug, Default)]
struct SliderRecord {
    file: Option<GrowingTable>,
    thin: Thin,
    trace: Trace,
}

/// Position in the history of a slider.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Position {
    /// Size of its file \[bytes\], if it has one.
    bytes: Option<u64>,
    thin: Thin,
    trace: Trace,
}

/// Positions in all histories, for a checkpoint.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Positions {
    sliders: Vec<Position>,
    /// True if plots will be drawn.
    traced: bool,
}

impl Histories {
    /// Creates the files and writes their headers.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn create(out: &Path, problem: &Problem) -> Result<Self, OutputError> {
        Self::with_files(out, problem, |path, header, _| GrowingTable::create(path, header))
    }

    /// Resumes the files at their recorded positions; later rows are cut off.
    ///
    /// # Errors
    /// If a file is missing, shorter than it was, or cannot be written.
    pub fn resume(out: &Path, problem: &Problem, from: Positions) -> Result<Self, OutputError> {
        let bytes = |i: usize| from.sliders.get(i).and_then(|p| p.bytes).unwrap_or_default();
        let mut resumed = Self::with_files(out, problem, |path, _, i| GrowingTable::reopen(path, bytes(i)))?;
        for (kept, Position { thin, trace, .. }) in resumed.sliders.iter_mut().zip(from.sliders) {
            (kept.thin, kept.trace) = (thin, trace);
        }
        resumed.traced = from.traced;
        Ok(resumed)
    }

    /// Histories with files from `open`, which takes the path, the header and the number of the slider.
    fn with_files(
        out: &Path,
        problem: &Problem,
        open: impl Fn(PathBuf, &[u8], usize) -> Result<GrowingTable, OutputError>,
    ) -> Result<Self, OutputError> {
        atomic::writable_dir(out)?;
        let folder = out.join("history");
        let stems = asperity_output::stems(problem.names.iter().map(String::as_str));
        let mut sliders = Vec::new();
        for (i, (stem, slider)) in stems.iter().zip(problem.system.sliders()).enumerate() {
            let file = if problem.output.writes(i) {
                atomic::create_dir(&folder)?;
                let header = column::header(&columns(slider.law.states()));
                Some(open(folder.join(format!("{stem}.csv")), header.as_bytes(), i)?)
            } else {
                None
            };
            sliders.push(SliderRecord { file, ..SliderRecord::default() });
        }
        Ok(Self { sliders, traced: false })
    }

    /// Tables with their columns.
    #[must_use]
    pub fn tables(problem: &Problem) -> Vec<FileParts<Column>> {
        let stems = asperity_output::stems(problem.names.iter().map(String::as_str));
        let all = stems.iter().zip(problem.system.sliders()).enumerate();
        let written = all.filter(|(i, _)| problem.output.writes(*i));
        written
            .map(|(_, (stem, slider))| FileParts::new(HISTORIES.named(stem), columns(slider.law.states())))
            .collect()
    }

    /// Current positions in the histories.
    #[must_use]
    pub fn positions(&self) -> Positions {
        let of = |kept: &SliderRecord| Position {
            bytes: kept.file.as_ref().map(GrowingTable::bytes),
            thin: kept.thin.clone(),
            trace: kept.trace.clone(),
        };
        Positions { sliders: self.sliders.iter().map(of).collect(), traced: self.traced }
    }

    /// Waits until all rows are on the disc.
    ///
    /// # Errors
    /// If something could not be written.
    pub fn settle(&self) -> Result<(), OutputError> {
        self.sliders.iter().filter_map(|kept| kept.file.as_ref()).try_for_each(GrowingTable::settle)
    }

    /// Keeps the data for plots.
    #[must_use]
    pub fn traced(mut self) -> Self {
        self.traced = true;
        self
    }

    /// True if the data for plots are kept.
    #[must_use]
    pub fn are_traced(&self) -> bool {
        self.traced
    }

    /// Writes the last state if it has no row yet.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn finish(&mut self) -> Result<(), OutputError> {
        let traced = self.traced;
        self.sliders.iter_mut().try_for_each(|kept| match kept.thin.mark() {
            Some(row) => kept.add(&row, traced),
            None => Ok(()),
        })
    }

    /// Figures of a run up to a time \[s\]: of all sliders if plots were asked for from its start, otherwise of those with tables.
    #[must_use]
    pub fn sheet(&self, problem: &Problem, thetas: &[Option<Theta>], end: f64) -> Sheet {
        let stems = asperity_output::stems(problem.names.iter().map(String::as_str));
        let mut sources = Vec::new();
        for (i, (kept, stem)) in self.sliders.iter().zip(&stems).enumerate() {
            let table = kept.file.as_ref().map(|_| HISTORIES.named(stem));
            if self.traced || table.is_some() {
                let (name, states) = (problem.names[i].as_str(), problem.system.sliders()[i].law.states());
                let theta = thetas.get(i).copied().flatten();
                sources.push(Source { name, rows: table.ok_or(&kept.trace), states, theta });
            }
        }
        let mut sheet = Sheet::new(&problem.title, [0.0, end], false);
        sheet.plots = figures::curves(&problem.title, &sources).into_iter().map(Plot::Curves).collect();
        sheet
    }
}

/// Columns of the history of a slider.
fn columns(states: usize) -> Vec<Column> {
    let mut all = vec![
        column::time(),
        Column::new("step", "s", Sign::None, "length of the step, or time since the row before within it"),
        Column::new("slip", "m", Sign::Slip, "slip since the start"),
        Column::new("slip_rate", "m/s", Sign::Slip, "slip rate"),
        Column::new("friction", "-", Sign::Slip, "shear over normal traction"),
        Column::new("traction", "Pa", Sign::Slip, "shear traction"),
        Column::new("normal_traction", "Pa", Sign::Compression, "normal traction"),
        Column::new("load", "m", Sign::Slip, "displacement of the load point"),
    ];
    all.extend(
        (1..=states).map(|i| Column::new(format!("state_{i}"), "", Sign::None, "state variable of the law")),
    );
    all
}

impl SliderRecord {
    fn add(&mut self, row: &Row, traced: bool) -> Result<(), OutputError> {
        // Figures read the table where there is one.
        if traced && self.file.is_none() {
            self.trace.push(row);
        }
        let Some(file) = &mut self.file else { return Ok(()) };
        let states: String = row.states.iter().map(|s| format!(",{}", shortest_scientific(*s))).collect();
        let Row { time, dt, condition: c, slip, load, .. } = row;
        let line = format!(
            "{time},{dt:e},{},{},{},{},{},{}{states}\n",
            shortest_scientific(*slip),
            shortest_scientific(c.rate),
            shortest(c.friction),
            shortest(c.traction),
            c.normal,
            shortest_scientific(*load)
        );
        file.push(line.as_bytes())
    }
}

impl Observer<Sliders> for Histories {
    fn step(&mut self, now: &SliderState<'_>) -> Result<Control, ObserveError> {
        let (problem, time) = (now.problem, now.at.seconds());
        for (i, kept) in self.sliders.iter_mut().enumerate() {
            if kept.file.is_none() && !self.traced {
                continue;
            }
            let states = problem.system.sliders()[i].law.states();
            let row = Row {
                time,
                dt: now.dt,
                condition: now.conditions[i],
                slip: now.slip[i],
                load: now.load,
                states: problem.system.slider_unknowns(i, now.unknowns)[1..=states].to_vec(),
            };
            let (change, fast) = (problem.output.change, problem.events.map(|thresholds| thresholds.on));
            for row in kept.thin.next(row, now.asked, change, problem.end, fast).iter().flatten() {
                kept.add(row, self.traced)?;
            }
        }
        Ok(Control::Go)
    }

    fn event(&mut self, slider: usize) -> Result<(), ObserveError> {
        let kept = &mut self.sliders[slider];
        match kept.thin.mark() {
            Some(row) => Ok(kept.add(&row, self.traced)?),
            None => Ok(()),
        }
    }
}
