//! Fields for ParaView: what their arrays are, series of files, and the format of the files.

mod field;
mod series;
pub mod vtu;

use crate::OutputFile;

pub use field::{Data, Field, Shape};
pub use series::{FieldTimes, Series};

/// Files of fields.
pub const FILES: OutputFile = OutputFile::new("fields/*.vtu", "bodies and surfaces at output times (VTU)");
/// List of the fields over time.
pub const COLLECTION: OutputFile =
    OutputFile::new("fields.pvd", "list of the files in `fields/` over time, for ParaView");
