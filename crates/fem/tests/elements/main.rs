//! Every element: shape functions, quadrature, patch test, rigid motions and spectra, orders, locking, loads, generator.
#![allow(clippy::unwrap_used)]

mod common;
mod convergence;
mod generate;
mod loads;
mod patch;
mod shape;
mod spectrum;
