#![doc = include_str!("../README.md")]
#![cfg_attr(test, allow(clippy::unwrap_used))]

pub mod axes;
mod azimuth;
pub mod check;
mod code_value;
pub mod control_characters;
pub mod defaults;
pub mod diagnostic;
mod entry;
mod exact_list;
mod explain;
pub mod files;
mod key_default;
pub mod keys;
pub mod kind;
mod kinematics;
pub mod law;
pub mod lengths;
pub mod model;
mod motion;
pub mod names;
mod pairs;
pub mod plausibility;
pub mod reader;
pub mod schema;
pub mod settings;
mod shape;
pub mod slider;
mod spanned;
mod state_values;
pub mod suggestions;
mod title;
pub mod units;
pub mod warning;

pub use entry::Entry;

pub use reader::read;
