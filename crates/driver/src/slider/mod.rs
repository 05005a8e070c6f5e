//! Spring-sliders in time: from a plan to a history and a catalogue of events.
//!
//! The equations are those of [`asperity_friction::slider`]; the integrator is [`crate::ode`].

mod catalogue;
mod files;
mod observe;
mod plan;
mod problem;
mod report;
mod run;

pub use catalogue::{Catalogue, Event};
pub use files::Histories;
pub use observe::Show;
pub use plan::{DEFAULT_METHOD, DEFAULT_TOLERANCE, MOST_STEPS, Plan, Thresholds};
pub use report::{End, Report};
pub use run::{Both, Now, Run, RunError, Watcher, run};
