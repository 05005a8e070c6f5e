//! Places of warnings in the text of a scene.

use crate::diagnostic::line_column;
use asperity_run::{Place, Warning};

/// Sets the line and column of a warning from the text of the scene.
pub fn locate(warning: &mut Warning, text: &str) {
    if !warning.span.is_empty() {
        let (line, column) = line_column(text, warning.span.start);
        warning.place = Some(Place { line, column });
    }
}
