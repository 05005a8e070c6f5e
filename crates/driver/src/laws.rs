//! From a law's parameters to the law.

use crate::scene::law::{Evolution, Form, LawChoice, State, Strength};
use asperity_friction::Failure;
use asperity_friction::component::Component;
use asperity_friction::coulomb::Coulomb;
use asperity_friction::evolution::{
    self, ageing::Ageing, flash::Flash, flash::Weakening, nagata::Nagata, prz::Prz, slip::Slip,
    stateless::Stateless,
};
use asperity_friction::law::Law;
use asperity_friction::rate::RateLaw;
use asperity_friction::slider::Sliding;
use asperity_friction::slip_weakening::SlipWeakening;
use asperity_friction::static_kinetic::StaticKinetic;
use asperity_friction::strength::{
    self, Parameters, arrhenius::Arrhenius, bare::Bare, cut_off::CutOff, regularised::Regularised,
};
use std::sync::Arc;

/// Builds the law a scene chose.
///
/// # Errors
/// [`Failure::Parameter`] with the admissible range.
pub fn build(choice: &LawChoice) -> Result<Arc<dyn Law>, Failure> {
    Ok(match parts(choice) {
        Parts::Elastic(law) => law?,
        Parts::Sliding(strength, history) => with_form(strength, &history)?,
    })
}

/// Builds the law a scene chose as sliders use it; none where the law has an elastic domain.
///
/// # Errors
/// [`Failure::Parameter`] with the admissible range.
pub fn build_sliding(choice: &LawChoice) -> Result<Option<Arc<dyn Sliding>>, Failure> {
    match parts(choice) {
        Parts::Elastic(law) => law.map(|_| None),
        Parts::Sliding(strength, history) => with_form(strength, &history).map(Some),
    }
}

/// What laws consist of.
enum Parts<'a> {
    /// A law with an elastic domain.
    Elastic(Result<Arc<dyn Law>, Failure>),
    /// A rate-dependent strength with what it remembers.
    Sliding(&'a Strength, History<'a>),
}

/// The states of a law and where they start from.
struct History<'a> {
    /// None without states.
    evolution: Option<Evolution>,
    states: &'a [State],
    v_initial: f64,
    normal_initial: f64,
    f_limit: Option<f64>,
}

fn elastic(law: Result<impl Law + 'static, Failure>) -> Parts<'static> {
    Parts::Elastic(law.map(|law| Arc::new(law) as Arc<dyn Law>))
}

fn parts(choice: &LawChoice) -> Parts<'_> {
    match choice {
        LawChoice::Coulomb { mu, f_limit } => elastic(Coulomb::new(*mu, *f_limit)),
        LawChoice::StaticKinetic { mu_s, mu_k, f_limit } => {
            elastic(StaticKinetic::new(*mu_s, *mu_k, *f_limit))
        }
        LawChoice::SlipWeakening { mu_s, mu_k, d_c, f_limit } => {
            elastic(SlipWeakening::new(*mu_s, *mu_k, *d_c, *f_limit))
        }
        LawChoice::Rate { strength, f_limit } => Parts::Sliding(
            strength,
            // Nothing depends on the start without a state.
            History {
                evolution: None,
                states: &[],
                v_initial: strength.v_ref,
                normal_initial: 1.0,
                f_limit: *f_limit,
            },
        ),
        LawChoice::RateAndState { strength, evolution, states, v_initial, normal_initial, f_limit } => {
            Parts::Sliding(
                strength,
                History {
                    evolution: Some(*evolution),
                    states,
                    v_initial: *v_initial,
                    // Nothing depends on it without a memory of normal traction.
                    normal_initial: normal_initial.unwrap_or(1.0),
                    f_limit: *f_limit,
                },
            )
        }
    }
}

/// A rate-dependent law.
type Made = Result<Arc<dyn Sliding>, Failure>;

fn with_form(s: &Strength, history: &History<'_>) -> Made {
    let parameters = Parameters::new(s.mu0, s.a, s.v_ref)?;
    match s.form {
        Form::Regularised => with_heat(Regularised(parameters), s, history),
        Form::Bare => with_heat(Bare(parameters), s, history),
        Form::CutOff { v_cut } => with_heat(CutOff::new(parameters, v_cut)?, s, history),
    }
}

fn with_heat<F: strength::Form + 'static>(form: F, s: &Strength, history: &History<'_>) -> Made {
    match &s.heat {
        None => with_evolution(form, s, history),
        Some(h) => with_evolution(Arrhenius::new(form, h.activation, h.t_ref, h.temperature)?, s, history),
    }
}

fn with_evolution<F: strength::Form + 'static>(form: F, s: &Strength, history: &History<'_>) -> Made {
    let v_ref = s.v_ref;
    match history.evolution {
        None => assemble(form, history, |_| Ok(Stateless)),
        Some(Evolution::Ageing { v_cut }) => assemble(form, history, |p| {
            let ageing = Ageing::new(p.b, p.l, v_ref)?;
            v_cut.map_or(Ok(ageing), |v| ageing.with_cut_off(v))
        }),
        Some(Evolution::Slip) => assemble(form, history, |p| Slip::new(p.b, p.l, v_ref)),
        Some(Evolution::Prz) => assemble(form, history, |p| Prz::new(p.b, p.l, v_ref)),
        Some(Evolution::Nagata { c }) => assemble(form, history, |p| Nagata::new(p.b, p.l, v_ref, c)),
        Some(Evolution::Flash { mu_w, v_w }) => assemble(form, history, |p| {
            Flash::new(Weakening { mu0: s.mu0, a: s.a, b: p.b, v_ref, mu_w, v_w }, p.l)
        }),
    }
}

fn assemble<F: strength::Form + 'static, E: evolution::Evolution + 'static>(
    form: F,
    history: &History<'_>,
    evolution: impl Fn(&State) -> Result<E, Failure>,
) -> Made {
    let parts = history.states.iter().map(|p| Component::new(evolution(p)?, p.alpha));
    let parts = parts.collect::<Result<Vec<_>, _>>()?;
    let law = RateLaw::with_parts(form, parts, history.v_initial, history.normal_initial, history.f_limit)?;
    Ok(Arc::new(law))
}
