use asperity_friction::Failure;
use asperity_plan::reading::scene::model::{LawSpec, Spanned, here};
use asperity_plan::shared::law_errors::*;

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
