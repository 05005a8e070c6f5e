//! Normal tractions of faults: floors, constant tractions, initial stress, and the spacing of points relative to the
//! lengths of friction.

use crate::common::{first_resistance, resistance, varied};
use asperity::kinds::faults::Report;
use asperity_cycles::{Balance, FaultRun, Moment};
use asperity_ode::{Control, Outcome};
use asperity_plan::faults::Plan;
use asperity_plan::reading::diagnostic::Diagnostic;
use asperity_plan::reading::scene;
use asperity_plan::{ScenePlan, plan_scene};
use asperity_vary::Change::{self, Add, With, Without};
use asperity_vary::SceneText;
use asperity_vary::bp1::{AT_CREEP, BP1, sized};

/// A fault with this trace below a free surface, with these keys. Plates load it along the first leg of the trace, in
/// the sense of `sign`.
fn dipping(trace: &str, direction: [f64; 2], sign: f64, keys: &str) -> String {
    let [x, y] = direction.map(|c| 0.5e-9 * sign * c);
    format!(
        r#"schema = 1
title = "dipping"
kinematics = "plane-strain"
[materials.rock]
young = "80 GPa"
poisson = 0.25
density = 2670
[bodies.crust]
material = "rock"
mesh.fault = {{ trace = {trace}, interpolation = "polyline", spacing = [["0 km", "500 m"], ["24 km", "1 km"], ["120 km", "20 km"]], min = ["-100 km", "-60 km"], max = ["200 km", "0 km"], growth = 1.5, element = "quad4" }}
[faults.main]
minus = "crust.fault.minus"
plus = "crust.fault.plus"
law = {{ kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.010, b = 0.015, l = "40 mm", v_ref = "1 um/s", v_initial = "1e-8 m/s" }}
profiles.a = {{ along = "distance", points = [["15 km", 0.010], ["18 km", 0.025]] }}
rate = {:e}
damping = "radiation"
creep = {{ beyond = "24 km", rate = {:e} }}
{keys}
[[stages]]
name = "cycles"
duration = "5000 yr"
conditions = [{{ set = "crust.left", x = {{ rate = {x:e} }}, y = {{ rate = {y:e} }} }}, {{ set = "crust.right", x = {{ rate = {:e} }}, y = {{ rate = {:e} }} }}]
[time]
stepper = "fault-ode"
[events]
above = "1e-3 m/s"
stop_after = 3
"#,
        1e-9 * sign,
        1e-9 * sign,
        -x,
        -y
    )
}

const DIP_60: &str = r#"[["0 km", "0 km"], ["7.5 km", "-12.9903811 km"], ["9 km", "-15.5884573 km"], ["12 km", "-20.7846097 km"], ["34.6410162 km", "-60 km"]]"#;
/// Dips of 45, 30 and 20 degrees.
const LISTRIC: &str = r#"[["0 km", "0 km"], ["4.2426407 km", "-4.2426407 km"], ["11.1708439 km", "-8.2426407 km"], ["153.3715 km", "-60 km"]]"#;

/// A normal fault under 1 MPa plus 7.45 MPa per kilometre of depth.
fn normal_fault(keys: &str) -> String {
    let press = r#"profiles.normal = { along = "y", points = [["-20 km", 150e6], ["0 km", 1e6]] }"#;
    dipping(DIP_60, [0.5, -(0.75_f64.sqrt())], -1.0, &format!("{press}\n{keys}"))
}

/// A thrust that flattens downwards under 2 MPa plus 4.8 MPa per kilometre of depth.
fn thrust(keys: &str) -> String {
    let press = r#"profiles.normal = { along = "y", points = [["-20 km", 98e6], ["0 km", 2e6]] }"#;
    dipping(LISTRIC, [0.75_f64.sqrt(), -0.5], 1.0, &format!("{press}\n{keys}"))
}

fn planned(text: &str) -> Result<Plan, Diagnostic> {
    let scene = scene::read(text).unwrap();
    plan_scene(&scene).map(|plan| match plan {
        ScenePlan::Faults(plan) => *plan,
        ScenePlan::Bodies(_) | ScenePlan::Dynamic(_) => panic!("the scene has faults"),
    })
}

