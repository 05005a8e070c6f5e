//! Errors in a scene, as shown on the terminal.

pub mod render;

pub use asperity_scene::diagnostic::{Diagnostic, Diagnostics, line_column};
pub use render::{TextSettings, report, report_set};
