//! Every law a scene can express is built, and an interface and a slider get the law of the scene.

use crate::common::plain_evolutions;
use asperity_friction::coulomb::Coulomb;
use asperity_friction::law::Law;
use asperity_laws as laws;
use asperity_plan::reading::scene::law::{LawChoice, State};
use asperity_plan::reading::scene::model::{LawSpec, Spanned, here};
use asperity_plan::reading::scene::units::{Length, Velocity};
use serde::Deserialize;

#[derive(Deserialize)]
struct Holder {
    law: Spanned<LawSpec>,
}

fn choose(law: &str) -> LawChoice {
    let holder: Holder = toml::from_str(&format!("law = {{ {law} }}")).unwrap();
    laws::choose(&holder.law).unwrap_or_else(|errors| panic!("{law}: {errors:?}"))
}

/// The friction coefficient of the initial state at a rate \[m/s\] under 50 MPa.
fn coefficient(law: &dyn Law, rate: f64) -> f64 {
    let (mut states, mut mu) = (vec![0.0; law.states()], [0.0]);
    law.initial(&mut states);
    law.coefficient(&[50e6], &[rate], &states, &mut mu).unwrap();
    mu[0]
}

const STRENGTH: &str = "mu0 = 0.6, a = 0.01, v_ref = \"1 um/s\"";
const FORMS: [&str; 4] =
    ["", ", form = \"regularised\"", ", form = \"bare\"", ", form = \"cut-off\", v_cut = \"1 m/s\""];
const HEATS: [&str; 2] = ["", ", activation = 150e3, t_ref = 293.15, temperature = 303.15"];
/// Evolutions with the name of the law, and true if they admit several state variables.
const EVOLUTIONS: [(&str, &str, bool); 5] = [
    ("\"ageing\"", "rate-and-state, ageing law", true),
    ("\"ageing\", v_cut_state = \"1 m/s\"", "rate-and-state, ageing law", true),
    ("\"slip\"", "rate-and-state, slip law", true),
    ("\"nagata\", c = 2", "rate-and-state, Nagata law", false),
    ("\"flash\", mu_w = 0.1, v_w = \"0.1 m/s\"", "rate-and-state, slip law with flash heating", false),
];
const ONE: &str = "b = 0.015, l = \"10 um\"";
const TWO: &str = "b = [0.012, 0.003], l = [\"10 um\", \"100 um\"]";

fn check(text: &str, name: &str, states: usize, sliding: bool) {
    let choice = choose(text);
    let law = laws::build(&choice).unwrap_or_else(|e| panic!("{text}: {e}"));
    assert_eq!((law.name(), law.states()), (name, states), "{text}");
    let mu = coefficient(&*law, 1e-6);
    assert!(mu > 0.3 && mu < 0.9, "{text}: {mu}");
    let slider = laws::build_sliding(&choice).unwrap();
    assert_eq!(slider.is_some(), sliding, "{text}");
    if let Some(slider) = slider {
        assert_eq!((slider.name(), slider.states()), (name, states), "{text}");
    }
}

#[test]
fn every_kind_form_and_evolution_is_built_with_its_states() {
    check("kind = \"coulomb\", mu = 0.6", "coulomb", 0, false);
    check("kind = \"static-kinetic\", mu_s = 0.6, mu_k = 0.5", "static-kinetic", 1, false);
    check("kind = \"slip-weakening\", mu_s = 0.6, mu_k = 0.5, d_c = \"0.4 m\"", "slip-weakening", 1, false);
    for form in FORMS {
        for heat in HEATS {
            let strength = format!("{STRENGTH}{form}{heat}, f_limit = \"100 MPa\"");
            check(&format!("kind = \"rate\", {strength}"), "rate", 0, true);
            for (evolution, name, several) in EVOLUTIONS {
                let law = format!(
                    "kind = \"rate-and-state\", {strength}, v_initial = \"1 um/s\", evolution = {evolution}"
                );
                check(&format!("{law}, {ONE}"), name, 1, true);
                let memory = |alpha| format!("alpha = {alpha}, normal_initial = \"50 MPa\"");
                check(&format!("{law}, {ONE}, {}", memory("0.2")), name, 1, true);
                if several {
                    check(&format!("{law}, {TWO}"), name, 2, true);
                    check(&format!("{law}, {TWO}, {}", memory("[0.2, 0]")), name, 2, true);
                }
            }
        }
    }
}

