#![doc = include_str!("../README.md")]
#![cfg_attr(test, allow(clippy::unwrap_used))]

pub mod atomic;
pub mod column;
mod csv_rows;
pub mod decimals;
mod energies;
mod error;
pub mod files;
pub mod grd;
mod growing_table;
mod json;
pub mod located;
pub mod memory;
mod multi;
mod names;
mod numbers;
pub mod platform;
pub mod plots;
pub mod printing;
pub mod progress;
mod pulse;
mod record;
pub mod rows;
mod sample_sites;
mod schedule;
pub mod seas;
pub mod seismogram;
pub mod table;
#[cfg(test)]
mod tests;
pub mod view;
pub mod vtu;
pub mod words;

pub use column::{Column, Sign};
pub use energies::ENERGIES;
pub use error::OutputError;
pub use files::{Files, FilesState};
pub use growing_table::GrowingTable;
pub use multi::Multi;
pub use names::stems;
pub use progress::Progress;
pub use pulse::Pulse;
pub use record::{InterfaceHistory, PointHistory, Recorder, StageEnd};
pub use sample_sites::SampleSites;
pub use schedule::FieldSchedule;
pub use view::Writer;
