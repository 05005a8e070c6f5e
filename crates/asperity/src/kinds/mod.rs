//! Runs of each kind: their steps as observers see them, what they write, and their reports.

pub mod balance;
pub mod bodies;
mod cell_gradient;
mod cell_variation;
pub mod dynamics;
pub mod faults;
pub mod sliders;
mod step_turn;
mod stop;
pub mod worst;
