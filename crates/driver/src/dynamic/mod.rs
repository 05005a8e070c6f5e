//! Bodies with mass, whose faults radiate waves: planning from a scene, and the output of a run. The computation is in
//! [`asperity_mechanics::dynamics`].

pub mod arrivals;
mod fields;
mod figures;
mod moment;
mod outputs;
mod plan;
mod planner;
mod report;
mod rows;
mod run;
mod seismograms;
mod stations;
mod tables;

pub use moment::Moment;
pub use outputs::{Outputs, Saved};
pub use plan::{AnyPlan, Cadence, Plan, Receiver};
pub use planner::{plan, ruptures};
pub use report::Report;
pub use run::{Dynamics, Ended, RunError, Stand, run};
