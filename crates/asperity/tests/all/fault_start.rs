//! Faults that start from the state of another run, and wells with fluxes that change.
#![allow(clippy::disallowed_methods)]

use crate::common::varied;
use asperity_cycles::Moment;
use asperity_ode::Control;
use asperity_plan::dynamics::AnyPlan;
use asperity_plan::faults::Plan;
use asperity_plan::reading::scene::{self, read_in};
use asperity_plan::{ScenePlan, dynamics, plan_scene};
use asperity_vary::Change::{self, Add, With, Without};
use std::fs;
use std::path::Path;

/// A fault in a half-space that weakens between its ends, on coarse cells: events every few decades.
const SCENE: &str = r#"schema = 1
title = "a fault that starts from another run"
kinematics = "antiplane"
[materials.rock]
young = "80 GPa"
poisson = 0.25
density = 2670
[medium]
kind = "half-space"
material = "rock"
[faults.main]
line = { trace = [[0, 0], [0, "-18 km"]], spacing = "1 km" }
law = { kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.010, b = 0.015, l = "8 cm", v_ref = "1 um/s", v_initial = "3e-10 m/s" }
profiles.a = { along = "distance", points = [["12 km", 0.010], ["15 km", 0.025]] }
normal = "50 MPa"
rate = "1e-9 m/s"
damping = "radiation"
under_resolved = "allow"
creep = { rate = "1e-9 m/s" }
[[stages]]
name = "cycles"
duration = "800 yr"
[time]
stepper = "fault-ode"
[events]
above = "1e-3 m/s"
stop_after = 2
"#;

fn plan_in(text: &str, folder: &Path) -> Plan {
    let read = read_in(text, folder).unwrap_or_else(|e| panic!("{e}\n{text}"));
    match plan_scene(&read).unwrap_or_else(|e| panic!("{e} {:?}\n{text}", e.help)) {
        ScenePlan::Faults(plan) => *plan,
        ScenePlan::Bodies(_) | ScenePlan::Dynamic(_) => panic!("the scene has faults"),
    }
}

fn refused(text: &str, folder: &Path) -> String {
    match read_in(text, folder) {
        Err(errors) => errors.to_string(),
        Ok(read) => match plan_scene(&read) {
            Err(error) => error.to_string(),
            Ok(_) => panic!("accepted\n{text}"),
        },
    }
}

/// Writes the slip rates and states of the first step after a time \[s\]; returns its time and the onsets of events after it \[s\].
fn written(plan: &Plan, after: f64, file: &Path) -> (f64, Vec<f64>) {
    let mut at = None;
    let mut look = |now: &Moment<'_>| {
        if at.is_none() && now.at.seconds() > after {
            at = Some(now.at.seconds());
            let mut rows = String::from("distance [m],log10_slip_rate,log10_theta,rate [m/s],state [s]\n");
            for (p, point) in plan.points.iter().enumerate() {
                let (rate, theta) =
                    (now.rate.component(0)[p], point.theta.unwrap().log10(now.states().at(p)[0]));
                let row = [point.along, rate.log10(), theta, rate, 10_f64.powf(theta)];
                rows += &row.map(|v| format!("{v:e}")).join(",");
                rows.push('\n');
            }
            fs::write(file, rows).unwrap();
        }
        Control::Go
    };
    let run = plan.problem.run(&plan.problem.settings, &mut look).unwrap();
    let at = at.unwrap();
    (at, run.events().iter().map(|e| e.onset.seconds()).filter(|onset| *onset > at).collect())
}

