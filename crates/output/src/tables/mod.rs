//! CSV tables: columns with their meaning, tables that grow by rows, histories, and reading rows back.

pub mod column;
pub(crate) mod csv_rows;
pub mod describe;
pub mod energy;
mod growing_table;
pub(crate) mod history;
pub mod rows;

pub use column::{Column, Sign};
pub use growing_table::GrowingTable;
