//! Reading of the parameters of a law. All errors are collected.

use super::choice::{Evolution, FORMS, Form, Heat, LawChoice, State, Strength};
use super::parameters::{Quantity, scalar};
use super::table::Bound::{self, BelowReference, Finite, NotNegative, Positive};
use super::table::{EvolutionRow, KindRow, Laws, OrderRow, ParameterRow};
use crate::diagnostic::Diagnostic;
use crate::model::{LawSpec, Spanned};
use crate::state_values::Several;
use crate::suggestions;
use std::ops::Range;

/// Largest number of state variables of a law: those that a slider can hold.
const MOST_STATES: usize = 14;

/// A value with its position.
type PlacedValue = (f64, Range<usize>);

/// Molar gas constant \[J/(mol K)\], exact in the SI since 2019.
const GAS: f64 = 8.314_462_618_153_24;

/// Reader of the parameters of one law.
pub(super) struct Reader<'a> {
    pub kind: &'static str,
    pub place: Range<usize>,
    pub errors: Vec<Diagnostic>,
    /// True if `b` may be negative.
    pub negative_b: bool,
    pub laws: &'a Laws,
}

impl<'a> Reader<'a> {
    pub fn choice(&mut self, law: &LawSpec) -> Option<LawChoice> {
        let f_limit = self.optional("f_limit", law.f_limit.as_ref(), "\"100 MPa\"", Positive);
        if let Some(row) = self.laws.kind(self.kind) {
            let own = self.yielding(law, row);
            return Some(LawChoice::Yielding { kind: row.name, own: own?, f_limit: f_limit? });
        }
        match self.kind {
            "rate" => Some(LawChoice::Rate { strength: self.strength(law)?, f_limit: f_limit? }),
            _ => self.rate_and_state(law, f_limit),
        }
    }

    fn rate_and_state(&mut self, law: &LawSpec, f_limit: Option<Option<f64>>) -> Option<LawChoice> {
        let strength = self.strength(law);
        let evolution = self.evolution(law);
        let v_initial = self.value("v_initial", law.v_initial.as_ref(), "\"1 um/s\"", Positive);
        let states = self.states(law, evolution.as_ref());
        let normal_initial = self.normal_initial(law);
        Some(LawChoice::RateAndState {
            strength: strength?,
            evolution: evolution.map(|(_, evolution)| evolution)?,
            states: states?,
            v_initial: v_initial?,
            normal_initial: normal_initial?,
            f_limit: f_limit?,
        })
    }

    fn error(&mut self, place: Range<usize>, message: impl Into<String>, help: impl Into<String>) {
        self.errors.push(Diagnostic::at(place, message, help));
    }

    fn missing(&mut self, name: &str, help: impl Into<String>) {
        let message = format!("the law \"{}\" needs `{name}`", self.kind);
        self.error(self.place.clone(), message, help);
    }

    /// Reads a required parameter.
    fn value<Q: Quantity>(
        &mut self,
        name: &str,
        given: Option<&Spanned<Q>>,
        example: &str,
        bound: Bound,
    ) -> Option<f64> {
        let Some(given) = given else {
            self.missing(name, format!("add it, such as `{name} = {example}`"));
            return None;
        };
        self.within(name, (given.get_ref().si(), given.span()), example, bound)
    }

    /// Reads an optional parameter.
    fn optional<Q: Quantity>(
        &mut self,
        name: &str,
        given: Option<&Spanned<Q>>,
        example: &str,
        bound: Bound,
    ) -> Option<Option<f64>> {
        match given {
            None => Some(None),
            Some(_) => self.value(name, given, example, bound).map(Some),
        }
    }

    fn within(&mut self, name: &str, value: PlacedValue, example: &str, bound: Bound) -> Option<f64> {
        let (value, place) = value;
        let zero = matches!(bound, NotNegative | BelowReference) && value == 0.0;
        let admitted = value > 0.0 || zero || bound == Finite;
        if value.is_finite() && admitted {
            return Some(value);
        }
        let sign = match bound {
            Positive => " and positive",
            NotNegative | BelowReference => " and not negative",
            Finite => "",
        };
        let message = format!("`{name}` must be finite{sign}, found {value:?}");
        self.error(place, message, format!("such as `{name} = {example}`"));
        None
    }

