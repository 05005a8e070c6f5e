//! Errors for laws that could not be built, at the parameter that causes them.

use crate::diagnostic::Diagnostic;
use crate::scene::law::given;
use crate::scene::model::{LawSpec, Spanned};
use asperity_friction::Failure;

/// Error for a law, at its parameter, with the admissible values.
#[must_use]
pub fn refused(spec: &Spanned<LawSpec>, failure: &Failure) -> Diagnostic {
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
