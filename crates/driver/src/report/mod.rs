//! Parts that the reports of all kinds of run share, `report.json`. The head of every report is in [`common`].

pub mod common;
mod energy;
mod samples;

pub(crate) use common::results;
pub use common::{Kind, Outcome, Phases, Results, Status, Stop, Work};
pub use energy::{Closure, EnergyTable};
pub use samples::{ForceResult, PointResult, SpringResult};
