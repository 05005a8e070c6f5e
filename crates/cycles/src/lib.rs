#![doc = include_str!("../README.md")]
#![cfg_attr(test, allow(clippy::unwrap_used))]

mod accounts;
mod course;
mod equations;
pub mod kernel;
pub mod medium;
pub mod operator;
pub mod problem;
pub mod processes;
pub mod slider;

pub use accounts::{
    Balance, Crossing, Detector, Ends, Energy, Front, Mark, Moment, Rupture, Sums, Values, steady,
};
pub use course::{
    Dynamics, Episode, FaultRun, Faults, Handover, NextStep, Outrun, RESTART, Run, Shaken, Start, Waves,
    WavesError, run,
};
pub use equations::Equations;
pub use problem::{
    Components, Fault, Layout, Loading, PerPoint, PointTractions, Problem, Processes, RunError, Settings,
    Thresholds,
};
pub use processes::{
    BODIES, Crack, FLUID_PRESSURE, Floor, FloorRecord, FloorSummary, Injection, OPENING, Opening,
    OpeningRecord, PorePressure, Pressure, Pulse, Widest, deficit, diffusion, heat,
};
pub use slider::ANY_ROCK;
