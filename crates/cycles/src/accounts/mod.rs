//! Accounts of runs: events, energy, and the state that observers see.

mod balance;
mod energy;
mod front;
mod moment;
mod rupture;
mod steady;

pub use balance::{Balance, Sums};
pub use energy::{Energy, Mark};
pub use front::Front;
pub(crate) use front::Stride;
pub use moment::{Ends, Moment};
pub use rupture::{Crossing, Detector, Rupture, Values};
pub use steady::steady;