#[test]
fn lists_give_a_state_variable_each() {
    let law = format!(
        "kind = \"rate-and-state\", {STRENGTH}, v_initial = 1e-6, evolution = \"slip\", {TWO}, alpha = [0.2, 0], \
         normal_initial = \"50 MPa\""
    );
    let LawChoice::RateAndState { states, normal_initial, .. } = choose(&law) else { panic!("{law}") };
    let expected = [State { b: 0.012, l: 10e-6, alpha: 0.2 }, State { b: 0.003, l: 100e-6, alpha: 0.0 }];
    assert_eq!((states.as_slice(), normal_initial), (&expected[..], Some(50e6)));
}

#[test]
fn a_list_of_one_is_one_value() {
    let law = format!("kind = \"rate-and-state\", {STRENGTH}, v_initial = 1e-6, evolution = \"slip\"");
    assert_eq!(
        choose(&format!("{law}, {ONE}")),
        choose(&format!("{law}, b = [0.015], l = \"10 um\", alpha = [0]"))
    );
}

/// Comparison with the formulas: each parameter of a scene reaches the law in its own place.
#[test]
fn parameters_reach_the_law() {
    let close = |law: &str, rate: f64, mu: f64| {
        let found = coefficient(&*laws::build(&choose(law)).unwrap(), rate);
        assert!((found - mu).abs() < 1e-12, "{law}: {found} for {mu}");
    };
    let (bare, cut_off) = (FORMS[2], FORMS[3]);
    close(&format!("kind = \"rate\", {STRENGTH}{bare}"), 1e-4, 0.6 + 0.01 * 1e2_f64.ln());
    close(&format!("kind = \"rate\", {STRENGTH}{cut_off}"), 0.5, 0.6 - 0.01 * 3_f64.ln());
    // A slip rate at T is equivalent to one of exp[(Q/R)(1/T - 1/T_ref)] times its size.
    let heat = 0.01 * 150e3 / 8.314_462_618_153_24 * (1.0 / 303.15 - 1.0 / 293.15);
    close(&format!("kind = \"rate\", {STRENGTH}{bare}{}", HEATS[1]), 1e-6, 0.6 + heat);
    let begun =
        |v_initial| format!("kind = \"rate-and-state\", {STRENGTH}{bare}, v_initial = \"{v_initial}\"");
    let law = begun("1 nm/s");
    let ln = 1e-3_f64.ln();
    for evolution in plain_evolutions() {
        let law = format!("{law}, evolution = \"{evolution}\"");
        close(&format!("{law}, {ONE}"), 1e-9, 0.6 + (0.01 - 0.015) * ln);
        close(&format!("{law}, {TWO}"), 1e-6, 0.6 - 0.015 * ln);
    }
    // Okubo's state effect: φ = b ln(1 + V2 θ/L) with θ = L/V.
    close(&format!("{law}, evolution = {}, {ONE}", EVOLUTIONS[1].0), 1e-6, 0.6 + 0.015 * 1e9_f64.ln_1p());
    // At the initial rate there is no memory of stress; at ten times that rate φ + c μ is unchanged: dμ = a dln V/(1 +
    // c).
    let nagata = format!("{law}, evolution = {}, {ONE}", EVOLUTIONS[3].0);
    close(&nagata, 1e-9, 0.6 - 0.005 * ln);
    close(&nagata, 1e-8, 0.6 - 0.005 * ln + 0.01 * 10_f64.ln() / 3.0);
    // Far above V_w, friction in excess of μ_w decreases as V_w/V.
    close(
        &format!("{}, evolution = {}, {ONE}", begun("1 km/s"), EVOLUTIONS[4].0),
        1e3,
        0.1 + 1e-4 * (0.5 - 0.005 * 1e9_f64.ln()),
    );
    // Under twice the normal traction the state is lower by α ln 2.
    let memory = format!("{law}, evolution = \"slip\", {ONE}, alpha = 0.2, normal_initial = \"25 MPa\"");
    close(&memory, 1e-9, 0.6 - 0.005 * ln - 0.2 * 2_f64.ln());
}

#[test]
fn the_interface_and_the_slider_have_one_law() {
    let law =
        format!("kind = \"rate-and-state\", {STRENGTH}, v_initial = \"1 nm/s\", evolution = \"slip\", {TWO}");
    let choice = choose(&law);
    let (law, slider) = (laws::build(&choice).unwrap(), laws::build_sliding(&choice).unwrap().unwrap());
    assert_eq!(format!("{law:?}"), format!("{slider:?}"));
}

