//! Plans of runs, as data, and their construction from scenes.

mod assembly;
mod checks;
mod coarse;
mod cohesive;
mod damping;
mod doubts;
mod enforcement;
mod events;
mod force_notes;
mod friction;
mod inertia;
mod initial_tractions;
mod interfaces;
mod linear_solver;
mod overlaps;
mod path;
pub mod penalty;
mod picture;
mod planner;
pub mod restraint;
mod start_balance;
mod start_gap;
mod start_gaps;
mod stepping;
mod stress_level;
mod summary;
mod surfaces;
mod values;
mod watch;

pub use asperity_mechanics::{Path, PlannedInterface, Stepping, interface_nodes};
pub use events::{EventPlan, Sites};
pub use picture::picture;
pub use planner::plan;
pub use start_gap::{SHARE, StartGap};
pub use stepping::rule;
pub use values::{AnyPlan, Plan, Summary};
