//! Observers on a small synthetic run: two blocks of quad4 (or hex8) pressed together and sheared.

mod fake;
mod outputs;
