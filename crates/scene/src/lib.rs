#![doc = include_str!("../README.md")]
#![cfg_attr(test, allow(clippy::unwrap_used))]

mod azimuth;
pub mod check;
pub mod defaults;
pub mod diagnostic;
mod entry;
mod exact;
mod explain;
pub mod files;
mod here;
pub mod keys;
pub mod kind;
mod kinematics;
pub mod law;
pub mod lengths;
pub mod model;
mod motion;
pub mod names;
pub mod near;
pub mod plausible;
pub mod reader;
pub mod schema;
pub mod settings;
mod several;
mod shape;
pub mod slider;
mod spanned;
mod title;
pub mod units;
pub mod unprintable;
pub mod upright;
mod usual;
pub mod warning;

pub use entry::Entry;

pub use reader::read;
