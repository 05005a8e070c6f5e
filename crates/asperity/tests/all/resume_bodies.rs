//! Runs of bodies that are interrupted between trials of steps and resumed: their results are those of an uninterrupted
//! run, bit for bit.
#![allow(clippy::disallowed_methods)]

use crate::common::{planned, told};
use crate::resume::{assert_same, files, folder, run, text};
use asperity::checkpoint::{self, Pauses};
use asperity::keep::{Keeper, Place};
use asperity::kinds::bodies::{Bodies, Outputs, ResumeState, RunError, RunReport, run_kept};
use asperity_ode::Control;
use asperity_output::bodies::view::{Setup, StepView};
use asperity_output::bodies::{FieldSchedule, Recorder};
use asperity_plan::bodies::AnyPlan;
use asperity_run::report::Outcome;
use asperity_run::{Interrupt, ObserveError, Observer};
use asperity_vary::Change::{self, Add, With, WithOrSame, Without};
use asperity_vary::SceneText;
use serde_json::Value;
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// A die is pressed into a slab without friction, and then moved along it by more than a cell.
const SCENE: &str = r#"
schema = 1
title = "die on a slab"
kinematics = "plane-strain"

[materials.soft]
young = "10 GPa"
poisson = 0.25

[materials.hard]
young = "20 GPa"
poisson = 0.25

[bodies.slab]
material = "soft"
mesh.block = { min = [0, "-0.5 m"], max = ["2 m", 0], divisions = [8, 2], element = "quad4" }

[bodies.die]
material = "hard"
mesh.block = { min = ["0.5 m", 0], max = ["1.3 m", "0.4 m"], divisions = [3, 1], element = "quad4" }

[interfaces.contact]
slave = "die.bottom"
master = "slab.top"
measure = "node-to-point"
sliding = "finite"
enforcement = { kind = "penalty", normal = "20 E/h", tangential = "20 E/h" }
law = { kind = "coulomb", mu = 0.4 }

[[stages]]
name = "press"
duration = "1 s"
frictionless = ["contact"]
conditions = [
    { set = "slab.bottom", x = 0, y = 0 },
    { set = "die.top", x = 0, y = { to = "-1 mm" } },
]

[[stages]]
name = "draw"
duration = "1 s"
conditions = [{ set = "die.top", x = { to = "0.3 m" } }]

[time]
stepper = "implicit"
max_step = "0.2 s"
tolerance = "1 mm"
friction_tolerance = 5e-3

[output]
probes.contact = 3
points.inside = { body = "slab", at = ["0.9 m", "-0.2 m"] }
forces.die = { set = "die.top" }
"#;

