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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::model::here;

    #[test]
    fn a_refused_parameter_is_shown_at_its_key_with_its_range() {
        let law = LawSpec { mu: Some(Spanned::new(20..24, -1.0)), ..LawSpec::default() };
        let failure = Failure::Parameter { name: "mu", value: -1.0, admissible: "0 <= mu, finite" };
        let error = refused(&Spanned::new(10..40, law), &failure);
        assert_eq!(error.span, 20..24);
        assert_eq!(error.help.as_deref(), Some("give `mu` another value: 0 <= mu, finite"));
        let elsewhere = refused(&here(LawSpec::default()), &failure);
        assert!(elsewhere.span.is_empty());
    }
}
