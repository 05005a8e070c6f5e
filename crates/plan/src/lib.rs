#![doc = include_str!("../README.md")]

pub mod bodies;
pub mod doubts;
pub mod dynamics;
pub mod faults;
mod kinds;
pub mod reading;
pub mod shared;
pub mod sliders;

pub use kinds::{ScenePlan, plan_beside, plan_scene};