const STATES: [&str; 2] =
    [r#"{ file = "states.csv", column = "log10_theta" }"#, r#"{ file = "states.csv" }"#];
const RATES: [&str; 2] =
    [r#"{ file = "states.csv", column = "log10_slip_rate" }"#, r#"{ file = "states.csv" }"#];

/// Slip rates and states of a run in the middle are all that its rest depends on.
#[test]
fn a_run_that_starts_from_the_states_of_another_continues_it() {
    let folder = tempfile::tempdir().unwrap();
    let whole = plan_in(SCENE, folder.path());
    let (at, onsets) = written(&whole, 20.0 * 365.25 * 86_400.0, &folder.path().join("states.csv"));
    assert!(!onsets.is_empty());
    for (state, rate) in STATES.into_iter().zip(RATES) {
        let fields = format!("{{ state = {state}, rate = {rate} }}");
        let rest = plan_in(&varied(SCENE, &[Add("faults.main.fields", &fields)]), folder.path());
        let run = rest.problem.run(&rest.problem.settings, &mut ()).unwrap();
        for (event, onset) in run.events().iter().zip(&onsets) {
            let found = at + event.onset.seconds();
            // Steps are others, with errors of 1e-5 of ln V each.
            assert!((found - onset).abs() < 1e-4 * (onset - at), "{found} {onset} {at}");
        }
        assert!(run.events().len() >= onsets.len());
    }
}

#[test]
fn states_beside_a_shear_traction_or_of_another_law_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let whole = plan_in(SCENE, folder.path());
    written(&whole, 1e9, &folder.path().join("states.csv"));
    let with = |changes: &[Change<'_>]| {
        let fields = format!("{{ state = {} }}", STATES[1]);
        let text = varied(SCENE, &[Add("faults.main.fields", &fields)]);
        refused(&varied(&text, changes), folder.path())
    };
    let shear = with(&[Add("faults.main.shear", "30 MPa")]);
    assert!(shear.contains("it follows from states and slip rates"), "{shear}");
    let turned = with(&[
        With("faults.main.rate", "-1e-9 m/s"),
        Add("faults.main.fields.rate", r#"{ file = "states.csv" }"#),
    ]);
    assert!(turned.contains("must have the sign of `rate`"), "{turned}");
    let no_state = with(&[
        With("faults.main.law", r#"{ kind = "rate", mu0 = 0.6, a = 0.01, v_ref = "1 um/s" }"#),
        Without("faults.main.profiles.a"),
    ]);
    assert!(no_state.contains("`state` varies along the fault"), "{no_state}");
    let other = varied(
        SCENE,
        &[
            Add(
                "faults.main.fields",
                r#"{ a_minus_b = { file = "states.csv", column = "log10_slip_rate" } }"#,
            ),
            Add(
                "faults.main.profiles.b",
                r#"{ along = "distance", points = [["0 km", 0.01], ["9 km", 0.02]] }"#,
            ),
        ],
    );
    let twice = refused(&other, folder.path());
    assert!(twice.contains("another entry gives `b`"), "{twice}");
}

#[test]
fn a_field_of_a_less_b_gives_b() {
    let folder = tempfile::tempdir().unwrap();
    let rows = "distance [m],a_minus_b\n0,-0.004\n20000,0.006\n";
    fs::write(folder.path().join("strength.csv"), rows).unwrap();
    let field = r#"{ a_minus_b = { file = "strength.csv" } }"#;
    let text = varied(SCENE, &[Add("faults.main.fields", field), Without("faults.main.profiles.a")]);
    let plan = plan_in(&text, folder.path());
    let law = &plan.problem.fault.law;
    for (p, point) in plan.points.iter().enumerate() {
        // Steady friction changes by (a - b) ln 10 from one decade of slip rate to the next.
        let steady = |rate: f64| {
            let mut state = [0.0];
            law.steady(p, rate.ln(), &mut state);
            law.scale(p) * law.at_rate(p, rate, &state).unwrap()
        };
        let found = (steady(1e-7) - steady(1e-8)) / std::f64::consts::LN_10;
        let expected = -0.004 + 0.01 * point.along / 20e3;
        assert!((found - expected).abs() < 1e-9, "{p}: {found} {expected}");
    }
    let large = varied(&text, &[With("faults.main.law.a", "0.003")]);
    let negative = refused(&large, folder.path());
    assert!(negative.contains("which leaves a negative b"), "{negative}");
}

/// Bodies with mass that start from slip rates and states hold the traction that both give.
#[test]
fn bodies_with_mass_start_from_slip_rates_and_states() {
    let scene = r#"schema = 1
title = "a strip"
kinematics = "antiplane"
[materials.rock]
young = "80 GPa"
poisson = 0.25
density = 2670
[bodies.A]
mesh.fault = { trace = [[0, "200 m"], [0, "-200 m"]], spacing = "100 m", min = ["-400 m", "-200 m"], max = ["400 m", "200 m"], growth = 1.0, element = "quad4" }
material = "rock"
[faults.main]
minus = "A.fault.minus"
plus = "A.fault.plus"
law = { kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.008, b = 0.012, l = "20 cm", v_ref = "1 um/s", v_initial = "1 um/s" }
normal = "120 MPa"
rate = "1 um/s"
fields.state = { file = "states.csv" }
fields.rate = { file = "states.csv" }
under_resolved = "allow"
[[stages]]
name = "slip"
duration = "0.1 s"
conditions = [{ set = "A.left", absorbing = true }, { set = "A.right", absorbing = true }]
[time]
stepper = "explicit"
[output]
sampling = "10 ms"
"#;
    let folder = tempfile::tempdir().unwrap();
    let rows = "y [m],rate [m/s],state [s]\n-200,1e-6,1e4\n200,3e-6,2e5\n";
    fs::write(folder.path().join("states.csv"), rows).unwrap();
    let read = scene::read_in(scene, folder.path()).unwrap_or_else(|e| panic!("{e}"));
    let AnyPlan::Two(plan) = dynamics::plan(&read).unwrap_or_else(|e| panic!("{e} {:?}", e.help)) else {
        panic!("the scene is plane")
    };
    let fault = plan.problem.fault.as_ref().unwrap();
    for (p, point) in plan.points.iter().enumerate() {
        let share = (point.at[1] + 200.0) / 400.0;
        let (rate, theta) = (1e-6 + 2e-6 * share, 1e4 + 1.9e5 * share);
        assert!((fault.rate.size(p) / rate - 1.0).abs() < 1e-12);
        // The regularised law: a asinh(V/(2 V*) exp((μ0 + b ln(V* θ/L))/a)).
        let level = (0.6 + 0.012 * (1e-6 * theta / 0.2_f64).ln()) / 0.008;
        let mu = 0.008 * ((rate / 2e-6).ln() + level + std::f64::consts::LN_2);
        let shear = fault.shear.component(0)[p];
        assert!((shear / (mu * 120e6) - 1.0).abs() < 1e-9, "{p}: {shear} {mu}");
    }
}

/// Normal tractions fall by the sum of the pressures of two wells, each with jumps, by the quadrature of point sources.
#[test]
fn wells_with_fluxes_that_change_lower_normal_tractions_by_the_sum_of_their_pressures() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("flux.csv"), "time [d],flux [m/s]\n10,2e-6\n40,5e-7\n").unwrap();
    let wells = r#"[
  { at = "4 km", flux = { steps = [["0 d", "1e-6 m/s"], ["20 d", 0]] }, diffusivity = 0.5, porosity = 0.1, compressibility = 1e-8 },
  { at = "5 km", flux = { steps = { file = "flux.csv", column = "flux" } }, diffusivity = 0.5, porosity = 0.1, compressibility = 1e-8 },
]"#;
    let text = varied(
        SCENE,
        &[
            Add("faults.main.injection", wells),
            With("stages[0].duration", "60 d"),
            Without("events.stop_after"),
        ],
    );
    let plan = plan_in(&text, folder.path());
    let day = 86_400.0;
    let fluxes: [(f64, &dyn Fn(f64) -> f64); 2] = [
        (4e3, &|s| if s < 20.0 * day { 1e-6 } else { 0.0 }),
        (5e3, &|s| {
            if s < 10.0 * day {
                0.0
            } else if s < 40.0 * day {
                2e-6
            } else {
                5e-7
            }
        }),
    ];
    let mut last = Vec::new();
    let mut look = |now: &Moment<'_>| {
        last = (0..plan.points.len()).map(|p| now.normal(p)).collect();
        Control::Go
    };
    let run = plan.problem.run(&plan.problem.settings, &mut look).unwrap();
    let end = run.at.seconds();
    assert!((end / (60.0 * day) - 1.0).abs() < 1e-12);
    for (p, normal) in last.iter().enumerate() {
        let mut pressure = 0.0;
        for (at, flux) in &fluxes {
            let distance = plan.points[p].along - at;
            // Midpoints in u = √(t - s), in which the kernel is smooth.
            let (n, most) = (60_000, end.sqrt());
            for k in 0..n {
                let u = most * (f64::from(k) + 0.5) / f64::from(n);
                let kernel =
                    (-distance * distance / (2.0 * u * u)).exp() / (std::f64::consts::PI * 0.5).sqrt();
                pressure += flux(end - u * u) * kernel / 1e-9 * most / f64::from(n);
            }
        }
        // Midpoints meet jumps of the flux to a part of an interval.
        assert!((50e6 - normal - pressure).abs() < 1e-4 * 5e6, "{p}: {normal} {pressure}");
    }
}

