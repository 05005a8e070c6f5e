//! Finite-element bodies: meshes, elements, materials, assembly, condensation, and the interface of terms.
//!
//! The crate works on values: it opens no file, reads no clock, prints nothing, and contains neither contact nor friction.
#![cfg_attr(test, allow(clippy::unwrap_used))]

pub mod assembly;
pub mod block;
pub mod condense;
pub mod corners;
pub mod dof;
pub mod element;
pub mod error;
pub mod iterative;
pub mod jump;
pub mod kinematics;
pub mod loads;
pub mod mass;
pub mod material;
pub mod matrix_free;
pub mod mesh;
pub mod multifrontal;
pub mod nonlinear;
pub mod ordering;
pub mod origin;
pub mod outcome;
mod product;
pub mod quadrature;
pub mod relative;
pub mod scatter;
pub mod sparse;
pub mod surface;
pub mod table;
pub mod term;
pub mod vector;

pub use error::FemError;

/// The example of the README, as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
