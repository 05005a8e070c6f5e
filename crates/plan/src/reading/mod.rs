//! Scenes and tables of columns as they are read, and what is wrong with them.

pub mod columns;
pub mod diagnostic;
pub mod missing_file;
pub mod scene;
pub mod sniff;
pub mod wrong;
