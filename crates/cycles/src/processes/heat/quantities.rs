//! Quantities of heated faults.

use crate::problem::{OverEvents, Quantity};

/// Temperature at the centre of the zone that slips.
pub static TEMPERATURE: Quantity = Quantity {
    name: "temperature",
    unit: "K",
    meaning: "temperature at the centre of the zone that slips",
    over_events: Some(OverEvents::Largest),
};

/// Pressure of the fluid that heat expands.
pub static PRESSURE: Quantity = Quantity {
    name: "pressure",
    unit: "Pa",
    meaning: "pressure of heated fluid in excess of that at the start",
    over_events: None,
};

/// Rate of that pressure.
pub(super) static PRESSURE_RATE: Quantity =
    Quantity { name: "pressure rate", unit: "Pa/s", meaning: "rate of that pressure", over_events: None };
