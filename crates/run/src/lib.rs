#![doc = include_str!("../README.md")]

mod catalogue;
mod counts;
mod energy;
mod interrupt;
mod observer;
pub mod report;
mod sites;
mod warning;

pub use catalogue::{ALL, Catalogue, Event, EventHead};
pub use counts::{Counts, Integration, Operations};
pub use energy::{Closure, Energies, EnergyTable, Part};
pub use interrupt::Interrupt;
pub use observer::{Kind, ObserveError, Observer, Observers};
pub use sites::{Site, SlipPoints};
pub use warning::{Place, Warning};
