//! The tables of laws in the book agree with the program; with `UPDATE_TABLES` in the environment they are rewritten.
#![allow(clippy::disallowed_methods)]

use crate::common::varied;
use asperity_friction::evolution::{self, Bound, Definition, Parameter, Unit, Variable};
use asperity_friction::kind::{self, Kind};
use asperity_laws as laws;
use asperity_plan::reading::scene::law::given;
use asperity_plan::reading::scene::model::{LawSpec, Spanned};
use asperity_vary::Change::{Add, With, Without};
use serde::Deserialize;
use std::fs;
use std::path::Path;

const END: &str = "<!-- end -->";

fn begin(table: &str) -> String {
    format!("<!-- {table}, written by the test `law_tables` from the table of the program -->\n")
}

fn parameter(p: &Parameter) -> String {
    let unit = match p.unit {
        Unit::None => "",
        Unit::Velocity => " \\[m/s\\]",
        Unit::Length => " \\[m\\]",
        Unit::Pressure => " \\[Pa\\]",
    };
    let bound = match p.bound {
        Bound::Positive => format!("`{}`{unit}", p.key),
        Bound::NotNegative => format!("`{}`{unit} ≥ 0", p.key),
        Bound::BelowReference => format!("0 ≤ `{}`{unit} < `mu0`", p.key),
    };
    let optional = if p.optional { ", optional" } else { "" };
    let meaning = if p.meaning.is_empty() { String::new() } else { format!(": {}", p.meaning) };
    format!("{bound}{optional}{meaning}")
}

fn row(d: &Definition) -> String {
    let parameters: Vec<String> = d.parameters.iter().map(parameter).collect();
    let states = if d.one_state.is_some() { "one" } else { "several" };
    let variable = match d.variable {
        Variable::Logarithm { .. } => "ln θ",
        Variable::Contribution { .. } => "φ",
    };
    format!("| `\"{}\"` | {} | {} | {variable}, {states} |\n", d.name, d.equation, parameters.join(", "))
}

fn kind_row(k: &Kind) -> String {
    let needed = k.parameters.iter().filter(|p| !p.optional);
    let parameters: Vec<String> = needed.map(parameter).collect();
    let order = k.order.map(|o| {
        let [lower, upper] = [o.lower, o.upper].map(|i| k.parameters[i].key);
        format!("; `{lower}` {} `{upper}`", if o.equal { "≤" } else { "<" })
    });
    let own = k.parameters.iter().filter(|p| p.optional);
    let own = own.map(|p| parameter(&Parameter { optional: false, ..*p }));
    let optional: Vec<String> = own.chain(k.capped.then(|| "`f_limit` \\[Pa\\]".to_owned())).collect();
    let parameters = if parameters.is_empty() { "none".to_string() } else { parameters.join(", ") };
    format!(
        "| `\"{}\"` | {} | {parameters}{} | {} |\n",
        k.name,
        k.meaning,
        order.unwrap_or_default(),
        optional.join(", ")
    )
}

/// Compares a table of the book with the program, or rewrites it.
fn assert_table(name: &str, head: &str, rows: impl Iterator<Item = String>) {
    let columns = head.matches('|').count() - 1;
    let table = format!("{head}\n|{}\n{}", "---|".repeat(columns), rows.collect::<String>());
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/src/scene/laws.md");
    let text = fs::read_to_string(&page).unwrap();
    let begin = begin(name);
    let (head, rest) = text.split_once(&begin).unwrap();
    let (found, tail) = rest.split_once(END).unwrap();
    if std::env::var_os("UPDATE_TABLES").is_some() {
        fs::write(&page, format!("{head}{begin}{table}{END}{tail}")).unwrap();
    } else {
        assert_eq!(found, table, "the table is stale: run the test with UPDATE_TABLES=1");
    }
}

#[test]
fn the_tables_of_the_book_are_those_of_the_program() {
    let kinds = kind::kinds().into_iter().map(kind_row);
    assert_table("kinds", "| `kind` | friction | parameters | optional |", kinds);
    let evolutions = evolution::definitions().into_iter().map(row);
    assert_table("evolutions", "| `evolution` | state | further parameters | state variables |", evolutions);
}

#[derive(Deserialize)]
struct Holder {
    law: Spanned<LawSpec>,
}

