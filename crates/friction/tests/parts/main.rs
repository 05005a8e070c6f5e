//! Strengths and evolutions by themselves: values, derivatives and closed forms over the whole range of rates.
#![allow(clippy::unwrap_used)]

mod closed;
mod common;
mod evolution;
mod refusals;
mod strength;
#[path = "../usual/mod.rs"]
mod usual;
