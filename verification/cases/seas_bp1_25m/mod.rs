//! The SEAS benchmark BP1-QD over its full duration with the suggested cell size.

use crate::cases::{seas, seas_bp1_full};
use crate::{Capability, Case, CaseError, Ledger};

/// See the README.
pub const CASE: Case = Case {
    name: "seas_bp1_25m",
    readme: include_str!("README.md"),
    covers: &[Capability::FaultCycles, Capability::Antiplane, Capability::AgeingLaw, Capability::Events],
    quick: false,
    run,
};

/// Size of cells \[m\].
const SIZE: f64 = 25.0;
/// Relative error allowed for the first onset.
const SHARE: f64 = 1e-4;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let plan = seas_bp1_full::plan(SIZE)?;
    let found = seas::found(&plan, &plan.problem.settings, |_| {})?;
    seas_bp1_full::cycle(ledger, SIZE, SHARE, &found);
    ledger.table("3000 years", &seas_bp1_full::HEAD, [seas_bp1_full::row(SIZE, &plan, &found)]);
    Ok(())
}