    /// Reads a parameter with one entry per state variable. Returns the entries with their positions.
    fn entries<Q: Quantity>(
        &mut self,
        name: &str,
        given: &Spanned<Several<Q>>,
        example: &str,
        bound: Bound,
    ) -> Option<Vec<PlacedValue>> {
        let entries = &given.get_ref().0;
        if entries.is_empty() || entries.len() > MOST_STATES {
            let message = format!("`{name}` has {} entries", entries.len());
            let help = format!("1 to {MOST_STATES} state variables, such as `{name} = {example}`");
            self.error(given.span(), message, help);
            return None;
        }
        let place = |own: Range<usize>| if own.is_empty() { given.span() } else { own };
        let placed = entries.iter().map(|e| (e.get_ref().si(), place(e.span())));
        let read: Vec<Option<PlacedValue>> = placed
            .map(|(v, place)| self.within(name, (v, place.clone()), example, bound).map(|v| (v, place)))
            .collect();
        read.into_iter().collect()
    }

    /// Reads the parameters of a law with an elastic domain; optional ones that are absent are zero.
    fn yielding(&mut self, law: &LawSpec, row: &KindRow) -> Option<Vec<f64>> {
        let read: Vec<Option<f64>> =
            row.parameters.iter().map(|p| self.own(law, p).map(Option::unwrap_or_default)).collect();
        if let Some(OrderRow { lower, upper, equal, help }) = row.order
            && let (Some(low), Some(high)) = (read[lower], read[upper])
            && !(low < high || equal && low == high)
        {
            let words = if equal { "must not exceed" } else { "must be below" };
            let [lower, upper] = [lower, upper].map(|k| row.parameters[k].key);
            let place = |key: &str| scalar(law, key).map(|value| value.1).unwrap_or_default();
            let message = format!("`{lower}` {words} `{upper}`, found {low:?} and {high:?}");
            let error = Diagnostic::at(place(lower), message, help);
            self.errors.push(error.and(place(upper), format!("`{upper}`")));
            return None;
        }
        read.into_iter().collect()
    }

    fn strength(&mut self, law: &LawSpec) -> Option<Strength> {
        let form = self.form(law);
        let mu0 = self.value("mu0", law.mu0.as_ref(), "0.6", Positive);
        let a = self.direct_effect(law);
        let v_ref = self.value("v_ref", law.v_ref.as_ref(), "\"1 um/s\"", Positive);
        let heat = self.heat(law);
        Some(Strength { form: form?, mu0: mu0?, a: a?, v_ref: v_ref?, heat: heat? })
    }

    fn direct_effect(&mut self, law: &LawSpec) -> Option<f64> {
        let Some(a) = &law.a else {
            self.missing("a", "add it, such as `a = 0.01`");
            return None;
        };
        let value = *a.get_ref();
        if value > 0.0 && value.is_finite() {
            return Some(value);
        }
        let (message, help) = if value < 0.0 && value.is_finite() && self.kind == "rate" {
            (
                format!(
                    "the problem is ill-posed: with a = {value:?} the strength falls at once as the slip rate grows. \
                     Without a state, a slip length or inertia nothing bounds the growth of slip at the shortest \
                     wavelengths, and the answer would depend on the mesh"
                ),
                "for weakening use `kind = \"rate-and-state\"` with 0 < a < b and a slip length `l`"
                    .to_string(),
            )
        } else if value < 0.0 && value.is_finite() {
            (
                format!(
                    "the problem is ill-posed: a = {value:?} lets the strength fall at once with the slip rate"
                ),
                "a > 0; weakening comes from b > a, over the slip length `l`".to_string(),
            )
        } else if value == 0.0 {
            (
                "a = 0 leaves no direct effect, so the slip rate cannot be found from the strength"
                    .to_string(),
                "a > 0; for a constant coefficient use `kind = \"coulomb\"`".to_string(),
            )
        } else {
            (format!("`a` must be finite, found {value:?}"), "such as `a = 0.01`".to_string())
        };
        self.error(a.span(), message, help);
        None
    }

