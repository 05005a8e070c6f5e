//! Catalogues of simulated events in the formats of observed ones.

mod cmtsolution;
mod event;
mod fsp;
mod quakeml;
mod tensor;

pub use cmtsolution::cmtsolution;
pub use event::{SourceParameters, Spot, magnitude};
pub use fsp::{Row, Segment, SourceModel};
pub use quakeml::quakeml;
pub use tensor::{Plane, Tensor};
