//! Energy budgets as tables.

use super::column::{Column, Sign};
use super::history::{history_row, when};
use crate::OutputFile;
use asperity_run::Energies;

/// The file of the table.
pub const FILE: OutputFile = OutputFile::new("energy.csv", "energy budget over time");

/// Energies in the order of the columns of files, in every kind of run.
pub const ENERGIES: [&str; 15] = [
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
    "unbalanced",
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

/// Columns of what the friction of each interface has dissipated, in this unit, if there are several: that of a single one is the
/// part of the budget.
pub fn friction_columns<'a>(
    unit: &'static str,
    names: impl ExactSizeIterator<Item = &'a str>,
) -> impl Iterator<Item = Column> {
    let shown = if names.len() > 1 { names.len() } else { 0 };
    let own = move |name: &str| {
        Column::new("friction", unit, Sign::None, "energy that friction dissipated").for_part(name)
    };
    names.take(shown).map(own)
}

/// Row of an energy budget, with what the friction of each interface has dissipated if there are several.
#[must_use]
pub fn row(time: f64, stage: usize, step: usize, energies: &Energies, friction: &[f64]) -> String {
    let mut values = ENERGIES.map(|name| energies.part(name)).to_vec();
    values.push(energies.missing());
    values.extend(friction.iter().filter(|_| friction.len() > 1));
    history_row(time, stage, step, &values)
}
