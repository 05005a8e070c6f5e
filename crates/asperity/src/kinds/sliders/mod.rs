//! Spring-sliders: from a run to histories, plots and a report. The computation is in [`asperity_cycles::slider`].

mod events;
mod figures;
mod files;
mod outputs;
mod report;
mod thin;

pub use events::{Entry, Named, columns, csv};
pub use files::{HISTORIES, Histories, Positions};
pub use outputs::{Outputs, Saved};
pub use report::Report;
