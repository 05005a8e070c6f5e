//! Numbers that runs of bodies with mass write, of scenes with closed forms.

mod clamped;
mod columns;
mod delayed;
mod loaded;
mod oblique;
mod partial;
mod remembering;
mod revived;
mod sheet;

use crate::{Capability, Case, CaseError, Ledger};

/// See the README.
pub const CASE: Case = Case {
    name: "explicit_files",
    readme: include_str!("README.md"),
    covers: &[Capability::Waves, Capability::DynamicRupture, Capability::Outputs],
    quick: true,
    run,
};

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    columns::claims(ledger)?;
    oblique::claims(ledger)?;
    delayed::claims(ledger)?;
    sheet::claims(ledger)?;
    loaded::claims(ledger)?;
    partial::claims(ledger)?;
    revived::claims(ledger)?;
    remembering::claims(ledger)?;
    clamped::claims(ledger)
}

/// The smooth step of imposed tractions of this duration, `exp((t - T)²/(t (t - 2T)))`.
fn growth(t: f64, duration: f64) -> f64 {
    if t <= 0.0 {
        0.0
    } else if t >= duration {
        1.0
    } else {
        ((t - duration).powi(2) / (t * (t - 2.0 * duration))).exp()
    }
}

/// Last number of a column.
fn last(column: &[f64]) -> Result<f64, CaseError> {
    column.last().copied().ok_or_else(|| "an empty column".into())
}
