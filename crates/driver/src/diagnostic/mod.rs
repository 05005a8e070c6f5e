//! Errors in a scene, as the terminal shows them.

mod render;

pub use asperity_scene::diagnostic::{Diagnostic, Diagnostics, line_column};
pub use render::report;
