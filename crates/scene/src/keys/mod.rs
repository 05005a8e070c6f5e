//! Rows of the reference of keys: from the schema of scenes, like the tables of the book.

mod find;
mod foreign_keys;
mod path;
mod row;
mod tree;
mod value;
mod visit;

pub use find::{DocumentedDefault, KeySearch, UnknownKey, check, documented, find};
pub(crate) use foreign_keys::{Run, refuse};
pub use path::{Path, Step, written};
pub use row::{Key, Row, roots, row};
pub(crate) use tree::Tree;
pub(crate) use visit::{Step as Visited, Visitor, visit};
