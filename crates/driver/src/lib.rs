#![doc = include_str!("../README.md")]

mod amounts;
pub mod balance;
pub mod benchmark;
pub mod catalogue;
pub mod checkpoint;
pub mod checks;
pub mod cite;
pub mod cli;
pub mod cohesive;
pub mod diagnostic;
pub mod difference;
pub mod dynamic;
pub mod fault;
pub mod forecast;
mod handover;
mod held;
mod idealisation;
mod impedance;
pub mod initial_stress;
pub mod loading;
pub mod model;
pub mod plan;
pub mod refused;
pub mod report;
pub mod run;
pub mod run_doubts;
pub mod ruptures;
pub mod scene;
mod sha256;
pub mod slider;
pub mod slider_planner;
mod stop;
mod thresholds;
mod views;

pub use asperity_laws as laws;
pub use asperity_scene::{lengths, warning};
