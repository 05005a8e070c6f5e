//! Energy budget of bodies: of states of equilibrium, and what it shares with that of bodies with inertia.

mod accounts;
mod budget;
mod parts;
mod phase;
mod statics;

pub use accounts::{Accounts, InterfaceEnergy, StepWorks, Sums, View};
pub use budget::Energy;
pub use parts::{BodyEnergy, body_energy, by_loads, linear_forces};
pub use phase::Phase;
pub use statics::{BodyWorks, Jump, StaticBudget, StaticState};
