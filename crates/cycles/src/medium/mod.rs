//! Media around sliding points: bodies condensed onto the points of faults, homogeneous rock without bodies.

mod bodies;
mod condensed;
mod displacements;
mod loads;
mod machine;
mod mirror;
pub mod patches;
mod place;
mod point;
mod point_jumps;
mod pressed_bodies;
mod refusal;
mod stresses;

pub use bodies::{Bodies, DisplacementSum};
pub use condensed::{Conditions, Surroundings, condense, least_bytes};
pub use loads::Loads;
pub use machine::Spring;
pub use mirror::Mirror;
pub use place::{Place, across, unit};
pub use point::{Initial, Point};
pub use pressed_bodies::{PressedBodies, Pressing, press};
pub use refusal::Refusal;
