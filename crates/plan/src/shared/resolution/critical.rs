//! Critical stiffness of friction that weakens.

use crate::reading::scene::law::LawChoice;
use asperity_friction::evolution;
use asperity_friction::kind::{self, Weakening};

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
