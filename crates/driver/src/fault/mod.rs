//! Faults whose linear bodies are condensed onto them: slip, states and tractions of the fault's points as a system of ordinary
//! differential equations, through many earthquake cycles.

mod balance;
mod bodies;
mod both;
mod catalogue;
mod checkpoint;
mod cluster;
mod condense;
mod equations;
mod fields;
mod figures;
mod files;
mod hierarchical;
mod keeper;
mod loading;
pub mod located;
mod lowrank;
mod machine;
mod medium;
mod operator;
mod place;
mod plan;
mod pressure;
mod report;
mod run;
mod snapshots;
mod stations;

pub use balance::{Balance, Energy, Mark, Sums, steady};
pub use bodies::{Bodies, BodiesView, write as write_bodies};
pub use both::Both;
pub use catalogue::{Catalogue, Event, Thresholds};
pub use checkpoint::{Checkpoint, ResumeError};
pub use condense::{Point, Surroundings, Tractions, condense};
pub use equations::{Equations, Fault, Layout, size};
pub use fields::write as write_fields;
pub use figures::draw;
pub use files::{Files, Position};
pub use hierarchical::{Geometry, Hierarchical, Sizes};
pub use keeper::{Keeper, Pauses};
pub use loading::Loading;
pub use operator::{Dense, Form, Operator};
pub use place::{Place, places};
pub use plan::{FaultView, Plan, PointView, plan, plan_with};
pub use pressure::{Injection, Pressure};
pub use report::Report;
pub use run::{Moment, RESTART, Run, Settings, Watcher, resume, run};
