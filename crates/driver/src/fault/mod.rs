//! Faults whose linear bodies are condensed onto them: slip, states and tractions of the fault's points as a system of ordinary
//! differential equations, through many earthquake cycles.

mod catalogue;
mod condense;
mod equations;
mod files;
mod loading;
mod machine;
mod operator;
mod place;
mod plan;
mod report;
mod run;

pub use catalogue::{Catalogue, Event, Thresholds};
pub use condense::{Point, Surroundings, condense};
pub use equations::{Equations, Fault, Layout};
pub use files::Files;
pub use loading::Loading;
pub use operator::{Dense, Operator};
pub use place::{Place, places};
pub use plan::{FaultView, Plan, PointView, plan};
pub use report::Report;
pub use run::{Moment, Run, Settings, Watcher, run};
