//! Spring-sliders in time: from a plan to a history and a catalogue of events.
//!
//! The equations are those of [`asperity_friction::slider`]; the integrator is [`crate::ode`].

mod catalogue;
mod error;
mod figures;
mod files;
mod observe;
mod output;
mod plan;
mod problem;
mod report;
mod run;
mod slips;
pub(crate) mod stability;
mod summary;
mod thin;

pub use catalogue::{Catalogue, Edge, Event, csv};
pub use error::RunError;
pub use files::Histories;
pub use observe::Show;
pub use output::{DEFAULT_CHANGE, Output};
pub use plan::{DEFAULT_METHOD, DEFAULT_TOLERANCE, MOST_STEPS, Plan, Thresholds};
pub use report::{End, Report};
pub use run::{Both, Now, Run, Watcher, run};
pub use stability::{Stability, critical_stiffness};
