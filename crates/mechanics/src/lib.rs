#![doc = include_str!("../README.md")]
#![cfg_attr(test, allow(clippy::unwrap_used))]

mod cell_size;
mod choices;
pub mod contact_spec;
pub mod coordinates;
pub mod dynamics;
mod enforcement;
mod error;
mod free;
mod inertia;
mod initial_tractions;
mod interface;
mod model;
mod pace;
mod pieces;
mod problem;
pub mod restraint;
mod rotation;
mod samples;
pub mod solver;
mod spring;
mod stage;
pub mod step;
mod stress;
mod system;
pub mod timing;
mod zone_resolution;

pub use cell_size::cell_size;
pub use choices::{Control, Path, Stepping};
pub use enforcement::PlannedEnforcement;
pub use error::SetUpError;
pub use inertia::{Energy, Episode, Handover, Mass};
pub use initial_tractions::InitialTractions;
pub use interface::{Measure, PlannedInterface, interface_nodes};
pub use model::{Body, CellBlock, Model, bounds};
pub use pace::{Pace, Travel};
pub use pieces::Pieces;
pub use problem::Problem;
pub use rotation::{RotatedSet, Rotation};
pub use samples::{ForceSet, ForeignLoads, Point, PointValues, SampleRequest, Samples};
pub use spring::{SpringStart, SpringState};
pub use stage::{Course, LOADING, Motion, Spring, Stage};
pub use step::Failure;
pub use stress::StressField;
pub use system::{AssembledProblem, Mismatch, SystemState};
pub use zone_resolution::ZoneResolution;
