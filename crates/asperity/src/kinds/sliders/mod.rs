//! Spring-sliders: from a run to histories, plots and a report. The computation is in [`asperity_cycles::slider`].

mod events;
mod figures;
mod files;
mod outputs;
mod report;
mod thin;

pub use events::{Entry, NamedEvent, columns, csv};
pub use files::{HISTORIES, Histories, Positions};
pub use outputs::{Checkpoint, Outputs};
pub use report::Report;
