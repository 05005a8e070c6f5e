#![doc = include_str!("../README.md")]

pub mod catalogue;
pub mod checkpoint;
pub mod cli;
pub mod keep;
pub mod kinds;
pub mod report;
