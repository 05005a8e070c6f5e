//! From a law's parameters to the law.

use crate::scene::law::{Evolution, Form, LawChoice};
use asperity_friction::Failure;
use asperity_friction::coulomb::Coulomb;
use asperity_friction::evolution::{self, ageing::Ageing, slip::Slip, stateless::Stateless};
use asperity_friction::law::Law;
use asperity_friction::rate::RateLaw;
use asperity_friction::strength::{self, Parameters, bare::Bare, regularised::Regularised};
use std::sync::Arc;

/// Builds the law a scene chose.
///
/// # Errors
/// [`Failure::Parameter`] with the admissible range.
pub fn build(choice: &LawChoice) -> Result<Arc<dyn Law>, Failure> {
    match *choice {
        LawChoice::Coulomb { mu, f_limit } => Ok(Arc::new(Coulomb::new(mu, f_limit)?)),
        LawChoice::Rate { form, mu0, a, v_ref, f_limit } => {
            with_form(form, Parameters::new(mu0, a, v_ref)?, Stateless, v_ref, f_limit)
        }
        LawChoice::RateAndState { form, evolution, mu0, a, b, l, v_ref, v_initial, f_limit } => {
            let parameters = Parameters::new(mu0, a, v_ref)?;
            match evolution {
                Evolution::Ageing => {
                    with_form(form, parameters, Ageing::new(b, l, v_ref)?, v_initial, f_limit)
                }
                Evolution::Slip => with_form(form, parameters, Slip::new(b, l, v_ref)?, v_initial, f_limit),
            }
        }
    }
}

fn with_form<E: evolution::Evolution + 'static>(
    form: Form,
    parameters: Parameters,
    evolution: E,
    v_initial: f64,
    f_limit: Option<f64>,
) -> Result<Arc<dyn Law>, Failure> {
    match form {
        Form::Regularised => law(Regularised(parameters), evolution, v_initial, f_limit),
        Form::Bare => law(Bare(parameters), evolution, v_initial, f_limit),
    }
}

fn law<F: strength::Form + 'static, E: evolution::Evolution + 'static>(
    form: F,
    evolution: E,
    v_initial: f64,
    f_limit: Option<f64>,
) -> Result<Arc<dyn Law>, Failure> {
    Ok(Arc::new(RateLaw::new(form, evolution, v_initial, f_limit)?))
}
