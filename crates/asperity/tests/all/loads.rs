//! Loads and stages end to end, against closed forms.
#![allow(clippy::disallowed_methods)]

use crate::common::{SANDWICH, varied};
use asperity::kinds;
use asperity::kinds::bodies::RunReport;
use asperity_output::bodies::Recorder;
use asperity_plan::bodies::{self, AnyPlan};
use asperity_plan::reading::scene;
use asperity_plan::sliders::planner;
use asperity_run::report::Outcome;
use asperity_vary::Change::{self, Add, Push, With, Without};

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
    let plan = bodies::plan(&scene).unwrap();
    let mut record = Recorder::new().with_bodies();
    let report = kinds::bodies::run(&plan, &mut record).unwrap();
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
    let plan_of = |text: &str| bodies::plan(&scene::read(text).unwrap()).unwrap();
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

/// A block of 8 t that a pressure of 4 ms throws, in a stage of 10 s: 1 MPa on 1 m² at the peak, 2 kN s in all.
const BLOW: &str = r#"
schema = 1
title = "a blow on a free block"
kinematics = "plane-strain"
[materials.steel]
young = "200 GPa"
poisson = 0.0
density = 8000
[bodies.b]
material = "steel"
mesh.block = { min = [0, 0], max = ["1 m", "1 m"], divisions = [1, 1], element = "quad4" }
[[stages]]
name = "blow"
duration = "10 s"
conditions = [
    { set = "b.bottom", y = 0 },
    { set = "b.left", pressure = { table = [[0, 0], [1.23, 0], [1.232, 1e6], [1.234, 0], [10, 0]] } },
]
[time]
stepper = "implicit"
inertia = true
[output]
points.p = { body = "b", at = ["0.5 m", "0.5 m"] }
"#;

/// Displacement along x of the only point at the end.
fn thrown(record: &Recorder) -> f64 {
    record.samples().last().unwrap().points[0].displacement[0]
}

#[test]
fn the_impulse_of_a_short_blow_throws_a_free_block() {
    let (report, record) = simulate(BLOW);
    let exact = 2e3 / 8e3 * (10.0 - 1.232);
    assert!((thrown(&record) / exact - 1.0).abs() < 1e-3, "{} {exact}", thrown(&record));
    assert!(report.counts.steps < 400, "{}", report.counts.steps);
}

#[test]
fn equal_steps_say_by_how_much_they_pass_over_a_blow() {
    let warned = |steps: &str| {
        let scene = scene::read(&varied(BLOW, &[Add("stages[0].steps", steps)])).unwrap();
        bodies::plan(&scene).unwrap().summary().warnings.iter().map(|w| w.message.clone()).collect::<Vec<_>>()
    };
    let found = warned("100");
    assert_eq!(found.len(), 1, "{found:?}");
    for part in ["100 equal steps", "pressure of `b.left`", "1.232 s", "1.000e6 Pa, 100.00 %"] {
        assert!(found[0].contains(part), "{part}: {}", found[0]);
    }
    assert_eq!(warned("10000"), Vec::<String>::new());
}

/// A block is pressed on a plane and drawn, in the first stage without friction.
const STROKE: &str = r#"
schema = 1
title = "a short stroke of a block under friction"
kinematics = "plane-strain"
[materials.rock]
young = "50 GPa"
poisson = 0.25
[bodies.plane]
material = "rock"
mesh.block = { min = [0, "-20 mm"], max = ["100 mm", 0], size = "10 mm", element = "quad4" }
[bodies.block]
material = "rock"
mesh.block = { min = ["30 mm", 0], max = ["70 mm", "20 mm"], divisions = [5, 2], element = "quad4" }
[interfaces.base]
slave = "block.bottom"
master = "plane.top"
measure = "mortar"
sliding = "small"
enforcement = { kind = "penalty", normal = "100 E/h", tangential = "100 E/h" }
law = { kind = "coulomb", mu = 0.6 }
[[stages]]
name = "press"
duration = "1 s"
frictionless = ["base"]
conditions = [{ set = "plane.bottom", x = 0, y = 0 }, { set = "block.top", x = 0, y = { to = "-5 um" } }]
[[stages]]
name = "stroke"
duration = "100 s"
conditions = [{ set = "block.top", x = { table = [[0, 0], [51.0, 0], [51.2, 5e-5], [51.4, 0], [100, 0]] }, y = "hold" }]
[time]
stepper = "implicit"
[output]
forces.top = { set = "block.top" }
"#;

