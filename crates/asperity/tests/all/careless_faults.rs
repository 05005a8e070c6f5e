//! Scenes of faults that careless users wrote: each runs as it should, or says what is wrong.

use crate::sister_checks::MEDIUM;
use asperity::kinds::faults::Report;
use asperity_cycles::Balance;
use asperity_plan::faults::Plan;
use asperity_plan::reading::scene;
use asperity_plan::{ScenePlan, plan_scene};
use asperity_run::report::Outcome;
use asperity_vary::Change::{self, Add, With, WithOrSame, Without};
use asperity_vary::SceneText;

/// A fault of 2 km between weak and free rock, pressed by weight, that reaches the surface.
const WEIGHT: &str = r#"
schema = 1
title = "rock that presses a fault"
kinematics = "plane-strain"
[materials.rock]
young = "80 GPa"
poisson = 0.25
density = 2670
[bodies.crust]
material = "rock"
gravity = [0, -9.81]
mesh.fault = { trace = [[0, 0], ["2 km", "-3.4641016 km"]], spacing = "250 m", min = ["-20 km", "-20 km"], max = ["20 km", 0], growth = 1.5, element = "quad9" }
[faults.main]
minus = "crust.fault.minus"
plus = "crust.fault.plus"
law = { kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.015, b = 0.010, l = "10 mm", v_ref = "1 um/s", v_initial = "1e-12 m/s" }
normal_floor = "1 MPa"
rate = "-1e-12 m/s"
damping = "radiation"
[[stages]]
name = "creep"
duration = "10 d"
conditions = [{ set = "crust.left", x = 0 }, { set = "crust.right", x = 0 }, { set = "crust.bottom", y = 0 }]
[time]
stepper = "fault-ode"
"#;

/// A fault in rock of 24 km, with an event after some 170 years.
fn rock() -> SceneText {
    SceneText::new(MEDIUM).changed(&[
        With("materials.rock.young", "75 GPa"),
        With("faults.main.line.trace", r#"[[0, 0], [0, "-24 km"]]"#),
        With("faults.main.rate", "1e-9 m/s"),
    ])
}

fn planned(scene: SceneText, changes: &[Change<'_>]) -> Plan {
    let text = scene.changed(changes).text().unwrap();
    let read = scene::read(&text).unwrap_or_else(|e| panic!("{e}\n{text}"));
    match plan_scene(&read).unwrap_or_else(|e| panic!("{e}\n{text}")) {
        ScenePlan::Faults(plan) => *plan,
        ScenePlan::Bodies(_) | ScenePlan::Dynamic(_) => panic!("the scene has faults"),
    }
}

fn report(scene: SceneText, changes: &[Change<'_>]) -> Report {
    let plan = planned(scene, changes);
    let out = plan.problem.run(&plan.problem.settings, &mut ()).unwrap();
    Report::new(&plan, &out, &mut Balance::new(&plan.problem))
}

#[test]
fn an_event_that_has_not_ended_is_told() {
    let whole = report(rock(), &[]).text();
    assert!(!whole.contains("had not ended"), "{whole}");
    let onset = report(rock(), &[Add("events.stop_after", "1")]).events[0].onset;
    let cut = report(rock(), &[With("stages[0].duration", &format!("{:e}", onset + 60.0))]).text();
    assert!(cut.contains("an event that began at ") && cut.contains(" had not ended"), "{cut}");
}

#[test]
fn a_floor_at_a_free_surface_that_nothing_presses_is_what_friction_uses() {
    // Rounding decides whether the traction at the surface is above zero: with some of these spacings it was not.
    for spacing in ["200 m", "250 m", "300 m", "500 m"] {
        let found = report(SceneText::new(WEIGHT), &[WithOrSame("bodies.crust.mesh.fault.spacing", spacing)]);
        assert_eq!(found.outcome, Outcome::Completed, "{spacing}");
    }
}

#[test]
fn fluid_that_lifts_a_fault_at_once_ends_the_run() {
    let well =
        r#"{ at = "12 km", flux = "1e-4 m/s", diffusivity = 0.1, porosity = 0.1, compressibility = 1e-8 }"#;
    let changes = [
        Add("faults.main.injection", well),
        With("faults.main.line.trace", r#"[[0, "-2 km"], [0, "-26 km"]]"#),
        With("kinematics", "plane-strain"),
        Without("faults.main.creep"),
    ];
    let found = report(rock(), &changes);
    let reason = found.outcome.reason().unwrap_or_default();
    assert!(reason.contains("falls to zero"), "{reason}");
    assert!(found.counts.steps < 100_000, "{}", found.counts.steps);
}

#[test]
fn a_map_across_the_date_line_lies_around_its_origin() {
    for longitude in ["180 deg", "-179.99 deg", "179.99 deg", "180.01 deg"] {
        let place = format!(
            r#"{{ epoch = "2000-01-01T00:00:00Z", latitude = "35 deg", longitude = "{longitude}", strike = "30 deg" }}"#
        );
        let changes = [
            With("kinematics", "3d"),
            Without("faults.main.line"),
            Without("faults.main.profiles"),
            Add(
                "faults.main.rectangle",
                r#"{ from = [0, "-1 km", "10 km"], to = [0, "-1 km", "-10 km"], dip = "30 deg", width = "10 km", size = "2 km" }"#,
            ),
            Add("faults.main.rake", "[0, 1, 0.5]"),
            With("faults.main.law.l", "80 mm"),
            With("faults.main.law.b", "0.02"),
            Add("faults.main.normal_floor", "1 MPa"),
            Add("output", r#"{ surface = { spacing = "4 km" } }"#),
            Add("place", &place),
        ];
        let plan = planned(rock(), &changes);
        let positions = plan.free_surface.unwrap().positions;
        assert!(positions.len() > 50, "{longitude}: {}", positions.len());
        assert!(positions.iter().flatten().all(|x| x.abs() < 60e3), "{longitude}");
    }
}