    /// Reads the temperature effect: all three parameters or none.
    fn heat(&mut self, law: &LawSpec) -> Option<Option<Heat>> {
        let given = [
            ("activation", &law.activation, "150e3", NotNegative),
            ("t_ref", &law.t_ref, "293.15", Positive),
            ("temperature", &law.temperature, "573.15", Positive),
        ];
        let Some(first) = given.iter().find_map(|g| g.1.as_ref().map(|v| (g.0, v.span()))) else {
            return Some(None);
        };
        if let Some((absent, ..)) = given.iter().find(|g| g.1.is_none()) {
            self.error(
                first.1,
                format!("`{}` needs `{absent}` as well", first.0),
                "give `activation` [J/mol], `t_ref` [K] and `temperature` [K], or none of them",
            );
            return None;
        }
        let values = given.map(|(name, v, example, bound)| self.value(name, v.as_ref(), example, bound));
        let [Some(activation), Some(t_ref), Some(temperature)] = values else { return None };
        let exponent = activation / GAS * (t_ref - temperature) / (t_ref * temperature);
        if !exponent.exp().is_normal() {
            let place = law.temperature.as_ref().map_or(first.1, Spanned::span);
            let message = format!(
                "at {temperature:?} K instead of {t_ref:?} K slip rates change by a factor of e^{exponent:.1}"
            );
            self.error(place, message, "temperatures are in K, and the energy is in J/mol");
            return None;
        }
        Some(Some(Heat { activation, t_ref, temperature }))
    }

    fn form(&mut self, law: &LawSpec) -> Option<Form> {
        let Some(form) = &law.form else { return Some(Form::Regularised) };
        match form.get_ref().as_str() {
            "regularised" => Some(Form::Regularised),
            "bare" => Some(Form::Bare),
            "cut-off" => {
                let v_cut = self.value("v_cut", law.v_cut.as_ref(), "\"1 mm/s\"", Positive)?;
                Some(Form::CutOff { v_cut })
            }
            other => self.unknown(form.span(), other, "form", &FORMS),
        }
    }

    fn evolution(&mut self, law: &LawSpec) -> Option<(&'a EvolutionRow, Evolution)> {
        let known: Vec<&str> = self.laws.names().collect();
        let Some(evolution) = &law.evolution else {
            let known = known.join(", ");
            self.missing("evolution", format!("add it, such as `evolution = \"ageing\"`; there are {known}"));
            return None;
        };
        let Some(row) = self.laws.evolution(evolution.get_ref()) else {
            return self.unknown(evolution.span(), evolution.get_ref(), "evolution", &known);
        };
        let own: Vec<Option<Option<f64>>> = row.parameters.iter().map(|p| self.own(law, p)).collect();
        Some((row, Evolution { name: row.name, own: own.into_iter().collect::<Option<_>>()? }))
    }

    /// Reads a parameter of a row.
    fn own(&mut self, law: &LawSpec, row: &ParameterRow) -> Option<Option<f64>> {
        let &ParameterRow { key, bound, optional, example } = row;
        let Some((value, place)) = scalar(law, key) else {
            if optional {
                return Some(None);
            }
            self.missing(key, format!("add it, such as `{key} = {example}`"));
            return None;
        };
        let value = self.within(key, (value, place.clone()), example, bound)?;
        let reference = law.mu0.as_ref().filter(|mu0| bound == BelowReference && value >= *mu0.get_ref());
        if let Some(mu0) = reference {
            let message = format!("`{key}` must be below `mu0`, found {value:?} and {:?}", mu0.get_ref());
            let help = format!("0 <= {key} < mu0, such as `{key} = {example}`");
            self.errors.push(Diagnostic::at(place, message, help).and(mu0.span(), "`mu0`"));
            return None;
        }
        Some(Some(value))
    }

