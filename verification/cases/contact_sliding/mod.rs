//! Sliding on a slope, up a wedge, up a cone, past an end and back, from body to body, and of a round die over a soft slab.

mod cone;
mod ends;
mod ironing;
mod jam;
mod joint;
mod slope;
mod twist;
mod wedge;

use crate::{Capability, Case, CaseError, Ledger};
use asperity_vary::SceneText;

/// See the README.
pub const CASE: Case = Case {
    name: "contact_sliding",
    readme: include_str!("README.md"),
    covers: &[Capability::FiniteSliding, Capability::Coulomb],
    quick: true,
    run,
};

/// Contact measures and their capabilities.
const MEASURES: [(&str, Capability); 2] =
    [("node-to-point", Capability::PenaltyContact2d), ("mortar", Capability::Mortar)];

/// Coefficients of friction of the sliding problems.
const COEFFICIENTS: [f64; 4] = [0.0, 0.1, 0.2, 0.3];

/// Slope of the wedge and of the cone.
const SLOPE: f64 = 0.1;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    slope::run(ledger)?;
    wedge::run(ledger)?;
    cone::run(ledger)?;
    ends::run(ledger)?;
    joint::run(ledger)?;
    jam::run(ledger)?;
    twist::run(ledger)?;
    ironing::run(ledger)
}

/// Ratio of the pushing force to the transverse force for a body that moves up the slope.
fn ratio(mu: f64) -> f64 {
    (SLOPE + mu) / (1.0 - mu * SLOPE)
}

/// A scene with another coefficient of friction on its interface; frictionless if it is zero.
fn with_friction(text: &str, interface: &str, mu: f64) -> SceneText {
    let scene = SceneText::new(text);
    let key = |name: &str| format!("interfaces.{interface}.{name}");
    if mu > 0.0 {
        return scene.with_or_same(&key("law.mu"), mu);
    }
    let scene = scene.without(&key("law")).without(&key("enforcement.tangential"));
    // The stage key `frictionless` goes too: there is no friction to leave out.
    if text.contains("\nfrictionless") { scene.without("stages[0].frictionless") } else { scene }
}