/// Shear over normal force on the drawn side at the end.
fn friction(record: &Recorder) -> f64 {
    let force = record.samples().last().unwrap().forces[0];
    force[0] / force[1]
}

#[test]
fn a_stroke_to_and_fro_leaves_the_friction_of_the_way_back() {
    // The way back is longer than what friction holds, so that all points have slipped against the first motion.
    let table = [[0.0, 0.0], [51.0, 0.0], [51.2, 5e-5], [51.4, 0.0], [100.0, 0.0]];
    let rates = r#"{ rate = { table = [[0, 0], [51, 0], [51, "0.25 mm/s"], [51.2, "0.25 mm/s"], [51.2, "-0.25 mm/s"], [51.4, "-0.25 mm/s"], [51.4, 0]] } }"#;
    let rows: Vec<String> = (0..=1000)
        .map(|k| {
            let t = 0.1 * f64::from(k);
            let after = table.partition_point(|p| p[0] <= t).min(table.len() - 1);
            let ([t0, u0], [t1, u1]) = (table[after - 1], table[after]);
            format!("[{t}, {}]", u0 + (u1 - u0) * (t - t0) / (t1 - t0))
        })
        .collect();
    let measured = format!("{{ table = [{}] }}", rows.join(", "));
    let motion = "stages[1].conditions[0].x";
    for (name, changes) in [
        ("corners", vec![]),
        ("measured", vec![With(motion, &measured)]),
        ("rates", vec![With(motion, rates)]),
        ("full", vec![Add("time.path", "full")]),
        ("static-explicit", vec![With("time.stepper", "static-explicit")]),
    ] {
        let (report, record) = simulate(&varied(STROKE, &changes));
        assert!((friction(&record).abs() - 0.6).abs() < 1e-3, "{name}: {}", friction(&record));
        assert!(report.counts.steps < 400, "{name}: {}", report.counts.steps);
    }
}

#[test]
fn a_load_point_drawn_at_rates_by_a_table_moves_by_their_integral() {
    let rate = r#"{ spring = 1e9, rate = { table = [[0, 0], [10, "1 um/s"], [10, "-0.5 um/s"], [30, "-0.5 um/s"]] } }"#;
    let (report, record) = simulate(&varied(STROKE, &[With("stages[1].conditions[0].x", rate)]));
    let springs: Vec<f64> =
        record.samples().iter().flat_map(|s| &s.springs).flatten().map(|s| s.load_point).collect();
    let exact = 0.5 * 10e-6 - 0.5e-6 * 90.0;
    assert!((springs.last().unwrap() / exact - 1.0).abs() < 1e-12, "{springs:?}");
    let most = springs.iter().copied().fold(0.0, f64::max);
    assert!((most / 5e-6 - 1.0).abs() < 1e-12, "{most}");
    assert!(report.counts.steps < 400);
}

