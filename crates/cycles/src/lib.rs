#![doc = include_str!("../README.md")]
#![cfg_attr(test, allow(clippy::unwrap_used))]

mod below;
mod catalogue;
mod components;
mod cycle;
mod energy;
mod equations;
mod error;
mod fault_run;
mod floor;
pub mod heat;
pub mod kernel;
mod loading;
pub mod medium;
mod moment;
mod opened;
mod opening;
pub mod operator;
mod pressure;
mod problem;
mod run;
mod rupture;
pub mod slider;
mod warmed;

pub use below::{Below, Used};
pub use catalogue::{Catalogue, Event, Thresholds};
pub use components::{Components, PerPoint};
pub use cycle::{RESTART, Settings, resume, run};
pub use energy::{Balance, Energy, Mark, Sums, steady};
pub use equations::{Equations, Fault, Layout, Pressed};
pub use error::RunError;
pub use fault_run::{ALL, FaultRun};
pub use floor::Floor;
pub use loading::Loading;
pub use moment::{Ends, Faults, Moment};
pub use opened::{Opened, Widest};
pub use opening::{Crack, Opening};
pub use pressure::{Injection, Pressure};
pub use problem::Problem;
pub use run::{NextStep, Run};
pub use rupture::{Crossing, Detector, Rupture, Values};
pub use warmed::{Warmed, Warmest};
