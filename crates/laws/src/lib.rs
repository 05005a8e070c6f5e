#![doc = include_str!("../README.md")]

mod theta;

pub use theta::Theta;

use asperity_friction::Failure;
use asperity_friction::component::Component;
use asperity_friction::coulomb::Coulomb;
use asperity_friction::evolution::{
    self, Common, Definition, TableEvolution, Variable, Visit, stateless::Stateless,
};
use asperity_friction::fault::{FaultLaw, Points};
use asperity_friction::inertial::{self, Inertial, InertialFault};
use asperity_friction::kind::{self, Kind, Order, PointValues, TableLaw};
use asperity_friction::law::Law;
use asperity_friction::pointwise::PointwiseLaw;
use asperity_friction::rate::RateLaw;
use asperity_friction::slider::SliderLaw;
use asperity_friction::slip_weakening::SlipWeakening;
use asperity_friction::static_kinetic::StaticKinetic;
use asperity_friction::strength::{
    self, Parameters, arrhenius::Arrhenius, bare::Bare, cut_off::CutOff, regularised::Regularised,
};
use asperity_scene::diagnostic::Diagnostic;
use asperity_scene::law::{
    self, Bound, Evolution, EvolutionRow, Form, KindRow, LawChoice, Laws, OrderRow, ParameterRow, State,
    Strength,
};
use asperity_scene::model::{LawSpec, Spanned};
use std::sync::{Arc, LazyLock};

/// Friction laws that scenes may name.
#[must_use]
pub fn known() -> &'static Laws {
    static KNOWN: LazyLock<Laws> = LazyLock::new(|| Laws {
        kinds: kind::kinds().into_iter().map(kind_row).collect(),
        evolutions: evolution::definitions().into_iter().map(row).collect(),
    });
    &KNOWN
}

/// Properties of a kind of law that scenes need.
fn kind_row(kind: &Kind) -> KindRow {
    let order = |&Order { lower, upper, equal, help }: &Order| OrderRow { lower, upper, equal, help };
    KindRow {
        name: kind.name,
        parameters: kind.parameters.iter().map(parameter).collect(),
        capped: kind.capped,
        order: kind.order.as_ref().map(order),
    }
}

fn parameter(p: &evolution::Parameter) -> ParameterRow {
    ParameterRow {
        key: p.key,
        bound: match p.bound {
            evolution::Bound::Positive => Bound::Positive,
            evolution::Bound::NotNegative => Bound::NotNegative,
            evolution::Bound::BelowReference => Bound::BelowReference,
        },
        optional: p.optional,
        example: p.example,
    }
}

/// Properties of an evolution law that scenes need.
fn row(definition: &Definition) -> EvolutionRow {
    EvolutionRow {
        name: definition.name,
        parameters: definition.parameters.iter().map(parameter).collect(),
        one_state: definition.one_state,
        of_logarithm: matches!(definition.variable, Variable::Logarithm { .. }),
        memory: definition.memory,
    }
}

/// Chooses the law of a specification.
///
/// # Errors
/// A diagnostic for each parameter that is missing, belongs to another law, or is out of range.
pub fn choose(spec: &Spanned<LawSpec>) -> Result<LawChoice, Vec<Diagnostic>> {
    law::choose(spec, known())
}

/// Chooses the law of a slider, whose evolution effect `b` may be negative.
///
/// # Errors
/// As [`choose`].
pub fn choose_sliding(spec: &Spanned<LawSpec>) -> Result<LawChoice, Vec<Diagnostic>> {
    law::choose_sliding(spec, known())
}

/// Builds the law that a scene chose.
///
/// # Errors
/// [`Failure::Parameter`] with the admissible range.
pub fn build(choice: &LawChoice) -> Result<Arc<dyn Law>, Failure> {
    Ok(match parts(choice) {
        Parts::Elastic(law) => law?,
        Parts::Sliding(strength, history) => single(strength, history)?,
    })
}

/// Builds a law with parameters of its own at each point of an interface; all are of the kind of the first.
///
/// # Errors
/// [`Failure::Parameter`] with the admissible range, also for laws of different kinds.
pub fn build_each(first: &LawChoice, rest: &[LawChoice]) -> Result<Arc<dyn Law>, Failure> {
    let unlike = Failure::Parameter { name: "laws", value: f64::NAN, admissible: "laws of one kind" };
    if let LawChoice::Yielding { kind, .. } = first {
        let own = |choice| match choice {
            &LawChoice::Yielding { kind: of, ref own, f_limit } if of == *kind => {
                Some(PointValues { own, cap: f_limit })
            }
            _ => None,
        };
        let all: Option<Vec<_>> = std::iter::once(first).chain(rest).map(own).collect();
        return kind::build_each(kind, &all.ok_or(unlike)?);
    }
    let sliding = |choice| match parts(choice) {
        Parts::Sliding(strength, history) if first.same_kind(choice) => Some((strength, history)),
        _ => None,
    };
    let part = sliding(first).ok_or_else(|| unlike.clone())?;
    let rest: Option<Vec<_>> = rest.iter().map(sliding).collect();
    with_form(&List { first: part, rest: rest.ok_or(unlike)? }, InterfaceBuilder)?
}

