//! Snapshots of the state of faults in 3D during a run, as VTU files.

use super::fields::{self, Present};
use asperity_cycles::Moment;
use asperity_output::decimals::fixed;
use asperity_output::fields::Series;
use asperity_output::tables::GrowingTable;
use asperity_output::tables::column::{self, Column, Sign};
use asperity_output::{OutputError, OutputFile, atomic};
use asperity_plan::faults::Plan;
use asperity_plan::faults::cadence::{Gauge, RATE_CHANGE, Reading, log_rate};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// List of snapshots.
pub(super) const LIST: OutputFile = OutputFile::new("snapshots.csv", "state of a fault at chosen times");
/// Time between snapshots in an event over that between profiles; a rupture crosses a few kilometres in two seconds.
const IN_EVENTS: f64 = 2.0;
/// Size of all snapshots together over the largest size of a growing file.
const FILES: u64 = 10;

/// Number of snapshots taken, and the gauge that decides when the next is due.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct SnapshotState {
    count: usize,
    pub gauge: Gauge,
    /// Size of the list \[bytes\].
    list: u64,
}

/// Writes `fields/FAULT_00000.vtu` and so on.
pub(super) struct Snapshots<'a> {
    out: PathBuf,
    /// States of each fault.
    states: Vec<Series<'a, Present>>,
    list: GrowingTable,
    taken: SnapshotState,
}

/// Columns of the list of snapshots.
pub(super) fn columns() -> Vec<Column> {
    vec![
        Column::new("snapshot", "", Sign::None, "number of the snapshot"),
        column::time(),
        Column::new("log10 slip_rate", "m/s", Sign::Log, "largest slip rate"),
    ]
}

impl<'a> Snapshots<'a> {
    /// Snapshots of a run, if its faults are surfaces in 3D; after those already taken, if any.
    ///
    /// # Errors
    /// If the folder or the list cannot be written.
    pub fn open(
        out: &Path,
        plan: &'a Plan,
        taken: Option<SnapshotState>,
    ) -> Result<Option<Self>, OutputError> {
        if !plan.in_space {
            return Ok(None);
        }
        atomic::create_dir(&out.join("fields"))?;
        let states = plan.faults.iter().map(|fault| fields::states(plan, fault)).collect();
        let list = match taken {
            Some(taken) => GrowingTable::reopen(out.join(LIST.path), taken.list)?,
            None => GrowingTable::create(out.join(LIST.path), column::header(&columns()))?,
        };
        Ok(Some(Self { out: out.to_path_buf(), states, list, taken: taken.unwrap_or_default() }))
    }

    /// Number and gauge of the snapshots taken.
    pub fn taken(&self) -> SnapshotState {
        SnapshotState { list: self.list.bytes(), ..self.taken }
    }

    /// Waits until the list is on the disc.
    ///
    /// # Errors
    /// If something could not be written.
    pub fn settle(&self) -> Result<(), OutputError> {
        self.list.settle()
    }

    /// Takes a snapshot if it is due.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn take(&mut self, plan: &Plan, now: &Moment<'_>) -> Result<(), OutputError> {
        let time = now.at.seconds();
        let fast = now.largest >= plan.problem.settings.thresholds.on;
        let [between, within] = plan.cadence.contours;
        let interval = if fast { (IN_EVENTS * within).min(between) } else { between };
        if !self.taken.gauge.profile(Reading { time, rate: now.largest }, interval, RATE_CHANGE) {
            return Ok(());
        }
        let number = self.taken.count;
        let (unknowns, rate) = (now.unknowns.to_vec(), now.rate.all().to_vec());
        let present = Present { unknowns, rate, pressed: now.pressed.clone() };
        for states in &self.states {
            let bytes = states.write(&self.out, number, time, &present)?;
            self.taken.gauge.spend(bytes, FILES * plan.cadence.largest_file, time);
        }
        self.taken.count = number + 1;
        let row = format!("{number},{time:.14e},{}\n", fixed(log_rate(now.largest), 6));
        self.list.push(row.as_bytes())
    }
}
