//! Spring-sliders: the problem, the run and its catalogue of events.
//!
//! The equations are those of [`asperity_friction::slider`]; the integrator is [`asperity_ode`].

mod budget;
mod equations;
mod problem;
mod rows;
mod run;
mod slide;
mod springs;
pub mod stability;

pub use budget::Budget;
pub use problem::{ANY_ROCK, DEFAULT_METHOD, DEFAULT_TOLERANCE, MOST_STEPS, Problem, RESTART};
pub use rows::{DEFAULT_CHANGE, Rows};
pub use run::{SliderRun, SliderState, Sliders, resume, run};
pub use slide::{Edge, Slide};
pub use stability::{Stability, critical_stiffness};
