//! Loads and stages end to end, against closed forms.

use crate::common::{SANDWICH, varied};
use asperity_driver::plan::{self, AnyPlan};
use asperity_driver::report::{Outcome, RunReport};
use asperity_driver::{run, scene};
use asperity_output::Recorder;
use asperity_vary::Change::{Push, With, Without};

/// A 1 x 2 m column of E = 10 GPa, nu = 0.25, rollers at the sides and the bottom, with one more condition.
fn column(element: &str, extra_body: &str, condition: &str) -> String {
    format!(
        r#"
schema = 1
title = "column"
kinematics = "plane-strain"
[materials.rock]
young = "10 GPa"
poisson = 0.25
density = "2500 kg/m^3"
[bodies.C]
mesh.block = {{ min = [0, 0], max = [1, 2], divisions = [2, 4], element = "{element}" }}
material = "rock"
{extra_body}
[[stages]]
name = "load"
duration = "1 s"
steps = 1
conditions = [
    {{ set = "C.left", symmetry = true }},
    {{ set = "C.right", symmetry = true }},
    {{ set = "C.bottom", symmetry = true }},
    {condition}
]
[time]
stepper = "implicit"
"#
    )
}

/// Modulus of uniaxial strain E (1 - nu)/((1 + nu)(1 - 2 nu)) \[Pa\].
const MODULUS: f64 = 10e9 * 0.75 / (1.25 * 0.5);

fn simulate(text: &str) -> (RunReport, Recorder) {
    let scene = scene::read(text).unwrap_or_else(|e| panic!("{e}"));
    let plan = plan::plan(&scene).unwrap();
    let mut record = Recorder::new().with_bodies();
    let report = run::run(&plan, &mut record).unwrap();
    assert_eq!(report.outcome, Outcome::Completed);
    (report, record)
}

/// Displacement in y of the nodes on top \[m\].
fn top(record: &Recorder) -> Vec<f64> {
    let end = record.stage_ends().last().unwrap();
    let fields = end.bodies.as_ref().unwrap();
    let nodes = &record.setup().mesh.nodes;
    nodes.iter().zip(&fields.displacement).filter(|(x, _)| x[1] == 2.0).map(|(_, u)| u[1]).collect()
}

#[test]
fn pressure_and_traction_press_a_column_by_its_uniaxial_modulus() {
    let exact = -3e6 * 2.0 / MODULUS;
    for condition in [
        r#"{ set = "C.top", pressure = "3 MPa" },"#,
        r#"{ set = "C.top", traction = [0, { to = "-3 MPa" }] },"#,
        r#"{ set = "C.top", pressure = { table = [["0 s", "0 MPa"], ["1 s", "3 MPa"]] } },"#,
    ] {
        for element in ["quad4", "quad9", "tri3", "tri6"] {
            let (_, record) = simulate(&column(element, "", condition));
            for u in top(&record) {
                assert!((u / exact - 1.0).abs() < 1e-11, "{element}: {u} {exact}");
            }
        }
    }
}

#[test]
fn gravity_settles_a_column_by_half_its_weight() {
    // u(H) = rho g H^2/(2 M); second-order elements represent the parabola, and nodes of first-order ones lie on it.
    let exact = -2500.0 * 9.81 * 4.0 / (2.0 * MODULUS);
    for element in ["quad4", "quad9"] {
        let (_, record) = simulate(&column(element, "gravity = [0, -9.81]", ""));
        for u in top(&record) {
            assert!((u / exact - 1.0).abs() < 1e-11, "{element}: {u} {exact}");
        }
    }
}

#[test]
fn an_initial_stress_in_balance_with_its_traction_moves_nothing() {
    let text = column(
        "quad4",
        r#"initial_stress = ["-1 MPa", "-3 MPa", 0]"#,
        r#"{ set = "C.top", pressure = "3 MPa" },"#,
    );
    let (_, record) = simulate(&text);
    assert!(top(&record).iter().all(|u| u.abs() < 1e-16));
    let stress = &record.stage_ends()[0].bodies.as_ref().unwrap().cell_stress;
    assert!(stress.iter().all(|s| (s[1] + 3e6).abs() < 1e-3 && (s[0] + 1e6).abs() < 1e-3));
}

#[test]
fn a_released_column_springs_back_and_a_held_one_stays() {
    let stage = |last: &str| {
        let column = column("quad4", "", r#"{ set = "C.top", y = { to = "-1 mm" } },"#);
        let conditions = format!("[{{ set = \"C.top\", y = {last} }}]");
        let after = format!("{{ name = \"after\", duration = 1, steps = 1, conditions = {conditions} }}");
        varied(&column, &[Push("stages", &after)])
    };
    let (_, held) = simulate(&stage("\"hold\""));
    assert!(top(&held).iter().all(|u| (u + 1e-3).abs() < 1e-17));
    let (_, free) = simulate(&stage("\"free\""));
    assert!(top(&free).iter().all(|u| u.abs() < 1e-15));
}

#[test]
fn a_plan_models_only_what_its_scene_declares() {
    let text = SANDWICH;
    let plan_of = |text: &str| plan::plan(&scene::read(text).unwrap()).unwrap();
    let bytes = |plan: &AnyPlan| plan.summary().state_bytes.unwrap();
    let AnyPlan::Two(velocity) = plan_of(text) else { panic!("the sandwich is plane") };
    assert!(velocity.problem.interfaces[0].law.is_some());
    assert_eq!(bytes(&AnyPlan::Two(velocity)), 0);
    let law = r#"{ kind = "rate-and-state", evolution = "slip", mu0 = 0.6, a = 0.01, b = 0.005, l = "5 um", v_ref = "1e-3 mm/s", v_initial = "1e-3 mm/s" }"#;
    let state = varied(text, &[With("interfaces.fault.law", law)]);
    // One state variable, committed and trial, at each of 41 points.
    assert_eq!(bytes(&plan_of(&state)), 2 * 8 * 41);
    let frictionless = varied(
        text,
        &[
            Without("interfaces.fault.law"),
            Without("interfaces.fault.enforcement.tangential"),
            Without("stages[0].frictionless"),
        ],
    );
    let AnyPlan::Two(plan) = plan_of(&frictionless) else { panic!("the sandwich is plane") };
    assert!(plan.problem.interfaces[0].law.is_none());
    assert_eq!(plan.problem.interfaces[0].tangential_penalty, 0.0);
}