/// Builds the law that a scene chose for sliders; `None` if it has an elastic domain.
///
/// # Errors
/// [`Failure::Parameter`] with the admissible range.
pub fn build_sliding(choice: &LawChoice) -> Result<Option<Arc<dyn SliderLaw>>, Failure> {
    match parts(choice) {
        Parts::Elastic(law) => law.map(|_| None),
        Parts::Sliding(strength, history) => single(strength, history).map(Some),
    }
}

/// Builds the laws of the points of a fault, which are of one kind; `None` if the law has an elastic domain.
///
/// # Errors
/// [`Failure::Parameter`] with the admissible range.
pub fn build_fault(first: &LawChoice, rest: &[LawChoice]) -> Result<Option<Box<dyn FaultLaw>>, Failure> {
    let sliding = |choice| match parts(choice) {
        Parts::Elastic(_) => None,
        Parts::Sliding(strength, history) => Some((strength, history)),
    };
    let Some(first) = sliding(first) else { return Ok(None) };
    with_form(&List { first, rest: rest.iter().filter_map(sliding).collect() }, FaultBuilder).map(Some)
}

/// Builds the laws of the points of a fault between bodies with mass, which are of one kind; `None` if it is a bond.
///
/// # Errors
/// [`Failure::Parameter`] with the admissible range.
pub fn build_inertial(
    first: &LawChoice,
    rest: &[LawChoice],
) -> Result<Option<Box<dyn InertialFault>>, Failure> {
    if let LawChoice::Yielding { kind, .. } = first {
        let all: Vec<&LawChoice> = std::iter::once(first).chain(rest).collect();
        return match *kind {
            "coulomb" => yielding::<Coulomb>(&all).map(Some),
            "static-kinetic" => yielding::<StaticKinetic>(&all).map(Some),
            "slip-weakening" => yielding::<SlipWeakening>(&all).map(Some),
            _ => Ok(None),
        };
    }
    let sliding = |choice| match parts(choice) {
        Parts::Elastic(_) => None,
        Parts::Sliding(strength, history) => Some((strength, history)),
    };
    let Some(first) = sliding(first) else { return Ok(None) };
    with_form(&List { first, rest: rest.iter().filter_map(sliding).collect() }, InertialFaultBuilder)
        .map(Some)
}

/// Laws of points that are all of one kind with an elastic domain.
fn yielding<L: TableLaw + Inertial>(all: &[&LawChoice]) -> Result<Box<dyn InertialFault>, Failure> {
    let own = |choice: &&LawChoice| match choice {
        LawChoice::Yielding { own, f_limit, .. } => Some(<L as TableLaw>::build(own, *f_limit)),
        LawChoice::Rate { .. } | LawChoice::RateAndState { .. } => None,
    };
    let laws: Vec<L> = all.iter().filter_map(own).collect::<Result<_, _>>()?;
    Ok(Box::new(inertial::InertialPoints(laws)))
}

/// Components of a law.
enum Parts<'a> {
    /// A law with an elastic domain.
    Elastic(Result<Arc<dyn Law>, Failure>),
    /// A rate-dependent strength with its state variables.
    Sliding(&'a Strength, History<'a>),
}

/// State variables of a law and their initial values.
struct History<'a> {
    /// `None` without state variables.
    evolution: Option<&'a Evolution>,
    states: &'a [State],
    v_initial: f64,
    normal_initial: f64,
    f_limit: Option<f64>,
}

fn parts(choice: &LawChoice) -> Parts<'_> {
    match choice {
        LawChoice::Yielding { kind, own, f_limit } => Parts::Elastic(kind::build(kind, own, *f_limit)),
        LawChoice::Rate { strength, f_limit } => Parts::Sliding(
            strength,
            // Without state variables the initial values have no effect.
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
                    evolution: Some(evolution),
                    states,
                    v_initial: *v_initial,
                    // Has no effect on laws without memory of normal traction.
                    normal_initial: normal_initial.unwrap_or(1.0),
                    f_limit: *f_limit,
                },
            )
        }
    }
}

/// Builds a product from laws of one kind, for any kind.
trait Finish {
    type Product;

    fn finish<L: SliderLaw + Inertial + Clone + 'static>(self, first: L, rest: Vec<L>) -> Self::Product;
}

/// Builds the single law of an interface or slider.
struct LawBuilder;

impl Finish for LawBuilder {
    type Product = Arc<dyn SliderLaw>;

    fn finish<L: SliderLaw + Inertial + Clone + 'static>(self, first: L, _: Vec<L>) -> Self::Product {
        Arc::new(first)
    }
}

/// Builds the law of an interface whose parameters vary from point to point.
struct InterfaceBuilder;