#[test]
fn elastic_laws_have_their_parameters() {
    let coulomb = laws::build(&choose("kind = \"coulomb\", mu = 0.6, f_limit = \"50 MPa\"")).unwrap();
    assert_eq!(format!("{coulomb:?}"), format!("{:?}", Coulomb::new(0.6, Some(50e6)).unwrap()));
    let law = "kind = \"static-kinetic\", mu_s = 0.6, mu_k = 0.5, f_limit = \"50 MPa\"";
    assert_eq!(
        choose(law),
        LawChoice::Yielding { kind: "static-kinetic", own: vec![0.6, 0.5], f_limit: Some(50e6) }
    );
    let law = "kind = \"slip-weakening\", mu_s = 0.6, mu_k = 0.6, d_c = \"40 cm\"";
    assert_eq!(
        choose(law),
        LawChoice::Yielding { kind: "slip-weakening", own: vec![0.6, 0.6, 0.4, 0.0], f_limit: None }
    );
}

#[test]
fn a_law_is_written_in_rust_as_in_a_file() {
    let spec = LawSpec {
        kind: Some(here("rate-and-state".into())),
        evolution: Some(here("slip".into())),
        mu0: Some(here(0.6)),
        a: Some(here(0.01)),
        b: Some(here([0.012, 0.003].into())),
        l: Some(here([Length(10e-6), Length(100e-6)].into())),
        v_ref: Some(here(Velocity(1e-6))),
        v_initial: Some(here(Velocity(1e-6))),
        ..LawSpec::default()
    };
    let law = format!("kind = \"rate-and-state\", {STRENGTH}, v_initial = 1e-6, evolution = \"slip\", {TWO}");
    assert_eq!(laws::choose(&here(spec.clone())), Ok(choose(&law)));
    let one = LawSpec { b: Some(here(0.015.into())), l: Some(here(Length(10e-6).into())), ..spec };
    let law = format!("kind = \"rate-and-state\", {STRENGTH}, v_initial = 1e-6, evolution = \"slip\", {ONE}");
    assert_eq!(laws::choose(&here(one)), Ok(choose(&law)));
}

/// Parameters that the scene accepts are accepted by the law, at the ends of the range of numbers and beyond.
#[test]
fn a_law_that_is_chosen_can_be_built() {
    const POOL: [f64; 14] =
        [0.0, -0.0, 5e-324, 1e-308, 1e-300, 1e-9, 0.1, 0.5, 1.0, 300.0, 1e9, 1e300, f64::MAX, -1.0];
    let mut seed = 0x9e37_79b9_7f4a_7c15_u64;
    let mut draw = |n: usize| {
        seed ^= seed << 13;
        seed ^= seed >> 7;
        seed ^= seed << 17;
        (seed >> 32) as usize % n
    };
    let kinds: [(&str, &[&str]); 3] = [
        ("static-kinetic", &["mu_s", "mu_k"]),
        ("slip-weakening", &["mu_s", "mu_k", "d_c"]),
        (
            "rate-and-state",
            &[
                "mu0",
                "a",
                "b",
                "l",
                "v_ref",
                "v_initial",
                "alpha",
                "normal_initial",
                "c",
                "mu_w",
                "v_w",
                "v_cut",
            ],
        ),
    ];
    let evolutions = asperity_friction::evolution::definitions();
    let (mut passed, mut refused) = ([0; 3], 0);
    for _ in 0..60_000 {
        let kind = draw(3);
        let mut law = format!("kind = \"{}\"", kinds[kind].0);
        let evolution = evolutions[draw(evolutions.len())].name;
        let cut_off = draw(2) == 1;
        if kind == 2 {
            law += &format!(
                ", evolution = \"{evolution}\"{}",
                if cut_off { ", form = \"cut-off\"" } else { "" }
            );
        }
        for &key in kinds[kind].1 {
            let needed = match key {
                "c" => evolution == "nagata",
                "mu_w" | "v_w" => evolution == "flash",
                "v_cut" => cut_off,
                _ => true,
            };
            // Mostly possible numbers, so that the others are combined with them.
            let value = POOL[if draw(4) == 0 { draw(POOL.len()) } else { 5 + draw(5) }];
            if needed {
                law += &format!(", {key} = {value:e}");
            }
        }
        let holder: Holder = toml::from_str(&format!("law = {{ {law} }}")).unwrap();
        match laws::choose(&holder.law) {
            Err(errors) => refused += usize::from(!errors.is_empty()),
            Ok(choice) => {
                passed[kind] += 1;
                assert!(laws::build(&choice).is_ok(), "{law}: {}", laws::build(&choice).unwrap_err());
            }
        }
    }
    assert!(passed.iter().all(|&n| n > 1000) && refused > 1000, "{passed:?} passed, {refused} refused");
}
