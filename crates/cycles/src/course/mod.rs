//! The course of a run: integration from change to change of the loading, ruptures with mass, and what observers see.

mod cycle;
mod episode;
mod fault_run;
mod follow;
mod run;
mod settle;
mod waves;

pub use cycle::{RESTART, run};
pub use fault_run::{FaultRun, Faults, Outrun};
pub(crate) use follow::outrun;
pub use run::{NextStep, Run};
pub use waves::{Dynamics, Episode, Handover, Shaken, Start, Waves, WavesError};
