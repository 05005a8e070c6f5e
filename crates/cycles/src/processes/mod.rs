//! Processes on faults, each behind the seam of [`crate::problem::Process`].

mod deficit;
mod floor;
pub mod heat;
mod injection;
mod opening;
mod pulse;

pub use deficit::deficit;
pub use floor::{BODIES, Below, Floor, Used};
pub use injection::{Injection, Pressure};
pub use opening::{Crack, OPENING, Opened, Opening, Widest};
pub use pulse::Pulse;
