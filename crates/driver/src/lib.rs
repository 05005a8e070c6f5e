//! The driver of asperity: from a scene file to results a person can look at.
//!
//! `scene` reads, `plan` decides, `run` steps; the crate `asperity-output` writes.
#![cfg_attr(test, allow(clippy::unwrap_used))]

mod amounts;
pub mod balance;
pub mod cli;
pub mod cohesive;
pub mod diagnostic;
pub mod fault;
mod forecast;
mod held;
pub mod initial_stress;
pub mod laws;
mod lengths;
pub mod loading;
pub mod model;
pub mod plan;
pub mod report;
pub mod run;
mod run_doubts;
pub mod scene;
pub mod slider;
mod stop;
mod views;
pub mod warning;
