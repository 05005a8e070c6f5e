//! The driver of asperity: from a scene file to results a person can look at.
//!
//! `scene` reads, `plan` decides, `run` steps; the crate `asperity-output` writes.
#![cfg_attr(test, allow(clippy::unwrap_used))]

mod amounts;
pub mod balance;
pub mod cli;
pub mod cohesive;
mod coordinates;
mod declared;
pub mod diagnostic;
pub mod enforcement;
pub mod fault;
mod forecast;
mod free;
mod held;
pub mod initial_stress;
pub mod laws;
mod linear_solver;
pub mod loading;
pub mod model;
pub mod penalty;
pub mod plan;
pub mod pressed;
pub mod report;
pub mod rigid;
pub mod run;
mod run_doubts;
pub mod samples;
pub mod scene;
pub mod slider;
pub mod solver;
mod start_balance;
pub mod start_gaps;
pub mod step;
mod stop;
mod stress_level;
pub mod system;
pub mod timing;
mod views;
pub mod warning;
mod watch;