impl Finish for InterfaceBuilder {
    type Product = Result<Arc<dyn Law>, Failure>;

    fn finish<L: SliderLaw + Inertial + Clone + 'static>(self, first: L, rest: Vec<L>) -> Self::Product {
        Ok(Arc::new(PointwiseLaw::new(std::iter::once(first).chain(rest).collect())?))
    }
}

/// Builds the laws of the points of a fault.
struct FaultBuilder;

impl Finish for FaultBuilder {
    type Product = Box<dyn FaultLaw>;

    fn finish<L: SliderLaw + Inertial + Clone + 'static>(self, first: L, rest: Vec<L>) -> Self::Product {
        Box::new(Points::new(std::iter::once(first).chain(rest).collect()))
    }
}

/// Builds the laws of the points of a fault between bodies with mass.
struct InertialFaultBuilder;

impl Finish for InertialFaultBuilder {
    type Product = Box<dyn InertialFault>;

    fn finish<L: SliderLaw + Inertial + 'static>(self, first: L, rest: Vec<L>) -> Self::Product {
        Box::new(inertial::InertialPoints(std::iter::once(first).chain(rest).collect()))
    }
}

/// Components of one law: strength and state variables.
type Part<'a> = (&'a Strength, History<'a>);

/// Laws of one kind with different parameters.
struct List<'a> {
    first: Part<'a>,
    rest: Vec<Part<'a>>,
}

fn single(strength: &Strength, history: History<'_>) -> Result<Arc<dyn SliderLaw>, Failure> {
    with_form(&List { first: (strength, history), rest: Vec::new() }, LawBuilder)
}

fn with_form<M: Finish>(list: &List<'_>, builder: M) -> Result<M::Product, Failure> {
    let parameters = |s: &Strength| Parameters::new(s.mu0, s.a, s.v_ref);
    match list.first.0.form {
        Form::Bare => with_heat(list, builder, |s| Ok(Bare(parameters(s)?))),
        Form::CutOff { v_cut } => with_heat(list, builder, |s| CutOff::new(parameters(s)?, v_cut)),
        Form::Regularised => with_heat(list, builder, |s| Ok(Regularised(parameters(s)?))),
    }
}

fn with_heat<M: Finish, F: strength::Form + 'static>(
    list: &List<'_>,
    builder: M,
    form: impl Fn(&Strength) -> Result<F, Failure>,
) -> Result<M::Product, Failure> {
    match list.first.0.heat {
        None => with_evolution(list, builder, form),
        Some(h) => {
            with_evolution(list, builder, |s| Arrhenius::new(form(s)?, h.activation, h.t_ref, h.temperature))
        }
    }
}

fn with_evolution<M: Finish, F: strength::Form + 'static>(
    list: &List<'_>,
    builder: M,
    form: impl Fn(&Strength) -> Result<F, Failure>,
) -> Result<M::Product, Failure> {
    let Some(chosen) = list.first.1.evolution else {
        return assemble(list, builder, form, |_, _| Ok(Stateless));
    };
    let admissible = "an evolution of the table";
    let unknown = Failure::Parameter { name: "evolution", value: f64::NAN, admissible };
    evolution::with(chosen.name, EvolutionVisitor { list, builder, form, own: &chosen.own }).ok_or(unknown)?
}

/// Visitor that builds laws of the given evolution.
struct EvolutionVisitor<'a, M, F> {
    list: &'a List<'a>,
    builder: M,
    form: F,
    own: &'a [Option<f64>],
}

impl<M: Finish, F: strength::Form + 'static, B: Fn(&Strength) -> Result<F, Failure>> Visit
    for EvolutionVisitor<'_, M, B>
{
    type Product = Result<M::Product, Failure>;

    fn visit<E: TableEvolution + 'static>(self) -> Self::Product {
        let Self { list, builder, form, own } = self;
        assemble(list, builder, form, |s, p| {
            let common = Common { mu0: s.mu0, a: s.a, v_ref: s.v_ref, b: p.b, length: p.l };
            E::build(&common, own)
        })
    }
}

fn assemble<M: Finish, F: strength::Form + 'static, E: evolution::Evolution + 'static>(
    list: &List<'_>,
    builder: M,
    form: impl Fn(&Strength) -> Result<F, Failure>,
    evolution: impl Fn(&Strength, &State) -> Result<E, Failure>,
) -> Result<M::Product, Failure> {
    let law = |(strength, history): &Part<'_>| {
        let parts = history.states.iter().map(|p| Component::new(evolution(strength, p)?, p.alpha));
        let parts = parts.collect::<Result<Vec<_>, _>>()?;
        RateLaw::with_parts(
            form(strength)?,
            parts,
            history.v_initial,
            history.normal_initial,
            history.f_limit,
        )
    };
    let rest = list.rest.iter().map(law).collect::<Result<Vec<_>, _>>()?;
    Ok(builder.finish(law(&list.first)?, rest))
}
