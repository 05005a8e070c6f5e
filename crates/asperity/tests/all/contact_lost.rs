//! Bodies that contact alone holds, and steps without solution where it has let one go.

use crate::common::{planned, varied};
use asperity::kinds;
use asperity_output::bodies::Recorder;
use asperity_run::report::Outcome;
use asperity_vary::Change::{Push, With, Without};

/// A block between two others, which the first stage may press or carry off.
const DOUBLE_SHEAR: &str = r#"
schema = 1
title = "double direct shear"
kinematics = "plane-strain"
[materials.granite]
young = "44.8 GPa"
poisson = 0.12
density = "2700 kg/m^3"
[bodies.left]
material = "granite"
mesh.block = { min = ["0 mm", "0 mm"], max = ["25 mm", "50 mm"], size = "5 mm", element = "quad4" }
[bodies.middle]
material = "granite"
mesh.block = { min = ["25 mm", "0 mm"], max = ["75 mm", "50 mm"], size = "5 mm", element = "quad4" }
[bodies.right]
material = "granite"
mesh.block = { min = ["75 mm", "0 mm"], max = ["100 mm", "50 mm"], size = "5 mm", element = "quad4" }
[interfaces.one]
slave = "left.right"
master = "middle.left"
measure = "node-to-point"
sliding = "small"
enforcement = { kind = "penalty", normal = "100 E/h", tangential = "100 E/h" }
law = { kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.005, b = 0.020, l = "4 um", v_ref = "1 um/s", v_initial = "1 um/s" }
damping = "radiation"
[interfaces.other]
slave = "right.left"
master = "middle.right"
measure = "node-to-point"
sliding = "small"
enforcement = { kind = "penalty", normal = "100 E/h", tangential = "100 E/h" }
law = { kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.005, b = 0.020, l = "4 um", v_ref = "1 um/s", v_initial = "1 um/s" }
damping = "radiation"
[[stages]]
name = "press"
duration = "10 s"
conditions = [
    { set = "left.left", x = { to = "0.066 mm" } },
    { set = "right.right", x = { to = "0.066 mm" } },
    { set = "left.bottom", y = 0 },
    { set = "right.bottom", y = 0 },
    { set = "middle.top", y = 0 },
]
[[stages]]
name = "hold"
duration = "100 s"
[[stages]]
name = "slide"
duration = "1000 s"
conditions = [{ set = "middle.top", y = { spring = 1e10, rate = "-1 um/s" } }]
[time]
stepper = "implicit"
friction_tolerance = 2e-5
[events]
above = "1 mm/s"
stop_after = 1
"#;

fn outcome(text: &str) -> Outcome {
    kinds::bodies::run(&planned(text), &mut Recorder::new()).unwrap().outcome
}

/// The left block leaves the middle one, which a load pulls away in a stage. There is no right one.
fn pulled_away(stage: &str) -> String {
    varied(
        DOUBLE_SHEAR,
        &[
            Without("bodies.right"),
            Without("interfaces.other"),
            Without("stages[0].conditions[3]"),
            Without("stages[0].conditions[1]"),
            With("stages[0].conditions[0].x.to", "\"-0.066 mm\""),
            Push(stage, r#"{ set = "middle.right", traction = ["1 kPa", 0] }"#),
        ],
    )
}

#[test]
fn a_step_without_solution_names_the_body_that_contact_has_let_go() {
    let Outcome::Stopped { reason, .. } = outcome(&pulled_away("stages[2].conditions")) else {
        panic!("it runs")
    };
    assert!(reason.contains("the likely cause: body `middle` is free in"), "{reason}");
    assert!(reason.contains("`one` presses nothing at 11 of 11 points"), "{reason}");
}

#[test]
fn interfaces_of_a_run_that_stops_early_are_not_said_to_be_pressed_by_nothing() {
    let text = pulled_away("stages[0].conditions");
    let report = kinds::bodies::run(&planned(&text), &mut Recorder::new()).unwrap();
    assert!(matches!(report.outcome, Outcome::Stopped { .. }), "{:?}", report.outcome);
    assert!(report.warnings.iter().all(|w| !w.message.contains("of every stage")), "{:?}", report.warnings);
}

#[test]
fn interfaces_that_nothing_presses_are_warned_of() {
    // The outer blocks move to one side. The left one takes the middle one along, and the right one leaves it.
    let report = kinds::bodies::run(&planned(DOUBLE_SHEAR), &mut Recorder::new()).unwrap();
    let found: Vec<&str> = report.warnings.iter().map(|w| w.message.as_str()).collect();
    for name in ["one", "other"] {
        let own = |m: &str| {
            m.starts_with(&format!("interface `{name}` ")) && m.contains("at the end of every stage")
        };
        assert!(found.iter().any(|m| own(m)), "{name}: {found:?}");
    }
}

#[test]
fn a_block_that_is_pressed_from_both_sides_is_held_by_contact() {
    let text = varied(DOUBLE_SHEAR, &[With("stages[0].conditions[1].x.to", "\"-0.066 mm\"")]);
    let outcome = outcome(&text);
    assert!(!format!("{outcome:?}").contains("the likely cause"), "{outcome:?}");
}
