//! Parts that the plans of several kinds of run need.

pub mod amounts;
pub mod checks;
pub mod cohesive;
pub mod entry;
pub mod field;
pub mod handover;
pub mod idealisation;
pub mod impedance;
pub mod initial_stress;
pub mod law_errors;
pub mod loading;
pub mod memory;
pub mod model;
pub mod place;
pub mod rate_bound;
pub mod resolution;
pub mod ruptures;
pub mod setup;
pub mod sha256;
pub mod thresholds;
pub mod unbalance;
pub mod views;
pub mod words;
