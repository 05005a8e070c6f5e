//! A judgement as text.

use super::judgement::{Judgement, QuantityVerdict};
use std::fmt;

/// Heads of the columns.
const HEADS: [&str; 8] =
    ["quantity", "values", "at", "value", "reference", "uncertainty", "tolerance", "verdict"];

impl fmt::Display for Judgement<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rows: Vec<[String; 8]> = self.rows.iter().map(cells).collect();
        let width = |c: usize| rows.iter().map(|row| row[c].chars().count()).fold(HEADS[c].len(), usize::max);
        let widths: [usize; 8] = std::array::from_fn(width);
        write_row(f, HEADS.map(str::to_string), widths)?;
        for row in rows {
            write_row(f, row, widths)?;
        }
        writeln!(f)?;
        for row in &self.rows {
            if let Some(text) = row.suspicion() {
                writeln!(f, "{}: {text}", row.quantity.name)?;
            }
        }
        let (agree, all) = self.required();
        writeln!(f, "{agree} of {all} required quantities agree with {}", self.reference.benchmark)
    }
}

fn write_row(f: &mut fmt::Formatter<'_>, row: [String; 8], widths: [usize; 8]) -> fmt::Result {
    let cells = row.iter().zip(widths).map(|(cell, width)| format!("{cell:width$}"));
    writeln!(f, "{}", cells.collect::<Vec<_>>().join("  ").trim_end())
}

/// Cells of a quantity; of several values the one farthest from its reference.
fn cells(row: &QuantityVerdict<'_>) -> [String; 8] {
    let quantity = row.quantity;
    let unit = |unit: &str| if unit == "1" { String::new() } else { format!(" [{unit}]") };
    let name = format!("{}{}", quantity.name, unit(&quantity.unit));
    let count = format!("{}/{}", row.given, quantity.places.len());
    let verdict = row.verdict.words().to_string();
    let Some((value, place)) = row.worst else {
        return [
            name,
            count,
            String::new(),
            String::new(),
            String::new(),
            String::new(),
            String::new(),
            verdict,
        ];
    };
    let at = place.at.map_or(String::new(), |at| {
        format!("{at}{}", quantity.along.as_ref().map_or(String::new(), |a| unit(&a.unit)))
    });
    [
        name,
        count,
        at,
        number(value),
        number(place.value),
        few(place.uncertainty),
        few(place.tolerance),
        verdict,
    ]
}

/// Number with seven digits.
fn number(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 || (1e-3..1e6).contains(&size) {
        let digits = 6 - size.max(1e-3).log10().floor() as i32;
        format!("{value:.*}", digits.clamp(0, 9) as usize)
    } else {
        format!("{value:.6e}")
    }
}

/// Number with two digits.
fn few(value: f64) -> String {
    if value == 0.0 { "0".into() } else { format!("{value:.1e}") }
}
