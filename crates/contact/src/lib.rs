#![cfg_attr(test, allow(clippy::unwrap_used))]
//! Contact interfaces: a measure (gap, normal, slip of slave points against a master surface), an enforcement (normal
//! traction from gap) and, where there is one, a friction law, joined in [`Interface`], which is a term of the seam in
//! `asperity_fem::term`.
//!
//! Signs: gap `g_n = n·(x_s - x_c) > 0` open, n the outward unit normal of the master; slip is the motion of the slave
//! relative to the master along the master surface; the force on the slave is `A (f_n n - t)`, so friction opposes slip;
//! the first tangent in two dimensions is `e_1 = (-n_y, n_x)`.

mod average;
mod build;
pub mod enforce;
mod error;
mod forward;
mod history;
mod interface;
pub mod measure;
pub mod observe;
mod press;
pub mod search;
mod shear;
mod spec;
mod status;
mod vector;
pub mod watch;

pub use asperity_fem::element::face::{self as shape, FaceKind as SegmentKind};
pub use enforce::Enforcement;
pub use error::ContactError;
pub use history::InterfaceState;
pub use interface::Interface;
pub use observe::{Balance, PointFields, Work};
pub use press::StartTraction;
pub use spec::{InterfaceSpec, MeasureKind, Segment, SlavePoint, Sliding, Smoothing, SurfaceNode, TimeRule};
pub use status::Status;
pub use watch::{Course, RateLimit, Watch};

/// The example of the README, as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
