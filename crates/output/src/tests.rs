//! Observers on a small made-up run: two blocks of quad4 (or hex8) pressed and sheared.

mod fake;
mod outputs;
