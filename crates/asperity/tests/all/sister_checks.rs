//! A doubt that one kind of run has, its sisters have: every cell of the table in `docs/src/checks.md` that says so is tried by a scene.

use crate::common::{SANDWICH, cycles};
use crate::dynamic;
use asperity_plan::ScenePlan;
use asperity_plan::reading::scene;
use asperity_plan::reading::scene::reader::is_slider;
use asperity_plan::sliders::planner;
use asperity_vary::Change::{self, Add, With, WithOrSame};
use asperity_vary::SceneText;
use std::collections::BTreeSet;

const PAGE: &str = include_str!("../../../../docs/src/checks.md");

/// A fault in homogeneous rock.
pub const MEDIUM: &str = r#"
schema = 1
title = "a fault in rock"
kinematics = "antiplane"
[materials.rock]
young = "80 GPa"
poisson = 0.25
density = 2670
[medium]
kind = "half-space"
material = "rock"
[faults.main]
line = { trace = [["0 km", "0 km"], ["0 km", "-40 km"]], spacing = "500 m" }
law = { kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.010, b = 0.015, l = "40 mm", v_ref = "1 um/s", v_initial = "1e-9 m/s" }
profiles.a = { along = "distance", points = [["15 km", 0.010], ["18 km", 0.025]] }
normal = "50 MPa"
rate = "5e-10 m/s"
damping = "radiation"
creep = { rate = "1e-9 m/s" }
[[stages]]
name = "cycles"
duration = "300 yr"
[time]
stepper = "fault-ode"
[events]
above = "1e-3 m/s"
"#;

pub const SLIDER: &str = r#"
schema = 1
title = "a slider"
kinematics = "spring-slider"
[load]
rate = "1 um/s"
[sliders.block]
normal = "5 MPa"
stiffness = "5 GPa/m"
damping = "5 MPa s/m"
law = { kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.010, b = 0.015, l = "10 um", v_ref = "1 um/s", v_initial = "1 um/s" }
[time]
end = "300 s"
[events]
above = "1 mm/s"
"#;

/// Kinds of runs, in the order of the columns.
const KINDS: [&str; 5] =
    ["bodies in contact", "faults in rock", "faults between bodies", "bodies with mass", "spring-sliders"];

fn scene_of_kind(kind: &str) -> SceneText {
    let aged = r#"{ kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.01, b = 0.02, l = "10 um", v_ref = "1 um/s", v_initial = "1 um/s" }"#;
    match kind {
        "bodies in contact" => SceneText::new(SANDWICH).changed(&[
            With("bodies.A.mesh.block.size", "5 mm"),
            With("bodies.B.mesh.block.size", "5 mm"),
            With("interfaces.fault.law", aged),
            Add("interfaces.fault.under_resolved", "allow"),
            Add("materials.granite.density", "2700"),
            Add("interfaces.fault.damping", "radiation"),
        ]),
        "faults in rock" => SceneText::new(MEDIUM),
        "faults between bodies" => SceneText::new(cycles::SCENE),
        "bodies with mass" => SceneText::new(dynamic::SCENE),
        _ => SceneText::new(SLIDER),
    }
}

/// Errors and warnings of a scene.
fn said(text: &str) -> Vec<String> {
    if is_slider(text) {
        return match planner::read(text) {
            Ok(plan) => plan.warnings.iter().map(ToString::to_string).collect(),
            Err(errors) => errors.0.iter().map(ToString::to_string).collect(),
        };
    }
    let scene = match scene::read(text) {
        Ok(scene) => scene,
        Err(errors) => return errors.0.iter().map(ToString::to_string).collect(),
    };
    let warnings = match asperity_plan::plan_scene(&scene) {
        Ok(ScenePlan::Bodies(plan)) => plan.summary().warnings.clone(),
        Ok(ScenePlan::Faults(plan)) => plan.warnings.clone(),
        Ok(ScenePlan::Dynamic(plan)) => plan.warnings().to_vec(),
        Err(error) => return vec![error.to_string()],
    };
    warnings.iter().map(ToString::to_string).collect()
}

