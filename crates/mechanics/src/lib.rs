#![doc = include_str!("../README.md")]
#![cfg_attr(test, allow(clippy::unwrap_used))]

mod cell_size;
mod choices;
pub mod coordinates;
pub mod declared;
pub mod dynamics;
mod enforced;
mod free;
mod inertia;
mod interface;
mod model;
mod pace;
mod pieces;
mod pressed;
mod problem;
mod resolved;
pub mod restraint;
mod samples;
pub mod solver;
mod spring;
mod stage;
pub mod step;
mod stress;
mod system;
pub mod timing;
mod turning;

pub use cell_size::cell_size;
pub use choices::{Control, Path, Stepping};
pub use enforced::Enforced;
pub use inertia::{Energy, Episode, Handover, Mass};
pub use interface::{Measure, PlannedInterface, interface_nodes};
pub use model::{Body, CellBlock, Model, bounds};
pub use pace::{Drawn, Pace};
pub use pieces::Pieces;
pub use pressed::Pressed;
pub use problem::Problem;
pub use resolved::Resolved;
pub use samples::{Beside, ForceSet, Point, PointValues, Samples, Wanted};
pub use spring::{SpringNow, SpringStart};
pub use stage::{Course, LOADING, Motion, Spring, Stage};
pub use step::Failure;
pub use stress::StressField;
pub use system::{Assembled, Mismatch, SystemState};
pub use turning::{Rotation, Turning};
