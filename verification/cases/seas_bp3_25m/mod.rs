//! The SEAS benchmark BP3-QD at dip 90 with the suggested cell size.

use crate::cases::seas_bp3::{self, Faulting, Sense};
use crate::cases::seas_bp3_full::{HEAD, integrate, row, vertical};
use crate::{Capability, Case, CaseError, Ledger};

/// See the README.
pub const CASE: Case = Case {
    name: "seas_bp3_25m",
    readme: include_str!("README.md"),
    covers: &[Capability::FaultCycles, Capability::PlaneStrain, Capability::AgeingLaw, Capability::Events],
    quick: false,
    run,
};

const FAULT: Faulting = (90.0, Sense::Thrust);
/// Cell size \[m\].
const SIZE: f64 = 25.0;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let cycles = integrate(FAULT, SIZE)?;
    seas_bp3::first(ledger, FAULT, SIZE, &cycles.found)?;
    vertical(ledger, SIZE, &cycles)?;
    ledger.table("1500 years", &HEAD, [row(FAULT, SIZE, &cycles)]);
    Ok(())
}
