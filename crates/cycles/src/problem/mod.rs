//! The problem to integrate: faults with their processes and their medium, loads, initial values, and settings.

mod error;
mod fault;
mod layout;
mod loading;
mod point_tractions;
mod process;
mod settings;
mod stage;
mod way;
mod working;

pub use asperity_friction::points::{Components, PerPoint};
pub use error::RunError;
pub use fault::Fault;
pub use layout::Layout;
pub use loading::Loading;
pub use point_tractions::{Field, OverEvents, PointTractions, Quantity};
pub use process::{Account, Acting, Energetic, Host, Phase, Process, Processes};
pub use settings::{Settings, Thresholds};
pub use stage::{FaultState, Passage, ProcessRecord, Rates, Stretch, Time, Tractions};
pub(crate) use way::Way;
pub use working::Working;

/// Faults in their medium, with all that a run needs.
#[derive(Debug)]
pub struct Problem {
    /// Friction, processes and the medium.
    pub fault: Fault,
    /// Tributary areas of the points \[m²; m per metre of thickness\].
    pub areas: Vec<f64>,
    /// Loads.
    pub loading: Loading,
    /// Initial unknowns.
    pub start: Vec<f64>,
    /// Settings of the integration.
    pub settings: Settings,
}
