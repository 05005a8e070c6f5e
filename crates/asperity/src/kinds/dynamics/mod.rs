//! Bodies with mass, whose faults radiate waves: the output of a run. The computation is in
//! [`asperity_mechanics::dynamics`].

pub mod arrivals;
mod fields;
mod figures;
mod moment;
mod outputs;
mod report;
mod rows;
mod run;
mod seismograms;
mod stations;
mod tables;

pub use moment::Moment;
pub use outputs::{Checkpoint, Outputs};
pub use report::Report;
pub use run::{Dynamics, FinalState, ResumeState, RunError, run};
pub use tables::{FILES, tables};
