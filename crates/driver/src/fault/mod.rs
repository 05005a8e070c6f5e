//! Faults whose linear bodies are condensed onto them: slip, states and tractions of the fault's points as a system of ordinary
//! differential equations, through many earthquake cycles.

mod catalogue;
mod equations;
mod loading;
mod operator;
mod run;

pub use catalogue::{Catalogue, Event, Thresholds};
pub use equations::{Equations, Fault, Layout};
pub use loading::Loading;
pub use operator::{Dense, Operator};
pub use run::{Moment, Run, Settings, Watcher, run};
