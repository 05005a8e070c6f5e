//! Histories as CSV, a row of a slider where something changed or where the plan asks for one; and what plots show of them.

use super::figures::Trace;
use super::thin::{Row, Thin};
use asperity_cycles::slider::{Now, Problem, WatchError, Watcher};
use asperity_output::{OutputError, atomic, plots};
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};

/// Streams `history/<slider>.csv`; each grows by whole rows.
#[derive(Debug)]
pub struct Histories {
    sliders: Vec<Kept>,
    /// Whether plots will be drawn.
    traced: bool,
}

/// What is kept of a slider.
#[derive(Debug, Default)]
struct Kept {
    file: Option<(PathBuf, fs::File)>,
    thin: Thin,
    trace: Trace,
}

impl Histories {
    /// Makes the files with their headers.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn create(out: &Path, problem: &Problem) -> Result<Self, OutputError> {
        atomic::writable_dir(out)?;
        let folder = out.join("history");
        let stems = asperity_output::stems(problem.names.iter().map(String::as_str));
        let mut sliders = Vec::new();
        for (i, (stem, slider)) in stems.iter().zip(problem.system.sliders()).enumerate() {
            let file = if problem.output.writes(i) {
                atomic::create_dir(&folder)?;
                Some(begun(folder.join(format!("{stem}.csv")), slider.law.states())?)
            } else {
                None
            };
            sliders.push(Kept { file, ..Kept::default() });
        }
        Ok(Self { sliders, traced: false })
    }

    /// Keeps what plots show.
    #[must_use]
    pub fn traced(mut self) -> Self {
        self.traced = true;
        self
    }

    /// Writes the last state, if its row is not there yet.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn finish(&mut self) -> Result<(), OutputError> {
        let traced = self.traced;
        self.sliders.iter_mut().try_for_each(|kept| match kept.thin.mark() {
            Some(row) => kept.add(&row, traced),
            None => Ok(()),
        })
    }

    /// Draws the rows kept into `plots/` and returns the files.
    ///
    /// # Errors
    /// When a file cannot be written or a drawing fails.
    pub fn draw(&self, out: &Path, problem: &Problem) -> Result<Vec<PathBuf>, OutputError> {
        let traces: Vec<&Trace> = self.sliders.iter().map(|k| &k.trace).collect();
        plots::draw_charts(&out.join("plots"), &super::figures::charts(problem, &traces))
    }
}

/// A file with its header, to be appended to.
fn begun(path: PathBuf, states: usize) -> Result<(PathBuf, fs::File), OutputError> {
    let head =
        "time [s],step [s],slip [m],slip_rate [m/s],friction [-],traction [Pa],normal_traction [Pa],load [m]";
    let states: String = (1..=states).map(|i| format!(",state_{i}")).collect();
    atomic::write(&path, format!("{head}{states}\n").as_bytes())?;
    match fs::OpenOptions::new().append(true).open(&path) {
        Ok(file) => Ok((path, file)),
        Err(source) => Err(OutputError::write(&path, source)),
    }
}

impl Kept {
    fn add(&mut self, row: &Row, traced: bool) -> Result<(), OutputError> {
        if traced {
            self.trace.push(row);
        }
        let Some((path, file)) = &mut self.file else { return Ok(()) };
        let states: String = row.states.iter().map(|s| format!(",{s:e}")).collect();
        let Row { time, dt, condition: c, slip, load, .. } = row;
        let line = format!(
            "{time},{dt:e},{slip:e},{:e},{},{},{},{load:e}{states}\n",
            c.rate, c.friction, c.traction, c.normal
        );
        // One write per row: a run that is killed leaves whole rows.
        file.write_all(line.as_bytes()).map_err(|source| OutputError::write(path, source))
    }
}

impl Watcher for Histories {
    fn now(&mut self, problem: &Problem, now: &Now<'_>) -> Result<(), WatchError> {
        let time = now.at.seconds();
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
                states: problem.system.of(i, now.unknowns)[1..=states].to_vec(),
            };
            for row in kept.thin.next(row, now.asked, problem.output.change, problem.end).iter().flatten() {
                kept.add(row, self.traced)?;
            }
        }
        Ok(())
    }

    fn marked(&mut self, slider: usize) -> Result<(), WatchError> {
        let kept = &mut self.sliders[slider];
        match kept.thin.mark() {
            Some(row) => Ok(kept.add(&row, self.traced)?),
            None => Ok(()),
        }
    }
}
