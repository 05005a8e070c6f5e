//! Every element: shape functions, quadrature, patch test, rigid motions and spectra, orders, locking, loads, generator.
#![allow(clippy::unwrap_used)]

mod coarser;
mod common;
mod convergence;
mod generate;
mod idealisations;
mod loads;
mod locking;
mod patch;
mod serendipity;
mod shape;
mod spectrum;
