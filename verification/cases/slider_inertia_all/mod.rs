//! All sliders with mass of `slider_inertia`.

use super::slider_inertia::{agree, all, compare, drawn};
use crate::{Capability, Case, CaseError, Ledger};

/// See the README.
pub const CASE: Case = Case {
    name: "slider_inertia_all",
    readme: include_str!("README.md"),
    covers: &[Capability::Integrators, Capability::Events],
    quick: false,
    run,
};

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let sets = all();
    drawn(ledger, &sets[0])?;
    agree(ledger, &sets)?;
    compare(ledger, &sets)
}
