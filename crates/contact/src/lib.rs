#![cfg_attr(test, allow(clippy::unwrap_used))]
//! Contact interfaces. A measure gives the gap, normal and slip of slave points against a master surface, an enforcement gives
//! the normal traction from the gap, and a friction law is optional. [`Interface`] joins them and is a term in the sense of
//! `asperity_fem::term`.
//!
//! Signs: the gap `g_n = n·(x_s - x_c)` is positive when open, with n the outward unit normal of the master. Slip is the motion
//! of the slave relative to the master along the master surface. The force on the slave is `A (f_n n - t)`, so friction opposes
//! slip. The first tangent in two dimensions is `e_1 = (-n_y, n_x)`.

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
mod shift;
mod spec;
mod status;
mod vector;
pub mod watch;

pub use asperity_fem::element::face::{self as shape, FaceKind as SegmentKind};
pub use error::ContactError;
pub use history::InterfaceState;
pub use interface::{Interface, TOUCH};
pub use observe::{Balance, PointFields, Work};
pub use press::StartTraction;
pub use spec::{
    Enforcement, InterfaceSpec, MeasureKind, Mirror, Segment, SlavePoint, Sliding, Smoothing, SurfaceNode,
    TimeRule,
};
pub use status::Status;
pub use watch::{Course, RateLimit, Watch};

/// Compiles the example of the README as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
