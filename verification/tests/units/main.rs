//! Parts of the suite by themselves: pages, releases, names and limits.
#![allow(clippy::unwrap_used, reason = "tests")]

mod convergence;
mod fields;
mod glob;
mod history;
mod ids;
mod limit;
mod mathml;
mod numbers;
mod planted;
mod precision;
mod provenance;
mod readme;
mod sketches;
mod sources;
mod subjects;
mod tested;
mod words;
