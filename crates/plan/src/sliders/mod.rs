//! Spring-sliders: from a scene to a plan. The computation is in [`asperity_cycles::slider`].

mod plan;
pub mod planner;
mod summary;

pub use plan::Plan;