/// A doubt, a kind of run that has it, the change of its scene that gives rise to it, and a part of what is said.
type Trial = (&'static str, &'static str, Change<'static>, &'static str);

const BODIES: &str = KINDS[0];
const ROCK: &str = KINDS[1];
const BETWEEN: &str = KINDS[2];
const MASS: &str = KINDS[3];
const SLIDERS: &str = KINDS[4];

/// A patch of 800 m, a cell or two.
const SMALL_PATCH: &str = r#"[{ box = { y = { from = "-10.4 km", to = "-9.6 km" } }, normal = "60 MPa" }]"#;

const TRIALS: &[Trial] = &[
    ("implausible values", BODIES, With("interfaces.fault.law.mu0", "60"), "mu0` is 60"),
    ("implausible values", ROCK, With("faults.main.normal", "50"), "normal` is 50 Pa"),
    ("implausible values", BETWEEN, With("faults.main.normal", "50"), "normal` is 50 Pa"),
    ("implausible values", MASS, With("faults.main.pulses[0].traction", "25"), "traction` is 25 Pa"),
    ("implausible values", SLIDERS, With("sliders.block.normal", "5"), "normal` is 5 Pa"),
    (
        "rates beyond waves",
        BODIES,
        With("stages[1].conditions[1].y.rate", "4 km/s"),
        "the speed of shear waves",
    ),
    ("rates beyond waves", ROCK, With("faults.main.rate", "5e10"), "the speed of shear waves"),
    ("rates beyond waves", BETWEEN, With("faults.main.creep.rate", "4 km/s"), "the speed of shear waves"),
    (
        "rates beyond waves",
        BODIES,
        With("stages[1].conditions[1].y", r#"{ to = "-1000 km" }"#),
        "sides reach the speed of shear waves",
    ),
    ("rates beyond waves", MASS, Add("output.rupture_rate", "1e9"), "the speed of shear waves"),
    (
        "rates beyond waves",
        MASS,
        With(
            "stages[0].conditions",
            r#"[{ set = "A.left", absorbing = true }, { set = "A.right", x = { to = "20 km" } }]"#,
        ),
        "sides reach the speed of shear waves",
    ),
    ("rates beyond waves", SLIDERS, With("load.rate", "1e9"), "the speed of shear waves"),
    (
        "damping far from radiation",
        BODIES,
        With("interfaces.fault.damping", "0.1 MPa s/m"),
        "its rock radiates",
    ),
    ("damping far from radiation", ROCK, With("faults.main.damping", "0.1 MPa s/m"), "its rock radiates"),
    ("damping far from radiation", BETWEEN, With("faults.main.damping", "0.1 MPa s/m"), "its rock radiates"),
    ("damping far from radiation", SLIDERS, With("sliders.block.damping", "5"), "dampings are"),
    ("events that do not end", BODIES, Add("events", "{ above = 1e-7 }"), "an event does not end"),
    ("events that do not end", ROCK, With("events.above", "1e-9 m/s"), "an event does not end"),
    ("events that do not end", BETWEEN, With("events.above", "1e-9 m/s"), "an event does not end"),
    ("events that do not end", SLIDERS, With("events.above", "1 um/s"), "an event does not end"),
    ("nucleation beyond the surface", ROCK, With("faults.main.law.l", "900 m"), "no event begins"),
    ("nucleation beyond the surface", BETWEEN, With("faults.main.law.l", "900 m"), "no event begins"),
    ("nucleation beyond the surface", MASS, With("faults.main.law.d_c", "900 m"), "no event begins"),
    (
        "idle pulses",
        ROCK,
        Add(
            "faults.main.pulses",
            r#"[{ traction = "2 kPa", centre = [0, "-10 km"], radius = "3 km", duration = "1 s" }]"#,
        ),
        "hardly changes slip rates",
    ),
    (
        "idle pulses",
        BETWEEN,
        Add(
            "faults.main.pulses",
            r#"[{ traction = "2 kPa", centre = [0, "-10 km"], radius = "3 km", duration = "1 s" }]"#,
        ),
        "hardly changes slip rates",
    ),
    (
        "idle pulses",
        MASS,
        WithOrSame("faults.main.patches[0].shear", "70 MPa"),
        "brings no point to its strength",
    ),
    (
        "start against the loads",
        ROCK,
        With("faults.main.rate", "-5e-10 m/s"),
        "drive fault `main` against `rate`",
    ),
    ("start against the loads", BETWEEN, With("faults.main.rate", "-1e-9 m/s"), "creeps against its `rate`"),
    ("start against the loads", SLIDERS, With("load.rate", "-1 um/s"), "against its load point"),
    ("unstable equilibrium at the start", ROCK, With("faults.main.rate", "1e-9 m/s"), "rounding decides"),
    (
        "unstable equilibrium at the start",
        SLIDERS,
        With("sliders.block.stiffness", "1.25 GPa/m"),
        "rounding decides",
    ),
    (
        "friction far beyond its law at the start",
        ROCK,
        Add("faults.main.shear", "500 MPa"),
        "makes friction of",
    ),
    (
        "friction far beyond its law at the start",
        BETWEEN,
        Add("faults.main.shear", "500 MPa"),
        "makes friction of",
    ),
    (
        "friction far beyond its law at the start",
        MASS,
        With("faults.main.shear", "130 MPa"),
        "no friction holds it",
    ),
    ("patches on hardly any point", ROCK, Add("faults.main.patches", SMALL_PATCH), "too few for its shape"),
    (
        "patches on hardly any point",
        BETWEEN,
        Add("faults.main.patches", SMALL_PATCH),
        "too few for its shape",
    ),
    (
        "patches on hardly any point",
        MASS,
        With("faults.main.patches[0].box.y.from", "950 m"),
        "too few for its shape",
    ),
    ("sides that return waves", MASS, With("stages[0].conditions", "[]"), "come back from the sides after"),
    (
        "fluid beyond the ends",
        ROCK,
        Add(
            "faults.main.injection",
            r#"{ at = "20 km", flux = "1e-7 m/s", diffusivity = 10.0, porosity = 0.1, compressibility = 1e-8 }"#,
        ),
        "run beyond both ends",
    ),
    (
        "fluid beyond the ends",
        BETWEEN,
        Add(
            "faults.main.injection",
            r#"{ at = "10 km", flux = "1e-7 m/s", diffusivity = 10.0, porosity = 0.1, compressibility = 1e-8 }"#,
        ),
        "run beyond both ends",
    ),
];

/// Rows of the table of doubts: the doubt and its cells.
fn table() -> Vec<(String, Vec<String>)> {
    let from = PAGE.split("| doubt |").nth(1).expect("the page has the table of doubts");
    let rows = from.lines().skip(2).take_while(|line| line.starts_with('|'));
    let cells =
        |line: &str| line.trim_matches('|').split('|').map(|c| c.trim().to_string()).collect::<Vec<_>>();
    rows.map(cells).map(|mut row| (row.remove(0), row)).collect()
}

#[test]
fn every_kind_of_run_has_the_doubts_that_the_page_says_and_no_cell_is_empty() {
    let mut claimed = BTreeSet::new();
    for (doubt, cells) in table() {
        assert_eq!(cells.len(), KINDS.len(), "{doubt}");
        for (kind, cell) in KINDS.iter().zip(cells) {
            assert!(!cell.is_empty() && cell != "-", "{doubt}, {kind}: a reason why it has none");
            if cell == "yes" {
                claimed.insert((doubt.clone(), (*kind).to_string()));
            }
        }
    }
    let tried: BTreeSet<_> = TRIALS.iter().map(|t| (t.0.to_string(), t.1.to_string())).collect();
    assert_eq!(claimed, tried);
}

#[test]
fn every_doubt_is_raised_in_each_of_its_kinds_and_not_without_its_cause() {
    let mut wrong = Vec::new();
    for (doubt, kind, change, part) in TRIALS {
        let base = scene_of_kind(kind).text().unwrap();
        let changed = scene_of_kind(kind).changed(&[*change]).text().unwrap();
        let (before, after) = (said(&base), said(&changed));
        if before.iter().any(|s| s.contains(part)) || !after.iter().any(|s| s.contains(part)) {
            wrong.push(format!("{doubt}, {kind}:\n  before {before:#?}\n  after {after:#?}"));
        }
    }
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), TRIALS.len(), wrong.join("\n"));
}

