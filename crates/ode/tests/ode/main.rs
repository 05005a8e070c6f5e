//! Integration of small systems: orders, events, time, stiffness and failures.
#![allow(clippy::unwrap_used)]

mod accuracy;
mod clock;
mod common;
mod earthquakes;
mod events;
mod failures;
