//! Rupture of a plane fault in space to its end, against a spectral boundary integral, and the benchmark TPV5.

mod contours;
mod histories;
mod precision;
mod tpv5;

use crate::cases::rupture_in_space::{Reference, Span, energy};
use crate::{Capability, Case, CaseError, Ledger};
use asperity_fem::element::ElementKind;

/// See the README.
pub const CASE: Case = Case {
    name: "rupture_in_space_full",
    readme: include_str!("README.md"),
    covers: &[Capability::DynamicRupture, Capability::Solid3d],
    quick: false,
    run,
};

/// Rock around a quarter of the fault; waves reach its sides at right angles and return, if at all, when the front is past.
const WHOLE: Span = Span {
    kind: ElementKind::Hex8,
    spacing: 100.0,
    extent: [18e3, 9e3, 10.5e3],
    end: 6.5,
    viscosity: 0.0,
    whole: false,
};

/// End of runs on the coarsest cells \[s\], which are late.
const LATE: f64 = 7.2;

/// Time after which all of the fault has ruptured \[s\].
const UNTIL: f64 = 6.2;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let reference = Reference::read()?;
    let p = reference.parameters()?;
    let finest = precision::claims(ledger, &reference, &p)?;
    energy(ledger, "hex27", &finest);
    histories::claims(ledger, &reference, &finest);
    contours::draw(ledger, &reference, &finest);
    tpv5::claims(ledger, &reference)
}
