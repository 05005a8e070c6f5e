//! Faults over many earthquake cycles: from a scene to a plan. The computation is in [`asperity_cycles`].

mod bodies;
pub mod cadence;
mod coulomb;
mod free_surface;
mod normal;
mod plan;
pub mod planner;
mod platform;
mod receivers;
mod sampling;
mod stresses;

pub use bodies::BodiesView;
pub use cadence::Cadence;
pub use coulomb::{Change, Coulomb, CoulombMap, ReceiverPlane};
pub use free_surface::{FreeSurface, SurfaceAxes};
pub use normal::NormalChoice;
pub use plan::{CellGrid, FaultView, HeatView, Outline, Plan, PointView, Station};
pub use planner::{places, plan, plan_beside, plan_with};
pub use platform::Platform;
pub use receivers::{Receiver, Receivers};
pub use sampling::Sampling;
pub use stresses::BodyStresses;