    /// Reads the state variables: `b`, `l` and `alpha` of each.
    fn states(
        &mut self,
        law: &LawSpec,
        evolution: Option<&(&EvolutionRow, Evolution)>,
    ) -> Option<Vec<State>> {
        for (name, absent, example) in [("b", law.b.is_none(), "0.015"), ("l", law.l.is_none(), "\"10 um\"")]
        {
            if absent {
                self.missing(name, format!("add it, such as `{name} = {example}`"));
            }
        }
        let bound = if self.negative_b { Finite } else { NotNegative };
        let b = law.b.as_ref().and_then(|b| self.entries("b", b, "0.015", bound));
        let l = law.l.as_ref().and_then(|l| self.entries("l", l, "\"10 um\"", Positive));
        let alpha = match &law.alpha {
            None => b.as_ref().map(|b| vec![(0.0, 0..0); b.len()]),
            Some(alpha) => self.entries("alpha", alpha, "0.2", NotNegative),
        };
        let (b, l, alpha) = (b?, l?, alpha?);
        let places = [law.b.as_ref().map(Spanned::span), law.l.as_ref().map(Spanned::span)];
        let [b_place, l_place] = places.map(Option::unwrap_or_default);
        let alpha_place = law.alpha.as_ref().map(Spanned::span).unwrap_or_default();
        for (name, count, place) in [("l", l.len(), l_place), ("alpha", alpha.len(), alpha_place)] {
            if count != b.len() {
                let message = format!(
                    "`{name}` and `b` are of different lengths: {count} and {}, one value for each state variable",
                    b.len()
                );
                let error = Diagnostic::at(place, message, format!("give {} values of `{name}`", b.len()));
                self.errors.push(error.and(b_place.clone(), "`b`"));
                return None;
            }
        }
        self.admitted(evolution?, b_place, &b, &alpha)?;
        let states = b.iter().zip(&l).zip(&alpha);
        Some(states.map(|((b, l), alpha)| State { b: b.0, l: l.0, alpha: alpha.0 }).collect())
    }

    /// Checks that the evolution admits these state variables.
    fn admitted(
        &mut self,
        (row, evolution): &(&EvolutionRow, Evolution),
        place: Range<usize>,
        b: &[PlacedValue],
        alpha: &[PlacedValue],
    ) -> Option<()> {
        let name = row.name;
        if let Some(why) = row.one_state.filter(|_| b.len() > 1) {
            let message =
                format!("the evolution \"{name}\" has one state variable, found {}: {why}", b.len());
            self.error(place, message, "give one value of `b`, `l` and `alpha`");
            return None;
        }
        let memory = row.memory.and_then(|k| evolution.own.get(k).copied().flatten());
        let mut admitted = Some(());
        for ((b, b_place), (alpha, alpha_place)) in b.iter().zip(alpha).filter(|_| row.of_logarithm) {
            // The memories act on the logarithm of θ through 1/b.
            let lost = |memory: f64| memory != 0.0 && !(memory * (1.0 / b)).is_finite();
            if memory.is_some_and(|memory| *b <= 0.0 || lost(memory)) {
                let message = format!("with \"{name}\" `b` must be positive, found {b:?}");
                let help = "such as `b = 0.015`: the memory of shear traction acts through the state";
                self.error(b_place.clone(), message, help);
                admitted = None;
            } else if lost(*alpha) {
                let message = format!(
                    "`alpha` acts through the state, which has no effect on the strength with b = {b:?}"
                );
                let error = Diagnostic::at(alpha_place.clone(), message, "alpha = 0, or b > 0");
                self.errors.push(error.and(b_place.clone(), "`b`"));
                admitted = None;
            }
        }
        admitted
    }

    fn normal_initial(&mut self, law: &LawSpec) -> Option<Option<f64>> {
        let given = law.normal_initial.as_ref();
        match (&law.alpha, given) {
            (None, Some(given)) => {
                let message = "`normal_initial` has no effect without `alpha`, the memory of normal traction";
                self.error(given.span(), message, "remove it, or add `alpha`, such as `alpha = 0.2`");
                None
            }
            (Some(alpha), None) if alpha.get_ref().0.iter().any(|a| *a.get_ref() > 0.0) => {
                let message = "`alpha` needs `normal_initial`, the normal traction under which the states are steady at first";
                self.error(alpha.span(), message, "add it, such as `normal_initial = \"50 MPa\"`");
                None
            }
            _ => self.optional("normal_initial", given, "\"50 MPa\"", Positive),
        }
    }

    fn unknown<T>(&mut self, place: Range<usize>, name: &str, what: &str, known: &[&str]) -> Option<T> {
        let help = suggestions::suggest(name, "choices", known.iter().copied());
        self.error(place, format!("there is no {what} `{name}`"), help);
        None
    }
}
