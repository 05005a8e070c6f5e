//! Energy budgets as tables.

use super::column::{Column, Sign};
use super::history::{history_row, when};
use crate::OutputFile;
use asperity_run::Energies;

/// The file of the table.
pub const FILE: OutputFile = OutputFile::new("energy.csv", "energy budget over time");

/// Energies in the order of the columns of files, in every kind of run.
pub const ENERGIES: [&str; 14] = [
    "kinetic",
    "elastic",
    "contact",
    "springs",
    "plastic",
    "viscous",
    "friction",
    "numerical",
    "absorbed",
    "handover",
    "start",
    "loads",
    "motions",
    "released",
];

/// Columns of an energy budget in this unit.
#[must_use]
pub fn columns(unit: &'static str) -> Vec<Column> {
    let part = |name| Column::new(name, unit, Sign::None, "part of the energy budget");
    let missing = Column::new("missing", unit, Sign::None, "energy given minus energy kept and lost");
    when().into_iter().chain(ENERGIES.map(part)).chain([missing]).collect()
}

/// Row of an energy budget.
#[must_use]
pub fn row(time: f64, stage: usize, step: usize, energies: &Energies) -> String {
    let mut values = ENERGIES.map(|name| energies.part(name)).to_vec();
    values.push(energies.missing());
    history_row(time, stage, step, &values)
}
