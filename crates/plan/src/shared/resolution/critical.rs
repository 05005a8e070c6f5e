//! Critical stiffness of friction that weakens.

use crate::reading::scene::law::LawChoice;
use asperity_friction::evolution;
use asperity_friction::kind::{self, Weakening};
use schemars::JsonSchema;
use serde::Serialize;

/// Fall of the strength of a surface once it slips, from the least to the worst for a spring that is to hold it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Softening {
    /// It does not.
    None,
    /// By a law whose critical stiffness is not known in advance.
    Unknown,
    /// With slip, so that a spring of the critical stiffness holds it.
    Gradual,
    /// At once, so that no spring holds it.
    Drop,
}

/// Fall of the strength by a law.
#[must_use]
pub fn softening(law: &LawChoice) -> Softening {
    let of_slope = |slope: f64| if slope > 0.0 { Softening::Gradual } else { Softening::None };
    match law {
        LawChoice::Yielding { kind, own, .. } => match kind::weakening(kind, own) {
            Weakening::None => Softening::None,
            Weakening::Drop => Softening::Drop,
            Weakening::Linear { drop, length } => of_slope(drop / length),
        },
        LawChoice::Rate { .. } => Softening::None,
        LawChoice::RateAndState { .. } => critical_slope(law).map_or(Softening::Unknown, of_slope),
    }
}

/// Critical stiffness of a rigid block over the normal traction \[1/m\]: (b - a)/L of rate-and-state friction with one state (J. R. Rice, A. L.
/// Ruina, J. Appl. Mech. 50 (1983), 343-349), and (μ_s - μ_k)/d_c of linear slip weakening. Negative where friction strengthens; `None` for other
/// laws, whose critical stiffness is another.
#[must_use]
pub fn critical_slope(law: &LawChoice) -> Option<f64> {
    match law {
        LawChoice::Yielding { kind, own, .. } => match kind::weakening(kind, own) {
            Weakening::Linear { drop, length } => Some(drop / length),
            _ => None,
        },
        LawChoice::RateAndState { strength, evolution, states, .. } => {
            let [state] = states.as_slice() else { return None };
            // A memory of shear traction changes the critical stiffness.
            let plain = evolution::definition(evolution.name)?.memory.is_none();
            plain.then(|| (state.b - strength.a) / state.l)
        }
        LawChoice::Rate { .. } => None,
    }
}