/// A run with its report, and the largest imbalance of tractions relative to the largest initial f_n. Tractions of the
/// bodies follow from slip and loads through the operator, and friction uses the larger of their normal traction and
/// `floor`.
fn followed(plan: &Plan, floor: f64) -> (FaultRun, Report, f64) {
    let operator = &plan.problem.fault.operator;
    let couples = operator.couples_normal();
    let (shear_rate, normal_rate) = plan.problem.loading.rates(1.0, operator.points(), couples);
    let first = first_resistance(&plan.problem, floor);
    let scale = plan.problem.fault.normal.iter().fold(0.0_f64, |l, f| l.max(*f));
    let mut worst = 0.0_f64;
    let mut balance = Balance::new(&plan.problem);
    let mut look = |now: &Moment<'_>| {
        balance.step(now);
        let (shear, press) = (operator.shear_of(now.slip().all()), operator.normal_of(now.slip().all()));
        let time = now.at.seconds();
        for p in 0..first.len() {
            let mut pressed = plan.problem.fault.normal[p] + press[p];
            if couples {
                pressed += normal_rate[p] * time;
            }
            let slips = [now.unknowns[p], now.rate.component(0)[p]];
            let resisting = resistance(&plan.problem.fault, p, pressed.max(floor), slips);
            worst = worst.max((first[p] + shear[p] + shear_rate[p] * time - resisting).abs() / scale);
            // Error of f_n in outputs, which is an unknown itself: a does not make it smaller.
            let shown = now.normal(p) - pressed.max(floor);
            worst = worst.max(0.025 * shown.abs() / scale);
        }
        Control::Go
    };
    let out = plan.problem.run(&plan.problem.settings, &mut look).unwrap();
    let report = Report::new(plan, &out, &mut balance);
    (out, report, worst)
}

/// Bound of the imbalance of tractions over f_n. Errors of ln V are within the tolerance in the mean over all unknowns,
/// four per point. They change friction by a (0.025 at most) times as much, and add up over the steps like a random
/// walk.
fn drift(plan: &Plan, out: &FaultRun) -> f64 {
    let most = (4.0 * plan.points.len() as f64).sqrt() * plan.problem.settings.tolerance;
    0.025 * most * (out.counts.steps as f64).sqrt()
}

/// The report of a run through three events. Friction must balance the tractions of the bodies, and the energy budget
/// must close.
fn through(text: &str, floor: f64) -> Report {
    let plan = planned(text).unwrap();
    let (out, report, worst) = followed(&plan, floor);
    assert_eq!((&out.outcome, report.events.len()), (&Outcome::Stopped, 3));
    assert!(worst < drift(&plan, &out), "{worst:e} {:e}", drift(&plan, &out));
    // Ten times the tolerance, relative to the largest term.
    assert!(report.energy.imbalance < 1e-4, "{:?}", report.energy);
    report
}

#[test]
fn a_shallow_normal_fault_ends_where_it_would_open_and_goes_on_with_a_choice() {
    let plan = planned(&normal_fault("")).unwrap();
    let (out, report, _) = followed(&plan, 0.0);
    let stopped = report.outcome.reason().unwrap();
    assert!(
        matches!(out.outcome, Outcome::Failed { .. }) && out.progress.opens == Some(0),
        "{:?}",
        out.progress.opens
    );
    assert!(stopped.contains("normal_floor") && stopped.contains("normal_changes = false"), "{stopped}");

    let used = &through(&normal_fault("normal_floor = \"0.5 MPa\""), 0.5e6).floors[0];
    assert!(used.points > 0 && used.points < used.of && used.events > 0 && used.least < 0.5e6, "{used:?}");
    assert!(used.time_share > 0.0 && used.time_share < 1.0 && used.slip_share < 0.1, "{used:?}");

    let stays = normal_fault("normal_changes = false");
    assert!(!planned(&stays).unwrap().problem.fault.operator.couples_normal());
    through(&stays, 0.0);
}

