//! Bodies with mass, whose faults radiate waves: from a scene to a plan. The computation is in
//! [`asperity_mechanics::dynamics`].

mod plan;
mod planner;

pub use plan::{AnyPlan, Cadence, Plan, Receiver};
pub use planner::{plan, ruptures};