#[test]
fn wells_that_contradict_each_other_are_refused() {
    let folder = Path::new(".");
    let well = |at: &str, flux: &str, diffusivity: &str| {
        format!(
            "{{ at = \"{at}\", flux = {flux}, diffusivity = {diffusivity}, porosity = 0.1, compressibility = 1e-8 }}"
        )
    };
    let steady = "\"1e-6 m/s\"";
    for (wells, words) in [
        (vec![well("4 km", steady, "0.5"), well("4 km", steady, "0.5")], "two wells at one position"),
        (vec![well("4 km", steady, "0.5"), well("5 km", steady, "0.6")], "differ in `diffusivity`"),
        (vec![well("4 km", "{ steps = [[10, 1e-6], [5, 0]] }", "0.5")], "times of `flux` must ascend"),
        (vec![well("4 km", "{ steps = [[-10, 1e-6]] }", "0.5")], "before the run begins"),
        (vec![well("4 km", "{ steps = [[0, 0]] }", "0.5")], "must not be zero"),
        (vec![], "a list without wells"),
    ] {
        let list = format!("[{}]", wells.join(", "));
        let text = varied(SCENE, &[Add("faults.main.injection", &list)]);
        let told = refused(&text, folder);
        assert!(told.contains(words), "{told}\n{list}");
    }
}
