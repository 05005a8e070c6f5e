//! Faults through many earthquake cycles: from a scene to a plan, and what a run of it leaves behind. What is computed is in
//! [`asperity_cycles`].

mod bodies;
mod cadence;
mod checkpoint;
mod collections;
mod displacements;
mod fields;
mod figures;
mod files;
mod floors;
mod frame;
mod identity;
mod keeper;
pub mod located;
mod normal;
mod openings;
mod plan;
mod planner;
mod position;
mod report;
mod resolution;
mod snapshots;
mod stations;
mod words;

pub use bodies::BodiesView;
pub use cadence::Cadence;
pub use checkpoint::{Checkpoint, Stand};
pub use collections::write as write_fields;
pub use displacements::write as write_bodies;
pub use figures::draw;
pub use files::Files;
pub use floors::FloorUse;
pub use identity::physics;
pub use keeper::Keeper;
pub use normal::NormalChoice;
pub use openings::OpenedFault;
pub use plan::{FaultView, Plan, PointView, Station};
pub use planner::{Ground, modulus, places, plan, plan_with, spacings};
pub use position::Position;
pub use report::Report;
pub use resolution::{Coarsest, ENOUGH, FEW, Resolution, TOO_FEW};
