//! Scenes of spring-sliders: `kinematics = "spring-slider"`.

mod course;
mod spec;

pub use course::Course;
pub use spec::{Load, OutputSpec, SliderScene, SliderSelection, SliderSpec, SliderTime, SpringSpec};
