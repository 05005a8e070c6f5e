//! Rows of the reference of keys: from the schema of scenes, like the tables of the book.

mod find;
mod path;
mod row;
mod tree;
mod value;

pub use find::{Found, check, find};
pub use path::{Path, Step, written};
pub use row::{Key, Row, roots, row};
pub(crate) use tree::Tree;
