#![doc = include_str!("../README.md")]
#![cfg_attr(test, allow(clippy::unwrap_used))]

pub mod atomic;
pub mod bodies;
pub mod decimals;
mod error;
pub mod fields;
pub mod figures;
pub mod formats;
mod json;
mod labels;
pub mod memory;
mod names;
mod numbers;
mod output_file;
pub mod tables;
pub mod terminal;
#[cfg(test)]
mod tests;
mod units;
pub mod words;

pub use error::{OutputError, PaintError};
pub use names::stems;
pub use output_file::OutputFile;