#[test]
fn tables_carry_on_from_where_the_stage_before_has_ended() {
    let refused = |changes: &[Change<'_>]| scene::read(&varied(STROKE, changes)).err().map(|e| e.to_string());
    let motion = "stages[1].conditions[0].x";
    for jump in [
        r#"{ table = [["0 s", "3 um"], ["10 s", "10 um"]] }"#,
        r#"{ table = [["5 s", "3 um"], ["10 s", "10 um"]] }"#,
    ] {
        let told = refused(&[With(motion, jump)]).unwrap();
        assert!(told.contains("begins") && told.contains("3 um") && told.contains("would jump"), "{told}");
    }
    assert_eq!(refused(&[With(motion, r#"{ table = [["5 s", 0], ["10 s", "10 um"]] }"#)]), None);
    let y = "stages[1].conditions[0].y";
    assert_eq!(refused(&[With(y, r#"{ table = [["0 s", "-5 um"], ["10 s", "-6 um"]] }"#)]), None);
    assert!(refused(&[With(y, r#"{ table = [["0 s", 0], ["10 s", "-6 um"]] }"#)]).is_some());
    let load = |first: &str| {
        let pressure =
            format!("{{ set = \"block.left\", pressure = {{ table = [[0, {first}], [10, 2e6]] }} }}");
        refused(&[Push("stages[1].conditions", &pressure)])
    };
    assert_eq!(load("0"), None);
    assert!(load("1e6").unwrap().contains("would jump"));
}

#[test]
fn bodies_with_mass_take_loads_that_jump_and_no_displacements() {
    let at = |path: &'static str, value: &'static str| scene::read(&varied(BLOW, &[With(path, value)]));
    assert!(at("stages[0].conditions[1].pressure", r#"{ table = [[0, 1e6], [0.1, 0]] }"#).is_ok());
    let told = at("stages[0].conditions[0].y", r#""1 mm""#).err().unwrap().to_string();
    assert!(told.contains("would depend on the step"), "{told}");
}

#[test]
fn courses_of_sliders_from_files_are_those_written_in_the_scene() {
    let folder = tempfile::tempdir().unwrap();
    let csv = "time [s],rate [um/s],normal [MPa]\n0,1,5\n10,1,5\n10,10,5\n40,10,4\n";
    std::fs::write(folder.path().join("machine.csv"), csv).unwrap();
    let base = crate::messages::base("sliders");
    let plan = |rate: &str, normal: &str| {
        let text = varied(&base, &[With("load.rate", rate), With("sliders.left.normal", normal)]);
        let (plan, files) = planner::read_in(&text, folder.path()).unwrap_or_else(|e| panic!("{e}"));
        (format!("{:?}", plan.problem), files.len())
    };
    let (written, none) = plan(
        r#"{ table = [[0, "1 um/s"], [10, "1 um/s"], [10, "10 um/s"], [40, "10 um/s"]] }"#,
        r#"{ table = [[0, "5 MPa"], [10, "5 MPa"], [10, "5 MPa"], [40, "4 MPa"]] }"#,
    );
    let (read, two) = plan(
        r#"{ table = { file = "machine.csv", column = "rate" } }"#,
        r#"{ table = { file = "machine.csv", column = "normal" } }"#,
    );
    assert!(written == read && (none, two) == (0, 2));
}

#[test]
fn a_record_of_a_hundred_thousand_rows_is_followed_by_its_corners() {
    // A slow wave with noise of 1e-5 of its range, and a blow of three rows.
    let noise = |k: u32| f64::from(k * 7919 % 101) / 101.0 - 0.5;
    let value = |k: u32| match k {
        50_000 => 5e5,
        _ => 1e5 * (f64::from(k) * 1e-4).sin() + 10.0 * noise(k),
    };
    let rows: Vec<String> =
        (1..=100_000).map(|k| format!("[{:?}, {:?}]", f64::from(k) * 1e-4, value(k))).collect();
    let table = format!("{{ table = [[0, 0], {}] }}", rows.join(", "));
    let scene = scene::read(&varied(BLOW, &[With("stages[0].conditions[1].pressure", &table)])).unwrap();
    let AnyPlan::Two(plan) = bodies::plan(&scene).unwrap() else { panic!("a plane scene") };
    let courses = plan.problem.stages[0].courses();
    let corners = courses[0].corners(plan.problem.control.course);
    let times: Vec<f64> = corners.iter().map(|&k| courses[0].times[k]).collect();
    assert!(times.len() < 300, "{}", times.len());
    for blow in [4.9999, 5.0, 5.0001] {
        assert!(times.iter().any(|t| (t - blow).abs() < 1e-12), "{blow}");
    }
}

#[test]
fn a_record_is_shared_out_to_its_stages() {
    let folder = tempfile::tempdir().unwrap();
    // The instrument reads 0.02 mm at the start; the first stage ends between two rows.
    let csv = "time [s],stroke [mm]\n0,0.02\n0.5,-0.48\n1.5,-1.48\n3,-0.58\n";
    std::fs::write(folder.path().join("test.csv"), csv).unwrap();
    let part = |more: &str| {
        format!(r#"{{ set = "C.top", y = {{ table = {{ file = "test.csv", column = "stroke"{more} }} }} }}"#)
    };
    let two = |first: &str, second: &str| {
        let after = format!("{{ name = \"after\", duration = 2, conditions = [{}] }}", part(second));
        let changes = [Without("stages[0].steps"), Push("stages", &after)];
        scene::read_in(&varied(&column("quad4", "", &part(first)), &changes), folder.path())
    };
    let scene = two(", from = 0, tare = true", ", from = 1, tare = true").unwrap();
    let plan = bodies::plan(&scene).unwrap();
    let mut record = Recorder::new().with_bodies();
    assert_eq!(kinds::bodies::run(&plan, &mut record).unwrap().outcome, Outcome::Completed);
    let at = |stage: usize| record.stage_ends()[stage].bodies.as_ref().unwrap().displacement.clone();
    for (stage, exact) in [(0, -1e-3), (1, -0.6e-3)] {
        let least = at(stage).iter().map(|u| u[1]).fold(0.0, f64::min);
        assert!((least - exact).abs() < 1e-15, "{stage}: {least}");
    }
    // Without `from` the second stage would begin at the start of the record, and without `tare` beside its set.
    for (first, second, told) in [
        (", from = 0", ", from = 1", "begins with 20 um, but `C.top` is at 0 m"),
        (
            ", from = 0, tare = true",
            ", from = 4, tare = true",
            "run from 0.0 s to 3.0 s: none lies in what begins at 4.0 s",
        ),
    ] {
        let error = two(first, second).err().unwrap().to_string();
        assert!(error.contains(told), "{error}");
    }
}

#[test]
fn a_bare_logarithm_after_a_stage_without_friction_is_warned_of() {
    let bare = "{ kind = \"rate-and-state\", evolution = \"ageing\", form = \"bare\", mu0 = 0.6, a = 0.01, b = 0.005, l = \"5 um\", v_ref = \"1e-3 mm/s\", v_initial = \"1e-3 mm/s\" }";
    let warned = |text: &str| {
        let warnings = scene::read(text).unwrap_or_else(|e| panic!("{e}")).warnings;
        warnings.iter().any(|w| w.message.contains("the bare logarithm has no value at rest"))
    };
    let with = varied(SANDWICH, &[With("interfaces.fault.law", bare)]);
    assert!(warned(&with) && !warned(SANDWICH));
    assert!(!warned(&varied(&with, &[Without("stages[0].frictionless")])));
}

#[test]
fn steps_end_at_profiles_and_fields_whose_number_is_given() {
    let text = varied(SANDWICH, &[With("output.profiles", "7"), With("output.fields", "3")]);
    let (_, record) = simulate(&text);
    // Intervals of the stages, which end at 9.66 s and 59.66 s.
    for (of, count) in [("profiles", 7), ("fields", 3)] {
        for (start, end) in [(0.0, 9.66), (9.66, 59.66)] {
            for k in 1..=count {
                let wanted = start + (end - start) * f64::from(k) / f64::from(count);
                assert!(record.times().iter().any(|t| (t - wanted).abs() < 1e-9), "{of}: {wanted}");
            }
        }
    }
}
