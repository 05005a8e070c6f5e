//! Sliding: on a slope, up a wedge, up a cone, past an end and back, and with a curved master over a soft slab.

mod cone;
mod ends;
mod ironing;
mod slope;
mod wedge;

use super::texts::vary;
use crate::{Capability, Case, CaseError, Ledger};

/// See the README.
pub const CASE: Case = Case {
    name: "contact_sliding",
    readme: include_str!("README.md"),
    covers: &[Capability::FiniteSliding, Capability::Coulomb],
    quick: true,
    run,
};

/// Measures, as they are called and as they are written.
const MEASURES: [(&str, &str, Capability); 2] = [
    ("node-to-point", "\"node-to-point\"", Capability::PenaltyContact2d),
    ("mortar", "\"mortar\"", Capability::Mortar),
];

/// Coefficients of friction of the sliding problems.
const COEFFICIENTS: [f64; 4] = [0.0, 0.1, 0.2, 0.3];

/// Slope of the wedge and of the cone.
const SLOPE: f64 = 0.1;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    slope::run(ledger)?;
    wedge::run(ledger)?;
    cone::run(ledger)?;
    ends::run(ledger)?;
    ironing::run(ledger)
}

/// Force along over force across that pushes a body up a slope.
fn ratio(mu: f64) -> f64 {
    (SLOPE + mu) / (1.0 - mu * SLOPE)
}

/// A scene with another coefficient of friction; without friction where it is zero.
fn with_friction(text: &str, mu: f64) -> Result<String, CaseError> {
    let law = "law = { kind = \"coulomb\", mu = 0.3 }\n";
    if mu > 0.0 {
        return vary(text, &[("mu = 0.3", &format!("mu = {mu}"))]);
    }
    let without: String =
        text.lines().filter(|l| !l.starts_with("frictionless")).map(|l| format!("{l}\n")).collect();
    vary(&without, &[(law, ""), (", tangential = \"10 E/h\"", "")])
}
