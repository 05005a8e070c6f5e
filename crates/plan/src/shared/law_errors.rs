//! Errors for laws that could not be built, at the parameter that causes them.

use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::law::given;
use crate::reading::scene::model::{LawSpec, Spanned};
use asperity_friction::Failure;

/// Error for a law, at its parameter, with the admissible values.
#[must_use]
pub fn refused(spec: &Spanned<LawSpec>, failure: &Failure) -> Diagnostic {
    if let Failure::Parameter { name: "states", value, .. } = failure {
        return undetermined(spec, *value);
    }
    let (place, help) = match failure {
        Failure::Parameter { name, admissible, .. } => {
            let place = given(spec.get_ref()).into_iter().find(|(key, _)| key == name);
            let help = format!("give `{name}` another value: {admissible}");
            (place.map_or_else(|| spec.span(), |p| p.1), help)
        }
        Failure::BareLogAtRest { .. } | Failure::Negative { .. } => {
            (spec.span(), "use `form = \"regularised\"`".into())
        }
        Failure::Unstable { .. } | Failure::NonFinite { .. } | Failure::NotConverged { .. } => {
            (spec.span(), "give the parameters of the law other values".into())
        }
    };
    Diagnostic::at(place, failure.to_string(), help)
}

/// Error for an initial shear traction that has not one state to determine.
fn undetermined(spec: &Spanned<LawSpec>, states: f64) -> Diagnostic {
    let (has, help) = if states == 0.0 {
        (
            "has no state",
            "leave `shear` out: friction and `rate` give the shear traction at the start; or use `kind = \"rate-and-state\"`",
        )
    } else {
        (
            "has several states",
            "leave `shear` out: the steady states at `rate` give the shear traction at the start; or use a law with one state",
        )
    };
    Diagnostic::at(
        spec.span(),
        format!(
            "an initial shear traction (`shear`) determines the state of the law at the start, and this law {has}"
        ),
        help,
    )
}