/// A scene with the evolution of a row.
fn scene(row: &Definition) -> String {
    let own = row.parameters.iter().map(|p| format!(", {} = {}", p.key, p.example));
    format!(
        "law = {{ kind = \"rate-and-state\", evolution = \"{}\", mu0 = 0.6, a = 0.01, b = 0.015, l = \"10 um\", v_ref = \"1 um/s\", v_initial = \"1 um/s\"{} }}",
        row.name,
        own.collect::<String>()
    )
}

#[test]
fn every_row_of_the_table_is_read_and_built() {
    for row in evolution::definitions() {
        let text = scene(row);
        let holder: Holder = toml::from_str(&text).unwrap();
        // A key that the specification does not read would be lost.
        let given = given(holder.law.get_ref());
        assert!(row.parameters.iter().all(|p| given.iter().any(|g| g.0 == p.key)), "{text}");
        let choice = laws::choose(&holder.law).unwrap_or_else(|e| panic!("{text}: {e:?}"));
        let law = laws::build(&choice).unwrap_or_else(|e| panic!("{text}: {e}"));
        assert_eq!(law.states(), 1, "{text}");
        assert!(laws::build_sliding(&choice).unwrap().is_some(), "{text}");
    }
}

#[test]
fn every_kind_of_the_table_is_read_and_built() {
    for row in kind::kinds() {
        let own = row.parameters.iter().map(|p| format!(", {} = {}", p.key, p.example));
        let text = format!("law = {{ kind = \"{}\"{} }}", row.name, own.collect::<String>());
        let choose = |text: &str| {
            let holder: Holder = toml::from_str(text).unwrap();
            let given = given(holder.law.get_ref()).len();
            (given, laws::choose(&holder.law))
        };
        let (given, choice) = choose(&text);
        // A key that the specification does not read would be lost.
        assert_eq!(given, row.parameters.len(), "{text}");
        let law = laws::build(&choice.unwrap_or_else(|e| panic!("{text}: {e:?}"))).unwrap();
        assert_eq!((law.name(), law.has_elastic_domain()), (row.name, true));
        let capped = varied(&text, &[Add("law.f_limit", "1 MPa")]);
        assert_eq!(choose(&capped).1.is_ok(), row.capped, "{capped}");
        for missing in row.parameters.iter().filter(|p| !p.optional) {
            let without = varied(&text, &[Without(&format!("law.{}", missing.key))]);
            let errors = choose(&without).1.unwrap_err();
            assert!(errors.iter().any(|e| e.to_string().contains(missing.key)), "{without}: {errors:?}");
        }
        if let Some(order) = row.order {
            let key = |k: usize| row.parameters[k].key;
            let high = row.parameters[order.upper].example;
            let turned = varied(&text, &[With(&format!("law.{}", key(order.lower)), &format!("{high}1"))]);
            let errors = choose(&turned).1.unwrap_err();
            assert!(errors[0].to_string().contains(key(order.upper)), "{turned}: {errors:?}");
        }
    }
}

/// θ in stations and fields: in the steady state it is the time to slide over L, or over as many lengths as its equation says.
#[test]
fn theta_of_the_steady_state_is_the_time_to_slide_over_its_length() {
    let (b, length, v_ref, rate) = (0.015, 8e-3, 1e-6, 1e-9_f64);
    for row in evolution::definitions().into_iter().filter(|row| row.name != "flash") {
        let name = row.name;
        // With n lengths dθ/dt = 0 where Vθ = n L; the rows say it as Vθ/nL.
        let lengths = if row.equation.contains("2L") { 2.0 } else { 1.0 };
        let holder: Holder = toml::from_str(&scene(row)).unwrap();
        let law = laws::build_sliding(&laws::choose(&holder.law).unwrap()).unwrap().unwrap();
        let mut state = [0.0];
        law.steady(rate.ln(), &mut state);
        let (time, factor) = row.variable.theta(b, length, v_ref).unwrap();
        let theta = time * (factor * state[0]).exp();
        assert!((theta * rate / (lengths * length) - 1.0).abs() < 1e-12, "{name}: {theta:e}");
    }
    assert!(evolution::definition("flash").unwrap().variable.theta(b, length, v_ref).is_none());
}