const SMALL: [Change<'_>; 2] =
    [With("interfaces.contact.sliding", "small"), With("stages[1].conditions[0].x", r#"{ to = "0.002 m" }"#)];
const MORTAR: Change<'_> = With("interfaces.contact.measure", "mortar");
const UZAWA: Change<'_> = With(
    "interfaces.contact.enforcement",
    r#"{ kind = "uzawa", normal = "20 E/h", tangential = "20 E/h", penetration = "1e-9 h" }"#,
);
const UNKNOWNS: Change<'_> = With(
    "interfaces.contact.enforcement",
    r#"{ kind = "augmented-lagrangian", normal = "1 E/h", tangential = "1 E/h" }"#,
);
const FORWARD: [Change<'_>; 3] =
    [With("time.stepper", "static-explicit"), Without("time.tolerance"), Without("time.friction_tolerance")];
const PLASTIC: Change<'_> =
    Add("materials.soft.plasticity", r#"{ hardening = "linear", yield = "20 MPa", modulus = "1 GPa" }"#);
const MAXWELL: Change<'_> = Add("materials.soft.viscosity", "20 GPa s");
const STRAIN: [Change<'_>; 2] = [Add("bodies.slab.strain", "finite"), Add("bodies.die.strain", "finite")];
const ROUND: Change<'_> = Add(
    "bodies.die.mesh.block.curves",
    r#"{ bottom = { kind = "circle", radius = "40 m", apex = { x = 0.9 } } }"#,
);
const TIED: Change<'_> = With("interfaces.contact.law", r#"{ kind = "tied" }"#);
/// Gaps at the start, in which points are tied.
const SLANTED: Change<'_> = With(
    "bodies.die.mesh.block",
    r#"{ min = ["0.5 m", "1 mm"], max = ["1.3 m", "0.4 m"], divisions = [3, 1], element = "quad4" }"#,
);
/// Its nodes do not lie on those of the slab.
const BESIDE: Change<'_> = With(
    "bodies.die.mesh.block",
    r#"{ min = ["0.6 m", 0], max = ["1.4 m", "0.4 m"], divisions = [3, 1], element = "quad4" }"#,
);
/// Distance at which a part of the die leaves the slab.
const OFF: Change<'_> = With("stages[1].conditions[0].x", r#"{ to = "0.76 m" }"#);
/// Friction from the first contact on.
const ROUGH: Change<'_> = Without("stages[0].frictionless");
const AGEING: Change<'_> = With(
    "interfaces.contact.law",
    r#"{ kind = "rate-and-state", evolution = "ageing", mu0 = 0.4, a = 0.015, b = 0.01, l = "5 mm", v_ref = "1 mm/s", v_initial = "1 mm/s" }"#,
);
const SLIP: Change<'_> = With(
    "interfaces.contact.law",
    r#"{ kind = "rate-and-state", evolution = "slip", mu0 = 0.4, a = 0.015, b = 0.01, l = "5 mm", v_ref = "1 mm/s", v_initial = "1 mm/s" }"#,
);
/// Stick-slip: the die is drawn by a spring from the first stage on, with another rate in the second.
const STICK_SLIP: [Change<'_>; 12] = [
    With(
        "interfaces.contact.law",
        r#"{ kind = "rate-and-state", evolution = "ageing", mu0 = 0.4, a = 0.005, b = 0.02, l = "1 mm", v_ref = "1 mm/s", v_initial = "1 mm/s" }"#,
    ),
    With("materials.soft", r#"{ young = "10 GPa", poisson = 0.25, density = 2700 }"#),
    With("materials.hard", r#"{ young = "20 GPa", poisson = 0.25, density = 2700 }"#),
    Add("interfaces.contact.damping", "radiation"),
    Add("interfaces.contact.under_resolved", "allow"),
    With("interfaces.contact.sliding", "small"),
    Without("stages[0].frictionless"),
    With("stages[0].conditions[1].x", r#"{ spring = 4e8, rate = "40 mm/s" }"#),
    With("stages[1].conditions[0].x", r#"{ spring = 4e8, rate = "1 mm/s" }"#),
    With("time.friction_tolerance", "9e-3"),
    Add("events", r#"{ above = "10 mm/s", below = "5 mm/s" }"#),
    Without("output.probes"),
];
/// The same with inertia instead of damping while the die slips fast, through one event.
const EVENT: [Change<'_>; 9] = [
    Without("interfaces.contact.damping"),
    With("time.stepper", "auto"),
    Add("time.handover", r#"{ above = "50 mm/s", below = "10 mm/s" }"#),
    Add("time.inertia", "{ spectral_radius = 0.0, tolerance = 0.1 }"),
    With("time.max_step", "5 s"),
    With("stages[0].duration", "20 s"),
    With("stages[1].duration", "30 s"),
    With("stages[0].conditions[1].x", r#"{ spring = 4e7, rate = "4 mm/s" }"#),
    With("stages[1].conditions[0].x", r#"{ spring = 4e7, rate = "4 mm/s" }"#),
];
const WEAKENING: Change<'_> =
    With("interfaces.contact.law", r#"{ kind = "slip-weakening", mu_s = 0.44, mu_k = 0.4, d_c = "10 mm" }"#);
const SPACE: [Change<'_>; 12] = [
    With("kinematics", "3d"),
    With("bodies.slab.mesh.block.element", "hex8"),
    With("bodies.slab.mesh.block.min", r#"[0, "-0.5 m", 0]"#),
    With("bodies.slab.mesh.block.max", r#"["2 m", 0, "0.6 m"]"#),
    With("bodies.slab.mesh.block.divisions", "[6, 1, 2]"),
    With("bodies.die.mesh.block.element", "hex8"),
    With("bodies.die.mesh.block.min", r#"["0.5 m", 0, "0.1 m"]"#),
    With("bodies.die.mesh.block.max", r#"["1.3 m", "0.4 m", "0.4 m"]"#),
    With("bodies.die.mesh.block.divisions", "[2, 1, 1]"),
    Add("stages[0].conditions[0].z", "0"),
    Add("stages[0].conditions[1].z", "0"),
    With("output.points.inside.at", r#"["0.9 m", "-0.2 m", "0.3 m"]"#),
];

/// All degrees of freedom in a system that is so large that GMRES solves it.
const ITERATED: [Change<'_>; 3] = [
    With("bodies.slab.mesh.block.divisions", "[14, 6, 10]"),
    Add("time.path", "full"),
    With("stages[1].conditions[0].x", r#"{ to = "0.1 m" }"#),
];

/// Many pairs, whose tractions are solved for by GMRES.
const PAIRS: [Change<'_>; 4] = [
    With("bodies.slab.mesh.block.divisions", "[20, 1, 14]"),
    With("bodies.die.mesh.block.divisions", "[12, 1, 12]"),
    With("stages[1].conditions[0].x", r#"{ to = "0.002 m" }"#),
    With("interfaces.contact.sliding", "small"),
];

/// Place at which a run is interrupted.
#[derive(Clone, Copy, PartialEq)]
enum Where {
    /// Before a trial.
    Between,
    /// After the first iteration of a trial that takes more.
    Within,
}

/// Interrupts a run before its trial number `left`, or within the first after that which takes several iterations.
struct Interruption {
    kept: Keeper<Outputs>,
    stop: Arc<AtomicBool>,
    left: usize,
    place: Where,
}

impl Observer<Bodies> for Interruption {
    fn begin(&mut self, setup: &Setup) -> Result<(), ObserveError> {
        self.kept.begin(setup)
    }

    fn step(&mut self, view: &StepView<'_>) -> Result<Control, ObserveError> {
        self.kept.step(view)
    }

    fn pause(
        &mut self,
        stand: &mut dyn FnMut() -> ResumeState,
    ) -> Result<Option<&'static str>, ObserveError> {
        if self.place == Where::Between {
            self.stop.store(self.left == 0, Ordering::Relaxed);
        }
        self.left = self.left.saturating_sub(1);
        self.kept.pause(stand)
    }

    fn interrupt(&self) -> Interrupt {
        if self.place == Where::Between || self.left > 0 {
            return Interrupt::default();
        }
        let (stop, asked) = (Arc::clone(&self.stop), AtomicUsize::new(0));
        Interrupt::new(move || {
            let acts = asked.fetch_add(1, Ordering::Relaxed) > 0;
            stop.fetch_or(acts, Ordering::Relaxed);
            acts
        })
    }

    fn end(&mut self, view: &StepView<'_>) -> Result<(), ObserveError> {
        self.kept.end(view)
    }
}

/// Runs `trials` trials of a run in `out` from its current state. Returns its report and records.
fn part(plan: &AnyPlan, out: &Path, trials: usize, place: Where) -> (RunReport, Recorder) {
    resumed(plan, out, trials, place).unwrap()
}

/// The same, or the reason why it cannot be resumed.
fn resumed(
    plan: &AnyPlan,
    out: &Path,
    trials: usize,
    within: Where,
) -> Result<(RunReport, Recorder), RunError> {
    let stop = Arc::new(AtomicBool::new(false));
    let every = Duration::from_secs(3600);
    let pauses = Pauses { every, wall: None, stop: Arc::clone(&stop), begun: Instant::now() };
    let place = Place { out, physics: "p", drawn: true, pauses };
    let schedule = FieldSchedule { fields: 2, profiles: 3 };
    let (kept, from) = match Keeper::<Outputs>::resume(schedule, place.clone()).unwrap() {
        Some((kept, stand)) => (kept, Some(stand)),
        None => (Keeper::begin(schedule, place).unwrap(), None),
    };
    let mut keeper = Interruption { kept, stop, left: trials, place: within };
    let report = run_kept(plan, &mut keeper, from)?;
    let completed = report.outcome == Outcome::Completed;
    if completed {
        checkpoint::remove(out).unwrap();
    }
    Ok((report, keeper.kept.finish(completed).recorder().unwrap()))
}

/// Report of a run without the parts that depend on the machine.
fn figures(report: &RunReport) -> String {
    serde_json::to_string(report).unwrap()
}

/// Numbers of trials of the parts of a run, at random from a seed.
struct Random(u64);

impl Random {
    fn below(&mut self, n: u64) -> usize {
        // Numerical Recipes' generator of 64 bits; its upper bits are good.
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from((self.0 >> 33) % n).unwrap()
    }
}

/// Runs a plan in parts with these numbers of trials, and compares the results with those of a whole run.
fn in_parts(
    name: &str,
    plan: &AnyPlan,
    (whole, expected, record): (&Path, &RunReport, &Recorder),
    interrupted: Where,
    mut trials: impl FnMut() -> usize,
) {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("parts");
    let (mut parts, mut stages) = (1, Vec::new());
    let (mut found, again) = loop {
        let (report, record) = part(plan, &out, trials(), interrupted);
        match &report.outcome {
            Outcome::Interrupted { stage, .. } => stages.extend(stage.clone()),
            Outcome::Completed => break (report, record),
            Outcome::Stopped { reason, .. } => panic!("{name}: {reason}"),
        }
        parts += 1;
        assert!(parts < 2000, "{name} does not get on");
    };
    if interrupted == Where::Within {
        // What was given up has been counted.
        assert!(found.counts.operations.iterations > expected.counts.operations.iterations, "{name}");
        found.counts = expected.counts.clone();
    }
    assert!(figures(&found) == figures(expected), "{name}: {}", difference(&found, expected));
    assert!(format!("{again:?}") == format!("{record:?}"), "{name}: what is drawn differs");
    assert_eq!(differing(whole, &out), Vec::<String>::new(), "{name}");
    for stage in ["press", "draw"] {
        assert!(stages.iter().any(|s| s == stage), "{name} was not interrupted in `{stage}`");
    }
}

/// The first step that differs, or the counts.
fn difference(found: &RunReport, expected: &RunReport) -> String {
    let steps = found.steps.iter().zip(&expected.steps).find(|(a, b)| a != b);
    format!("{steps:?} {:?} {:?}", found.counts, expected.counts)
}

/// Files that differ, or are in one folder only.
fn differing(a: &Path, b: &Path) -> Vec<String> {
    let (a, b) = (files(a), files(b));
    let names = a.keys().chain(b.keys()).filter(|name| a.get(*name) != b.get(*name));
    names.map(|name| name.display().to_string()).collect()
}

/// Number of trials up to which a run is interrupted before each of them.
const EVERY: usize = 60;

/// Interrupts scenes at random, and short ones before every trial.
fn resume(cases: &[(&str, Vec<&[Change<'_>]>)]) {
    interrupt(Where::Between, cases);
}

/// The same, between trials or within them.
fn interrupt(place: Where, cases: &[(&str, Vec<&[Change<'_>]>)]) {
    let mut random = Random(17);
    for (name, changes) in cases {
        let scene = changes.iter().fold(SceneText::new(SCENE), |scene, c| scene.changed(c));
        let plan = planned(&scene.text().unwrap_or_else(|e| panic!("{name}: {e}")));
        let folder = tempfile::tempdir().unwrap();
        let (report, record) = part(&plan, folder.path(), usize::MAX, Where::Between);
        assert_eq!(report.outcome, Outcome::Completed, "{name}");
        let whole = (folder.path(), &report, &record);
        let all = (report.counts.steps + report.counts.rejected) as usize;
        assert!(all > 10, "{name}: only {all} trials");
        in_parts(name, &plan, whole, place, || 1 + random.below((all as u64 / 4).min(8)));
        if all <= EVERY && place == Where::Between {
            in_parts(name, &plan, whole, place, || 1);
        }
    }
}

#[test]
fn implicit_runs_of_elastic_bodies_resume_bit_for_bit() {
    let (small, mortar, uzawa, unknowns) = (&SMALL[..], &[MORTAR][..], &[UZAWA][..], &[UNKNOWNS][..]);
    resume(&[
        ("node-to-point", vec![&[]]),
        ("small, rough", vec![small, &[ROUGH]]),
        ("full path", vec![&[Add("time.path", "full")]]),
        ("round, small, many conditions of contact", vec![small, &[ROUND, ROUGH]]),
        ("mortar", vec![mortar]),
        ("off the end", vec![&[OFF]]),
        ("off the end, mortar", vec![mortar, &[OFF]]),
        ("small mortar", vec![small, mortar]),
        ("cubic patches", vec![&[Add("interfaces.contact.smoothing", "cubic")]]),
        ("uzawa", vec![uzawa]),
        ("uzawa, small mortar", vec![small, mortar, uzawa, &[ROUGH]]),
        ("multipliers as unknowns", vec![unknowns]),
        ("multipliers as unknowns, mortar", vec![unknowns, mortar, &[ROUGH]]),
        ("equal steps", vec![&[Add("stages[1].steps", "9"), Add("stages[0].steps", "7")]]),
        ("plane stress", vec![&[With("kinematics", "plane-stress"), MORTAR]]),
    ]);
}

/// Blocks that lie apart in their meshes start at the gap that the scene sets, before and after an interruption.
#[test]
fn runs_with_start_gaps_of_the_scene_resume_bit_for_bit() {
    let contact = Add("interfaces.contact.adjust", "to-contact");
    let clearance = Add("interfaces.contact.clearance", "0.2 mm");
    resume(&[
        ("adjusted", vec![&[SLANTED, contact]]),
        ("adjusted, small mortar, ageing", vec![&SMALL, &[SLANTED, MORTAR, AGEING, contact]]),
        ("clearance, mortar, multipliers as unknowns", vec![&[SLANTED, MORTAR, UNKNOWNS, clearance]]),
        ("clearance, uzawa", vec![&[SLANTED, UZAWA, clearance]]),
        ("clearance, forward", vec![&FORWARD, &[clearance]]),
    ]);
}

#[test]
fn implicit_runs_with_states_of_friction_resume_bit_for_bit() {
    resume(&[
        ("ageing", vec![&[AGEING]]),
        ("ageing, backward Euler", vec![&[AGEING, Add("time.rule", "backward-euler")]]),
        ("slip law, small", vec![&SMALL, &[SLIP]]),
        ("slip law, mortar, uzawa", vec![&[SLIP, MORTAR, UZAWA]]),
        ("ageing, multipliers as unknowns", vec![&[AGEING, UNKNOWNS, ROUGH]]),
        ("slip weakening", vec![&[WEAKENING, MORTAR]]),
        ("stick-slip on a spring", vec![&STICK_SLIP]),
        ("stick-slip from equilibrium to inertia and back", vec![&STICK_SLIP, &EVENT]),
        ("tied", vec![&SMALL, &[TIED, ROUGH]]),
    ]);
}

#[test]
fn implicit_runs_of_bodies_with_a_history_resume_bit_for_bit() {
    resume(&[
        ("plastic", vec![&[PLASTIC]]),
        ("plastic, finite strain, mortar", vec![&[PLASTIC, MORTAR], &STRAIN]),
        ("Maxwell", vec![&[MAXWELL, AGEING]]),
        ("Maxwell, finite strain", vec![&[MAXWELL, UNKNOWNS], &STRAIN]),
        ("elastic, finite strain", vec![&[UZAWA], &STRAIN]),
    ]);
}

#[test]
fn static_explicit_runs_resume_bit_for_bit() {
    resume(&[
        ("forward", vec![&FORWARD]),
        ("forward, full path", vec![&FORWARD, &[Add("time.path", "full"), ROUGH]]),
        ("forward, small mortar", vec![&FORWARD, &SMALL, &[MORTAR, ROUGH]]),
        ("forward, mortar, ageing", vec![&FORWARD, &[MORTAR, AGEING]]),
        ("forward, slip law", vec![&FORWARD, &[SLIP]]),
        ("forward, weakening", vec![&FORWARD, &[WEAKENING]]),
        ("forward, off the end", vec![&FORWARD, &[OFF]]),
        ("forward, plastic", vec![&FORWARD, &[PLASTIC]]),
        ("forward, plastic, finite strain", vec![&FORWARD, &[PLASTIC, MORTAR], &STRAIN]),
        ("forward, Maxwell", vec![&FORWARD, &SMALL, &[MAXWELL]]),
    ]);
}

#[test]
fn runs_in_space_resume_bit_for_bit() {
    resume(&[
        ("space", vec![&SPACE]),
        ("space, mortar, slip law", vec![&SPACE, &[MORTAR, SLIP]]),
        ("space, uzawa, plastic", vec![&SPACE, &[UZAWA, PLASTIC]]),
        ("space, forward", vec![&SPACE, &FORWARD]),
        ("space, off the end", vec![&SPACE, &[OFF]]),
        ("space, iterated", vec![&SPACE, &ITERATED]),
        ("space, levels", vec![&SPACE, &ITERATED, &[Add("solver", r#"{ method = "iterative" }"#)]]),
        ("space, pairs", vec![&SPACE, &PAIRS, &[SLIP, ROUGH]]),
        ("space, pairs, forward", vec![&SPACE, &FORWARD, &PAIRS, &[ROUGH]]),
        ("space, forward, mortar, ageing, small", vec![&SPACE, &FORWARD, &SMALL, &[MORTAR, AGEING]]),
    ]);
}

#[test]
fn runs_that_are_interrupted_within_steps_resume_bit_for_bit_from_their_starts() {
    interrupt(
        Where::Within,
        &[
            ("node-to-point", vec![&[]]),
            ("plastic, finite strain, mortar", vec![&[PLASTIC, MORTAR], &STRAIN]),
            ("uzawa, small mortar, slip law", vec![&SMALL, &[MORTAR, UZAWA, SLIP]]),
            ("stick-slip from equilibrium to inertia and back", vec![&STICK_SLIP, &EVENT]),
            ("space, iterated", vec![&SPACE, &ITERATED]),
            ("space, pairs", vec![&SPACE, &PAIRS, &[SLIP, ROUGH]]),
        ],
    );
}

/// Bodies without interfaces, solved by each method.
#[test]
fn runs_of_one_body_resume_bit_for_bit() {
    let alone = [
        Without("interfaces"),
        Without("bodies.die"),
        Without("materials.hard"),
        Without("stages[0].frictionless"),
        Without("output.probes"),
        With("stages[0].conditions[1].set", "slab.top"),
        With("stages[1].conditions[0].set", "slab.top"),
        With("output.forces.die.set", "slab.top"),
        WithOrSame("stages[1].conditions[0].x", r#"{ to = "2 mm" }"#),
        Without("time.tolerance"),
        Without("time.friction_tolerance"),
        With("time.max_step", "0.1 s"),
        Add("time.path", "full"),
    ];
    resume(&[
        ("alone", vec![&alone]),
        ("alone, iterative", vec![&alone, &[Add("solver", r#"{ method = "iterative" }"#)]]),
        ("alone, plastic", vec![&alone, &[PLASTIC]]),
        ("alone, plastic, forward", vec![&alone, &[PLASTIC, With("time.stepper", "static-explicit")]]),
    ]);
}

/// Sets numbers to zero, and true values to false.
fn forgotten(value: &mut Value) {
    match value {
        Value::Bool(truth) => *truth = false,
        Value::Number(number) => *number = if number.is_f64() { zero() } else { 0.into() },
        Value::Array(values) => values.iter_mut().for_each(forgotten),
        Value::Object(values) => values.values_mut().for_each(forgotten),
        Value::Null | Value::String(_) => {}
    }
}

fn zero() -> serde_json::Number {
    serde_json::Number::from_f64(0.0).unwrap()
}

/// Resets the value at a path of the checkpoint in `out`. Returns true if that changed it.
fn forget(out: &Path, pointer: &str) -> bool {
    let file = out.join("checkpoint");
    let before = fs::read_to_string(&file).unwrap();
    let [kind, _, contents] = before.splitn(3, '\n').collect::<Vec<_>>()[..] else { panic!("{before}") };
    let mut json: Value = serde_json::from_str(contents).unwrap();
    forgotten(json.pointer_mut(pointer).unwrap_or_else(|| panic!("no {pointer} in {contents}")));
    let contents = json.to_string();
    let sum: String = Sha256::digest(&contents).iter().map(|b| format!("{b:02x}")).collect();
    fs::write(&file, format!("{kind}\n{sum}\n{contents}\n")).unwrap();
    json != serde_json::from_str::<Value>(before.splitn(3, '\n').last().unwrap()).unwrap()
}

/// Remains of a run: its report and files, or the reason why it could not be resumed.
fn left(plan: &AnyPlan, out: &Path) -> Option<(String, BTreeMap<PathBuf, Vec<u8>>)> {
    // A checkpoint with a reset value may be refused.
    let (report, _) = resumed(plan, out, usize::MAX, Where::Between).ok()?;
    Some((figures(&report), files(out)))
}

/// A scene by its changes, the eighths of its trials after which it is interrupted, and fields of the checkpoint at that
/// time. Fields of the interface begin with `contact/`.
type Case<'a> = (&'a str, Vec<&'a [Change<'a>]>, usize, &'a [&'a str]);

/// Scenes in which each of these fields affects the rest of the run.
fn decisive() -> [Case<'static>; 9] {
    const STATES: &[&str] = &[
        "contact/shear/states",
        "contact/shear/rate",
        "contact/shear/traction",
        "contact/step",
        "contact/previous_dt",
        "contact/closed",
        "contact/relative",
        "contact/slip",
        "contact/measure/NodeToPoint/points",
        "contact/work",
        "length/wanted",
        "system/time",
        "system/unknowns",
        "system/begin",
        "system/stepper/last",
        "system/stepper/system/left",
        "system/bodies/solves",
        "work/counts",
        "work/steps",
        "found",
    ];
    const FACES: &[&str] =
        &["contact/measure/Mortar/points", "contact/measure/Mortar/pairs", "contact/normal_traction"];
    const FORWARDS: &[&str] = &[
        "system/stepper/left",
        "contact/shear/slips",
        "contact/shear/traction",
        "contact/displacements",
        "contact/normal_traction",
    ];
    [
        ("ageing", vec![&[AGEING, ROUGH]], 6, STATES),
        ("uzawa", vec![&[UZAWA, MORTAR, ROUGH]], 6, FACES),
        ("searches", vec![&[BESIDE, ROUGH]], 2, &["contact/measure/NodeToPoint/proved"]),
        ("searches, mortar", vec![&[MORTAR, ROUGH]], 2, &["contact/measure/Mortar/proved"]),
        (
            "multipliers as unknowns",
            vec![&[UNKNOWNS, ROUGH]],
            6,
            &["contact/unknowns", "contact/normal_traction", "system/unknowns"],
        ),
        (
            "plastic",
            vec![&[PLASTIC]],
            6,
            &[
                "system/bodies/histories",
                "system/stepper/last",
                "system/energy/sums/energy",
                "system/energy/held",
            ],
        ),
        ("forward", vec![&FORWARD, &[PLASTIC, ROUGH]], 6, FORWARDS),
        ("tied", vec![&[TIED, SLANTED, ROUGH]], 6, &["contact/tied", "contact/measure"]),
        (
            "event",
            vec![&STICK_SLIP, &EVENT],
            5,
            &["system/mass/term/motion", "system/mass/sums", "system/mass/episodes"],
        ),
    ]
}

#[test]
fn no_field_of_the_state_can_be_left_out() {
    let mut idle = Vec::new();
    for (name, changes, eighths, fields) in decisive() {
        let scene = changes.iter().fold(SceneText::new(SCENE), |scene, c| scene.changed(c));
        let plan = planned(&scene.text().unwrap());
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        let whole = left(&plan, &folder.join("whole")).unwrap();
        let trials = whole.0.matches("\"limited_by\"").count() * eighths / 8;
        for field in fields {
            let out = folder.join(field.split('/').collect::<Vec<_>>().join("_"));
            let (report, _) = part(&plan, &out, trials, Where::Between);
            assert!(matches!(report.outcome, Outcome::Interrupted { .. }), "{name}");
            let pointer = match field.strip_prefix("contact/") {
                Some(field) => format!("/state/stand/system/interfaces/0/{field}"),
                None => format!("/state/stand/{field}"),
            };
            assert!(forget(&out, &pointer), "{name}: {field} is nothing but zeros");
            if left(&plan, &out).as_ref() == Some(&whole) {
                idle.push(format!("{name}: {field}"));
            }
        }
    }
    assert_eq!(idle, Vec::<String>::new());
}

/// A scene of few steps for the command line.
fn few_steps() -> String {
    let steps = [Add("stages[0].steps", "3"), Add("stages[1].steps", "3"), Without("time.max_step")];
    SceneText::new(SCENE).changed(&steps).text().unwrap()
}

#[test]
fn the_command_resumes_runs_of_bodies() {
    let scene = few_steps();
    let folder = folder(&scene);
    let folder = folder.path();
    assert!(run(folder, "whole", &[]).status.success());
    assert!(!folder.join("whole/checkpoint").exists());
    let mut parts = 0;
    loop {
        let output = run(folder, "parts", &["--resume", "--wall-time", "0 s"]);
        let said = text(&output.stdout);
        assert!(said.contains(if parts == 0 { "nothing to resume" } else { "resumed at" }), "{said}");
        if output.status.success() {
            break;
        }
        assert_eq!(output.status.code(), Some(3), "{}", text(&output.stderr));
        assert!(told(&output).contains("the same command with --resume resumes it"), "{}", told(&output));
        let report = fs::read_to_string(folder.join("parts/report.json")).unwrap();
        assert!(report.contains("\"status\": \"interrupted\""), "{report}");
        parts += 1;
    }
    assert_eq!(parts, 5);
    assert_same(folder, "parts");
    // A run that is complete is not run again.
    let output = run(folder, "parts", &["--resume"]);
    assert!(
        output.status.success() && text(&output.stdout).contains("is complete"),
        "{}",
        text(&output.stdout)
    );
    assert_same(folder, "parts");
}

#[test]
fn a_checkpoint_of_bodies_that_does_not_fit_is_refused() {
    let scene = few_steps();
    let folder = folder(&scene);
    let folder = folder.path();
    let broken = run(folder, "out", &["--no-plots", "--wall-time", "0 s"]);
    assert_eq!(broken.status.code(), Some(3), "{}", text(&broken.stderr));
    let refused = |arguments: &[&str], part: &str| {
        let output = run(folder, "out", arguments);
        let told = told(&output);
        assert_eq!(output.status.code(), Some(1), "{told}");
        assert!(told.contains(part), "{part} is not in\n{told}");
    };
    refused(&[], "--resume");
    let other = SceneText::new(&scene).with("interfaces.contact.law.mu", "0.41").text().unwrap();
    fs::write(folder.join("s.toml"), other).unwrap();
    refused(&["--resume"], "of another scene");
    // The title is not part of what is computed.
    let renamed = SceneText::new(&scene).with("title", "another title").text().unwrap();
    fs::write(folder.join("s.toml"), renamed).unwrap();
    let path = folder.join("out/checkpoint");
    let good = fs::read_to_string(&path).unwrap();
    fs::write(&path, &good[..good.len() / 2]).unwrap();
    refused(&["--resume"], "is damaged");
    let rest = good.strip_prefix("asperity checkpoint of bodies, version 9\n").unwrap();
    fs::write(&path, format!("asperity checkpoint of bodies, version 99\n{rest}")).unwrap();
    refused(&["--resume"], "has version 99");
    fs::write(&path, format!("asperity checkpoint of faults, version 1\n{rest}")).unwrap();
    refused(&["--resume"], "is of a run of faults, and the scene is of bodies");
    fs::write(&path, good).unwrap();
    let rows = folder.join("out/probes/contact.csv");
    let full = fs::read(&rows).unwrap();
    fs::write(&rows, &full[..full.len() - 1]).unwrap();
    refused(&["--resume"], "contact.csv has");
    fs::write(&rows, full).unwrap();
    let output = run(folder, "out", &["--resume"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("no plots"), "{}", text(&output.stdout));
}