#[test]
fn ruptures_with_mass_are_warned_of_sides_that_return_waves_too_soon() {
    let changes = [
        With("time.stepper", "auto"),
        With("bodies.crust.mesh.fault.min", r#"["-20 km", "-80 km"]"#),
        With("bodies.crust.mesh.fault.max", r#"["20 km", "0 km"]"#),
    ];
    // Loads of an absorbing side move it between ruptures alone.
    let absorbs = With(
        "stages[0].conditions",
        r#"[{ set = "crust.left", z = { rate = "-0.5e-9 m/s" } }, { set = "crust.right", z = { rate = "0.5e-9 m/s" } }, { set = "crust.bottom", absorbing = true }]"#,
    );
    let told = |changes: &[Change<'_>]| {
        let said = said(&scene_of_kind(BETWEEN).changed(changes).text().unwrap());
        said.into_iter().filter(|s| s.contains("come back from the sides after 11.5")).count()
    };
    assert_eq!(told(&changes), 1);
    // The sides 80 km away, and the cycles without mass.
    assert_eq!(told(&changes[..1]) + told(&changes[1..]), 0);
    assert_eq!(told(&[changes.as_slice(), &[absorbs]].concat()), 0);
}

/// Scenes whose slip outruns shear waves, by their kind of run, and what is said of where and of a remedy.
fn runaways() -> Vec<(&'static str, String, [&'static str; 2])> {
    let of = |kind, changes: &[Change<'_>]| scene_of_kind(kind).changed(changes).text().unwrap();
    // A drop of stress of more than half the shear modulus.
    let torn = [
        With("faults.main.normal", "60 GPa"),
        With("faults.main.shear", "35 GPa"),
        With("faults.main.patches[0].shear", "41 GPa"),
        With("faults.main.law.mu_k", "0.01"),
        Add("faults.main.under_resolved", "allow"),
    ];
    // The loading sides would move at 10 km/s.
    let dashed = [
        With("stages[1].duration", "1 us"),
        With("stages[1].conditions[1].y", r#"{ table = [[0, 0], ["1 us", "-10 mm"]] }"#),
    ];
    let slack = [
        With("sliders.block.stiffness", "1.25 GPa/m"),
        With("sliders.block.damping", "5"),
        With("time.end", "4000 s"),
    ];
    vec![
        (ROCK, of(ROCK, &[Change::Without("faults.main.damping")]), ["fault `main` at point", "damping"]),
        (ROCK, of(ROCK, &[With("faults.main.damping", "5")]), ["fault `main` at point", "damping"]),
        (
            BETWEEN,
            of(BETWEEN, &[Change::Without("faults.main.damping")]),
            ["fault `main` at point", "damping"],
        ),
        (MASS, of(MASS, &torn), ["fault `main` at point", "damping"]),
        (SLIDERS, of(SLIDERS, &slack), ["slip of `block`", "damping"]),
        (BODIES, of(BODIES, &dashed), ["fault: node", "inertia"]),
    ]
}

#[test]
fn every_kind_of_run_stops_before_slip_outruns_shear_waves() {
    for (kind, scene, [place, remedy]) in runaways() {
        let folder = crate::resume::folder(&scene);
        let ended = crate::resume::run(folder.path(), "out", &[]);
        let (code, told) = (ended.status.code(), crate::common::told(&ended));
        assert_eq!(code, Some(2), "{kind}: {told}");
        let said = ["outruns shear waves", place, remedy];
        assert!(said.iter().all(|part| told.contains(part)), "{kind}: {told}");
    }
}
