//! Heat of friction on faults: unknowns, files, and what a run says of it.
#![allow(clippy::disallowed_methods)]

use crate::common::varied;
use crate::resume::{folder, run, text};
use asperity_cycles::Layout;
use asperity_plan::faults::Plan;
use asperity_plan::reading::scene;
use asperity_plan::{ScenePlan, plan_scene};
use asperity_vary::Change::{Add, With, Without};
use std::fs;

const SCENE: &str = include_str!("../../../../scenes/thermal-pressurisation.toml");
/// A law whose friction does not depend on temperature.
const COLD: &str = r#"{ kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.010, b = 0.015, l = "10 mm", v_ref = "1 um/s", v_initial = "1e-8 m/s" }"#;

fn plan(text: &str) -> Plan {
    match plan_scene(&scene::read(text).unwrap()).unwrap() {
        ScenePlan::Faults(plan) => *plan,
        ScenePlan::Bodies(_) | ScenePlan::Dynamic(_) => panic!("the scene has faults"),
    }
}

#[test]
fn a_fault_without_heat_has_no_unknowns_of_heat() {
    let with = plan(SCENE);
    let without = plan(&varied(SCENE, &[Without("faults.main.heat")]));
    let unknowns = |plan: &Plan| Layout::from_fault(&plan.problem.fault).processes().len();
    assert_eq!((unknowns(&with), unknowns(&without)), (1, 0));
    assert_eq!(with.problem.start.len(), without.problem.start.len() + 1);
    assert!(without.problem.fault.processes.find::<asperity_cycles::heat::Heat>().is_none());
}

#[test]
fn temperature_that_changes_nothing_leaves_the_event_as_it_is() {
    // Steps differ, since heat counts in their error, and the peak is the largest rate at their ends. Small errors of steps make both converge.
    let fine = Add("time.log_rate_tolerance", "1e-9");
    let cold = &[With("faults.main.law", COLD), fine];
    let watched = [With("faults.main.law", COLD), Add("faults.main.heat.temperature", "400"), fine];
    let onset = |text: &str| {
        let plan = plan(text);
        let run = plan
            .problem
            .run(&plan.problem.settings, &mut |_: &asperity_cycles::Moment<'_>| asperity_ode::Control::Go);
        let run = run.unwrap();
        (run.events()[0].onset.seconds(), run.events()[0].peak)
    };
    let free = varied(&varied(SCENE, cold), &[Without("faults.main.heat")]);
    let heated = varied(&varied(SCENE, &watched), &[Without("faults.main.heat.pressurisation")]);
    let (a, b) = (onset(&free), onset(&heated));
    assert!((a.0 / b.0 - 1.0).abs() < 1e-6 && (a.1 / b.1 - 1.0).abs() < 2e-5, "{a:?} {b:?}");
}

#[test]
fn temperature_and_pressure_are_in_the_files_and_in_what_the_run_says() {
    let folder = folder(&varied(SCENE, &[With("faults.main.heat.melting", "900")]));
    let output = run(folder.path(), "out", &[]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let out = folder.path().join("out");
    let read = |name: &str| fs::read_to_string(out.join(name)).unwrap();
    let station = read("stations/main_dp020");
    assert!(station.contains("normal_stress temperature pore_pressure\n"), "{station}");
    let column = |k: usize| {
        let rows = station.lines().filter(|l| !l.starts_with('#') && !l.starts_with('t'));
        rows.map(move |l| l.split_whitespace().nth(k).unwrap().parse::<f64>().unwrap()).fold(0.0, f64::max)
    };
    assert!(column(6) > 900.0 && column(7) > 40.0, "{} {}", column(6), column(7));
    assert!(read("temperature_profiles.csv").lines().count() > 3);
    assert!(read("pressure_profiles.csv").lines().count() > 3);
    assert!(read("events.csv").lines().next().unwrap().ends_with("largest_temperature [K]"));
    let said = text(&output.stdout) + &text(&output.stderr);
    assert!(said.contains("heat of fault `main`: up to 9"), "{said}");
    assert!(read("report.json").contains("exceeded `melting`, 900.0 K, at 1 of 1 points"));
}
