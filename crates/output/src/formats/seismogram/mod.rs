//! Seismograms of a station: tables as CSV, and the formats miniSEED and SAC of seismological programs.

mod mini_seed;
mod sac;
mod table;
mod trace;

pub use mini_seed::{SHORTEST, mini_seed};
pub use sac::sac;
pub use table::{columns, read, row};
pub use trace::{AXES, Trace, channel, code};
