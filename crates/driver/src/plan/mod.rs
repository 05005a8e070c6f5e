//! Plans: what will be run, as data, and how it is made from a scene.

mod choices;
mod coarse;
mod doubts;
mod interface;
mod interfaces;
mod path;
mod planner;
mod start_gap;
mod stepping;
mod summary;
mod values;

pub use choices::{Control, Path, Stepping};
pub use interface::{PlannedInterface, interface_nodes};
pub use planner::{ScenePlan, plan, plan_scene};
pub use start_gap::{SHARE, StartGap};
pub use values::{AnyPlan, Plan, Summary};
