#![doc = include_str!("../README.md")]

pub mod benchmark;
pub mod cite;
pub mod difference;
