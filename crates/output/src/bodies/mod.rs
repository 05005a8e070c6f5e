//! Runs of bodies with interfaces: what an observer sees of a step, and its files and record.

mod files;
mod multi;
mod record;
mod sample_sites;
pub(crate) mod schedule;
mod tables;
pub mod view;

pub use files::{Files, FilesState};
pub use multi::Multi;
pub use record::{InterfaceHistory, PointHistory, Recorder, StageEnd};
pub use sample_sites::SampleSites;
pub use schedule::FieldSchedule;
pub use view::Writer;
