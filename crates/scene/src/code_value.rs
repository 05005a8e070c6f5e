//! Values that do not come from a file.

use crate::spanned::Spanned;

/// Wraps a value without a position in a file, for scenes built in Rust.
pub fn here<T>(value: T) -> Spanned<T> {
    Spanned::new(0..0, value)
}