#[test]
fn a_shallow_listric_thrust_goes_on_with_a_choice() {
    let used = &through(&thrust("normal_floor = \"1 MPa\""), 1e6).floors[0];
    assert!(used.points < used.of, "{used:?}");
    through(&thrust("normal_changes = false"), 0.0);
}

#[test]
fn a_floor_that_is_never_reached_changes_nothing() {
    let deep =
        |keys: &str| dipping(DIP_60, [0.5, -(0.75_f64.sqrt())], 1.0, &format!("normal = \"50 MPa\"\n{keys}"));
    let onsets = |keys: &str| {
        let (_, report, _) = followed(&planned(&deep(keys)).unwrap(), 0.0);
        (report.events.iter().map(|e| e.onset).collect::<Vec<_>>(), report)
    };
    let ((without, _), (with, report)) = (onsets(""), onsets("normal_floor = \"1 MPa\""));
    assert_eq!(without, with);
    assert_eq!((report.floors[0].points, report.floors[0].time_share), (0, 0.0));
}

/// An upright fault in a symmetric box has no change of normal traction: omitting the change affects only the error
/// norm.
#[test]
fn where_slip_presses_nothing_it_does_not_matter_whether_it_may() {
    let trace = r#"[["50 km", "0 km"], ["50 km", "-15 km"], ["50 km", "-18 km"], ["50 km", "-24 km"], ["50 km", "-60 km"]]"#;
    let onsets = |keys: &str| {
        let text = dipping(trace, [0.0, -1.0], 1.0, &format!("normal = \"50 MPa\"\n{keys}"));
        let mut plan = planned(&text).unwrap();
        plan.problem.settings.tolerance = 1e-8;
        let (_, report, worst) = followed(&plan, 0.0);
        assert!(worst < 1e-6, "{worst:e}");
        report.events.iter().map(|e| e.onset).collect::<Vec<_>>()
    };
    let (may, may_not) = (onsets(""), onsets("normal_changes = false"));
    assert_eq!(may.len(), 3);
    // A hundred times the tolerance of ln V over ten e-folds of V before an event.
    for (a, b) in may.iter().zip(&may_not) {
        assert!((a / b - 1.0).abs() < 1e-7, "{may:?} {may_not:?}");
    }
}

#[test]
fn an_initial_stress_resolves_onto_the_fault_as_on_mohrs_circle() {
    let text = varied(
        &dipping(DIP_60, [0.5, -(0.75_f64.sqrt())], 1.0, ""),
        &[Add("bodies.crust.initial_stress", "[\"-100 MPa\", \"-50 MPa\", \"5 MPa\"]")],
    );
    let plan = planned(&text).unwrap();
    let (mean, half, shear) = (-75e6, -25e6, 5e6);
    // The normal points 30 degrees up from x.
    let (sine, cosine) = 60f64.to_radians().sin_cos();
    let expected = [-(mean + half * cosine + shear * sine), -half * sine + shear * cosine];
    let rate = plan.problem.fault.slip_rates(&plan.problem.start);
    for (p, rate) in rate.all().iter().enumerate() {
        let normal = plan.problem.fault.normal[p];
        let traction = normal * plan.problem.fault.law.scale(p) * plan.problem.start[p]
            + plan.problem.fault.damping[p] * rate;
        // Coordinates of the trace have nine digits.
        assert!((normal / expected[0] - 1.0).abs() < 1e-8, "{normal:e} {expected:?}");
        assert!((traction / expected[1] - 1.0).abs() < 1e-8, "{traction:e} {expected:?}");
        assert!((rate / 1e-9 - 1.0).abs() < 1e-9, "{rate}");
    }
}

