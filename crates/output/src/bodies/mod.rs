//! Runs of bodies with interfaces: what an observer sees of a step, and its files and record.

mod fields;
mod files;
mod multi;
mod quantity;
mod record;
mod sample_sites;
pub(crate) mod schedule;
mod tables;
pub mod view;

use crate::OutputFile;
use crate::tables::energy;

pub use files::{Files, FilesState};
pub use multi::Multi;
pub use record::{InterfaceHistory, PointHistory, Recorder, StageEnd};
pub use sample_sites::SampleSites;
pub use schedule::FieldSchedule;
pub use view::Writer;

/// Tables of runs of bodies.
pub const FILES: [OutputFile; 7] = [
    tables::PROFILES,
    tables::PROBES,
    tables::RATES,
    energy::FILE,
    sample_sites::POINTS,
    sample_sites::FORCES,
    sample_sites::SPRINGS,
];
