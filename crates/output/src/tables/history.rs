//! Histories: tables with a row per step, which begins with its time, the number of the stage and of the steps.

use super::column::{self, Column, Sign};
use super::csv_rows::Rows;
use crate::decimals::{shortest, shortest_scientific};

/// First columns of a history.
pub(crate) fn when() -> [Column; 3] {
    let stage = Column::new("stage", "", Sign::None, "number of the stage, from 0");
    let step = Column::new("step", "", Sign::None, "number of steps taken");
    [column::time(), stage, step]
}

/// One row of a history: time, stage, step, values.
pub(crate) fn history_row(time: f64, stage: usize, step: usize, values: &[f64]) -> String {
    let mut rows = Rows::default();
    let when = [number(time), stage.to_string(), step.to_string()];
    rows.push(when.into_iter().chain(values.iter().map(|&v| number(v))));
    rows.text()
}

/// The shortest decimal that reads back as the same number, with an exponent if that is easier to read.
pub(crate) fn number(value: f64) -> String {
    // Outside this range positional notation is mostly zeros.
    if value == 0.0 {
        return "0".into();
    }
    if (1e-2..1e6).contains(&value.abs()) { shortest(value) } else { shortest_scientific(value) }
}
