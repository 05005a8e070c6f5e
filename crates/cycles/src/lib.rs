#![doc = include_str!("../README.md")]
#![cfg_attr(test, allow(clippy::unwrap_used))]

mod below;
mod catalogue;
mod energy;
mod equations;
mod error;
mod floor;
mod loading;
pub mod medium;
mod opened;
mod opening;
pub mod operator;
mod pressure;
mod problem;
mod run;
pub mod slider;

pub use below::{Below, Used};
pub use catalogue::{Catalogue, Crossing, Event, Part, Thresholds};
pub use energy::{Balance, Energy, Mark, Sums, steady};
pub use equations::{Equations, Fault, Layout, Pressed, size};
pub use error::RunError;
pub use floor::Floor;
pub use loading::Loading;
pub use opened::{Opened, Widest};
pub use opening::{Crack, Opening};
pub use pressure::{Injection, Pressure};
pub use problem::Problem;
pub use run::{Ends, Faults, Moment, RESTART, Run, Settings, resume, run};
