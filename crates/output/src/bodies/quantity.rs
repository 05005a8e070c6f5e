//! Quantities on interfaces, which tables and fields show under one name.

use super::view::InterfaceFields;
use crate::fields::{Data, Field};
use crate::tables::{Column, Sign};

/// A number at the nodes of an interface: its name and meaning, and the function that reads it.
pub(super) struct Quantity {
    name: &'static str,
    unit: &'static str,
    sign: Sign,
    meaning: &'static str,
    pub read: fn(&InterfaceFields, usize) -> f64,
    /// True if fields have it as small whole numbers.
    small: bool,
}

impl Quantity {
    const fn new(
        name: &'static str,
        unit: &'static str,
        sign: Sign,
        meaning: &'static str,
        read: fn(&InterfaceFields, usize) -> f64,
    ) -> Self {
        Self { name, unit, sign, meaning, read, small: false }
    }

    /// The quantity as a column.
    pub fn column(&self) -> Column {
        Column::new(self.name, self.unit, self.sign, self.meaning)
    }

    /// The quantity as a field.
    pub fn field(&self) -> Field {
        Field::scalar(self.name, self.unit, self.sign, self.meaning)
    }

    /// Values of the field.
    pub fn data<'s>(&self, fields: &'s InterfaceFields) -> Data<'s> {
        let values = fields.nodes().map(|node| (self.read)(fields, node));
        if self.small {
            values.map(|value| value as u8).collect::<Vec<_>>().into()
        } else {
            values.collect::<Vec<_>>().into()
        }
    }

    /// The quantity as small whole numbers.
    const fn small(self) -> Self {
        Self { small: true, ..self }
    }
}

/// Meaning of the states of a law.
pub(super) const STATE: &str = "state variable of the law";

pub(super) const GAP: Quantity = Quantity::new(
    "gap",
    "m",
    Sign::Apart,
    "normal gap, negative for penetration",
    InterfaceFields::written_gap,
);
pub(super) const NORMAL_TRACTION: Quantity =
    Quantity::new("normal_traction", "Pa", Sign::Compression, "normal traction", |f, i| f.normal_traction[i]);
pub(super) const SHEAR_TRACTION: Quantity =
    Quantity::new("shear_traction", "Pa", Sign::Slip, "shear traction", |f, i| f.shear_traction[i]);
pub(super) const RELATIVE_DISPLACEMENT: Quantity =
    Quantity::new("relative_displacement", "m", Sign::Slip, "motion of the slave past the master", |f, i| {
        f.relative_displacement[i]
    });
pub(super) const SLIP: Quantity =
    Quantity::new("slip", "m", Sign::Slip, "plastic part of the relative displacement", |f, i| f.slip[i]);
pub(super) const SLIP_RATE: Quantity =
    Quantity::new("slip_rate", "m/s", Sign::Slip, "rate of slip", |f, i| f.slip_rate[i]);
pub(super) const FRICTION: Quantity =
    Quantity::new("friction", "-", Sign::Size, "shear over normal traction", |f, i| f.friction[i]);
pub(super) const MEAN_NORMAL_TRACTION: Quantity = Quantity::new(
    "mean_normal_traction",
    "Pa",
    Sign::Compression,
    "normal traction averaged around the node",
    |f, i| f.mean_normal_traction[i],
);
pub(super) const MEAN_SHEAR_TRACTION: Quantity = Quantity::new(
    "mean_shear_traction",
    "Pa",
    Sign::Slip,
    "shear traction averaged around the node",
    |f, i| f.mean_shear_traction[i],
);
pub(super) const FRICTION_WORK: Quantity = Quantity::new(
    "friction_work",
    "J/m2",
    Sign::Size,
    "energy per area that friction has dissipated since the start",
    |f, i| f.friction_work[i],
);
pub(super) const STATUS: Quantity =
    Quantity::new("status", "0 open 1 stick 2 slip", Sign::None, "state of contact", |f, i| {
        f64::from(f.status[i])
    })
    .small();
pub(super) const PAIRED: Quantity =
    Quantity::new("paired", "0 no 1 yes", Sign::None, "0 where the node has no partner", |f, i| {
        f64::from(u8::from(f.paired(i)))
    })
    .small();
pub(super) const AREA: Quantity = Quantity::new("area", "m2", Sign::Size, "tributary area", |f, i| f.area[i]);
