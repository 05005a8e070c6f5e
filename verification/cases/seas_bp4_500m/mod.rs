//! The SEAS benchmark BP4-QD in a whole space with the suggested cell size.

use crate::cases::seas_bp4;
use crate::{Capability, Case, CaseError, Ledger};

/// See the README.
pub const CASE: Case = Case {
    name: "seas_bp4_500m",
    readme: include_str!("README.md"),
    covers: &[Capability::Medium, Capability::FaultCycles, Capability::Solid3d],
    quick: false,
    run,
};

/// Size of cells \[m\].
const SIZE: f64 = 500.0;
/// Events of the run: the one in the seed, and two that nucleate by themselves.
const EVENTS: usize = 3;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let rates = seas_bp4::events(ledger, SIZE, EVENTS)?;
    ledger.plot(rates);
    Ok(())
}
