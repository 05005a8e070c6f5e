//! What is wrong in a scene, as the terminal shows it.

mod render;

pub use asperity_scene::diagnostic::{Diagnostic, Diagnostics, line_column};
pub use render::report;