#[test]
fn points_are_counted_along_the_cohesive_zone_and_few_are_warned_of_or_refused() {
    let bp1 = |size: f64, keys: &[Change<'_>]| {
        planned(&sized(SceneText::new(BP1), size, AT_CREEP).changed(keys).text().unwrap())
    };
    let plan = bp1(156.25, &[]).unwrap();
    let zone = plan.resolution[0].cohesive_zone;
    // G L/(b f_n), with two points to a cell of second order; cells are at most as large as requested.
    let length = 32.038_120_32e9 * 0.008 / (0.015 * 50e6);
    assert!(
        (zone.length / length - 1.0).abs() < 1e-9 && (zone.spacing / 78.125 - 1.0).abs() < 0.02,
        "{zone:?}"
    );
    assert!(plan.warnings.is_empty(), "{:?}", plan.warnings);
    let few = bp1(312.5, &[]).unwrap();
    assert!(few.warnings.len() == 1 && few.warnings[0].message.contains("2.1"), "{:?}", few.warnings);
    let refused = bp1(781.25, &[]).unwrap_err();
    assert!(refused.message.contains("cohesive zone") && refused.help.unwrap().contains("under_resolved"));
    assert_eq!(bp1(781.25, &[Add("faults.main.under_resolved", "allow")]).unwrap().warnings.len(), 1);
}

/// Refusals of weight, each with the remedy in its message.
#[test]
fn scenes_that_weight_makes_impossible_are_accepted_with_the_remedy_of_their_refusal() {
    let presses_nothing = "fault-weight: weight presses nothing";
    let against_rate = "fault-weight: weight against rate";
    let and_normal = "fault-weight: weight and normal";
    let stress = "bodies.crust.initial_stress";
    let shear = "{ shear = { along = \"y\", points = [[\"-20 km\", 80e6], [\"0 km\", 1e5]] } }";
    for (name, change) in [
        (presses_nothing, Add("faults.main.normal_floor", "1 MPa")),
        (presses_nothing, Add(stress, "[\"-1 MPa\", \"-3 MPa\", 0]")),
        (against_rate, Add("faults.main.profiles", shear)),
        (against_rate, Add(stress, "[\"-200 MPa\", \"-10 MPa\", 0]")),
        (against_rate, With("faults.main.rate", "-1e-9 m/s")),
        (and_normal, Without("faults.main.normal")),
        (and_normal, Without("bodies.crust.gravity")),
        ("faults: gravity", Without("bodies.A.gravity")),
        ("faults-in-space: weight of one body", Add("bodies.B.gravity", "[0, -9.81]")),
    ] {
        let told = |text: &str| {
            scene::read(text).map_err(|e| e.to_string()).and_then(|s| plan_scene(&s).map_err(|e| e.message))
        };
        let text = crate::messages::text(name);
        assert!(told(&text).is_err(), "{name}");
        let mut mended = SceneText::new(&text).changed(&[change]).add("faults.main.under_resolved", "allow");
        if name.ends_with("of one body") {
            // A vertical fault between two blocks is not sheared by weight.
            mended = mended.add("faults.main.normal_floor", "1 MPa").add("faults.main.shear", "20 MPa");
        }
        let mended = mended.text().unwrap();
        assert!(told(&mended).is_ok(), "{name} {change:?}: {:?}", told(&mended).err());
    }
}

/// Conditions on the lower end of blocks that agree with the creep are redundant, and count once.
#[test]
fn conditions_that_say_the_same_as_creep_count_once() {
    let refused = crate::messages::text("faults-in-space: creep and sides");
    // It does not start at the rate of the creep, which would be an equilibrium.
    let changed = SceneText::new(&refused).with("faults.main.creep.rate", "1e-9");
    let text = changed.with("faults.main.rate", "2e-9").text().unwrap();
    let plan = planned(&text).unwrap();
    assert!(plan.warnings.is_empty(), "{:?}", plan.warnings);
    // Blocks that slip everywhere at the rate of the creep move rigidly.
    let n = plan.points.len();
    let (load, _) = plan.problem.loading.rates(1.0, n, false);
    let slip = plan.problem.fault.operator.shear_of(&vec![1e-9; n]);
    let size = slip.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let off = load.iter().zip(&slip).fold(0.0_f64, |m, (a, b)| m.max((a + b).abs()));
    assert!(off < 1e-9 * size, "{off:e} {size:e}");
}
