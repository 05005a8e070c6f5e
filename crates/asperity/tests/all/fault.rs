//! Faults through cycles: the community's benchmark BP1 on coarse meshes.

use crate::common::varied;
use asperity::kinds::faults::Report;
use asperity_cycles::operator::{Both, Dense, Operator};
use asperity_cycles::{Balance, Moment, Rupture};
use asperity_ode::{Control, Method, Outcome};
use asperity_plan::faults::Plan;
use asperity_plan::reading::scene;
use asperity_plan::{ScenePlan, plan_scene};
use asperity_run::Event;
use asperity_scene::defaults;
use asperity_vary::Change::{self, Add, With, WithOrSame, Without};
use asperity_vary::SceneText;
use asperity_vary::bp1::{AT_CREEP, BP1, sized};

const YEAR: f64 = 365.25 * 86400.0;
const PLATE: f64 = 1e-9;

/// BP1 with cells of this size \[m\] where the fault is locked.
fn bp1(size: f64) -> Plan {
    let text = sized(SceneText::new(BP1), size, AT_CREEP).text().unwrap();
    match plan_scene(&scene::read(&text).unwrap()).unwrap() {
        ScenePlan::Faults(plan) => *plan,
        ScenePlan::Bodies(_) | ScenePlan::Dynamic(_) => panic!("the scene has faults"),
    }
}

/// Onsets \[yr\] and events of a run that ends after `most` of them.
fn events(plan: &Plan, method: Method, tolerance: f64, most: usize) -> (Vec<f64>, Vec<Event<Rupture>>) {
    let mut settings = plan.problem.settings;
    (settings.method, settings.tolerance, settings.most_events) = (method, tolerance, Some(most));
    let out = plan.problem.run(&settings, &mut ()).unwrap();
    assert_eq!(out.outcome, Outcome::Stopped);
    let events = out.events().to_vec();
    (events.iter().map(|e| e.onset.seconds() / YEAR).collect(), events)
}

#[test]
fn faults_in_space_are_integrated_by_the_stabilised_method() {
    const BP5: &str = include_str!("../../../../scenes/bp5.toml");
    const COARSE: [Change<'_>; 2] = [With("faults.main.rectangle.size", "4 km"), Without("output")];
    const HEAT: Change<'_> = Add(
        "faults.main.heat",
        r#"{ thickness = "10 mm", capacity = "2.7 MJ/(m^3 K)", diffusivity = "1 mm^2/s", temperature = "400 K" }"#,
    );
    let found = |text: &str| {
        let ScenePlan::Faults(plan) = plan_scene(&scene::read(text).unwrap()).unwrap() else {
            panic!("the scene has faults")
        };
        (plan.problem.settings.method, plan.problem.settings.tolerance)
    };
    let space = |changes: &[Change<'_>]| found(&varied(&varied(BP5, &COARSE), changes));
    assert_eq!(space(&[]), (Method::Stabilised, 1e-4));
    assert_eq!(Method::Stabilised.name(), defaults::METHOD_IN_SPACE);
    assert_eq!(space(&[Add("time.log_rate_tolerance", "1e-6")]), (Method::Stabilised, 1e-6));
    assert_eq!(space(&[Add("time.method", "\"tsit5\"")]), (Method::Tsit5, 1e-5));
    assert_eq!(space(&[HEAT]), (Method::Tsit5, 1e-5));
    assert_eq!(found(BP1), (Method::Tsit5, 1e-5));
}

#[test]
fn the_first_event_of_bp1_comes_when_converged_codes_say() {
    let (onsets, events) = events(&bp1(156.25), Method::Tsit5, 1e-4, 1);
    // Two codes with boundary elements of 19.5 to 25 m give 196.36 to 196.37 yr. The process zone has 2.2 cells of 156
    // m. The bound is the error of boundary elements of 78 m, with as many unknowns (QDYN: 196.509 yr).
    assert!((onsets[0] - 196.365).abs() < 0.15, "{onsets:?}");
    // No point slips more than the plates have moved since the start; the later events, 78 yr apart, slip 2.45 m.
    let slip = events[0].details.slip.component(0).iter().copied().fold(0.0, f64::max);
    assert!(slip > 2.45 && slip < 197.0 * YEAR * PLATE, "{slip}");
}

#[test]
fn onsets_converge_with_the_tolerance_and_agree_between_methods() {
    let plan = bp1(312.5);
    let fine = events(&plan, Method::Dop853, 1e-7, 1).0[0];
    let error = |method, tolerance| (events(&plan, method, tolerance, 1).0[0] - fine).abs();
    let (coarse, medium) = (error(Method::Tsit5, 1e-3), error(Method::Tsit5, 1e-5));
    // The error of ln V per step is the tolerance. Those of the hundreds of steps that lead up to an event add up to
    // less than a hundred tolerances in years.
    assert!(medium < 1e-3, "{medium}");
    assert!(coarse > medium, "{coarse} {medium}");
    assert!(error(Method::Dop853, 1e-5) < 1e-3);
}

/// The traction of the bodies, from slip and loads through the operator, must equal friction, which the equations
/// integrate: their difference is the error of the integration.
#[test]
fn friction_balances_what_the_bodies_exert() {
    let plan = bp1(312.5);
    let n = plan.points.len();
    let (shear_rate, _) = plan.problem.loading.rates(1.0, n, false);
    let mut worst = 0.0_f64;
    let mut settings = plan.problem.settings;
    (settings.tolerance, settings.most_events) = (1e-6, Some(1));
    let law = &plan.problem.fault.law;
    let strength = |p: usize, m: f64| plan.problem.fault.normal[p] * law.scale(p) * m;
    let first: Vec<f64> =
        (0..n).map(|p| strength(p, plan.problem.start[p]) + plan.problem.fault.damping[p] * PLATE).collect();
    let mut look = |now: &Moment<'_>| {
        let exerted = plan.problem.fault.operator.shear_of(now.slip().all());
        for p in 0..n {
            let driving = first[p] + exerted[p] + shear_rate[p] * now.at.seconds();
            let resisting =
                strength(p, now.unknowns[p]) + plan.problem.fault.damping[p] * now.rate.component(0)[p];
            worst = worst.max((driving - resisting).abs() / plan.problem.fault.normal[p]);
        }
        Control::Go
    };
    plan.problem.run(&settings, &mut look).unwrap();
    // An error of ln V of 1e-6 per step changes friction by a times that, and there are a hundred steps in an e-fold of
    // ln V.
    assert!(worst < 1e-6, "{worst:e}");
}

/// The lower half of BP6 with cells of 1 km and this flux of fluid \[m/s\].
fn injected(flux: f64) -> Plan {
    let text = varied(
        include_str!("../../../../scenes/bp6-a.toml"),
        &[
            Without("bodies.rock.mesh.fault.trace[0]"),
            With("bodies.rock.mesh.fault.spacing", "1 km"),
            With("bodies.rock.mesh.fault.max[1]", "0 km"),
            With("faults.main.injection.at", "0 km"),
            With("output.stations.main", r#"["15 km", "17.5 km", "18.5 km", "19 km", "19.5 km"]"#),
            WithOrSame("faults.main.injection.flux", &format!("{flux:e} m/s")),
        ],
    );
    match plan_scene(&scene::read(&text).unwrap()).unwrap() {
        ScenePlan::Faults(plan) => *plan,
        ScenePlan::Bodies(_) | ScenePlan::Dynamic(_) => panic!("the scene has faults"),
    }
}

/// Largest imbalance of tractions over f_n, and the lowest f_n \[Pa\], of a run with this tolerance.
fn under_fluid(tolerance: f64) -> (f64, f64) {
    let mut plan = injected(1.25e-6);
    plan.problem.settings.tolerance = tolerance;
    let (mut worst, mut lowest) = (0.0_f64, f64::INFINITY);
    let mut look = |now: &Moment<'_>| {
        let exerted = plan.problem.fault.operator.shear_of(now.slip().all());
        for (p, exerted) in exerted.iter().enumerate() {
            let normal = now.normal(p);
            lowest = lowest.min(normal);
            let resisting = normal * plan.problem.fault.law.scale(p) * now.unknowns[p]
                + plan.problem.fault.damping[p] * now.rate.component(0)[p];
            worst = worst.max((29.2e6 + exerted - resisting).abs() / 50e6);
        }
        Control::Go
    };
    let out = plan.problem.run(&plan.problem.settings, &mut look).unwrap();
    assert_eq!(out.outcome, Outcome::Completed);
    (worst, lowest)
}

#[test]
fn friction_balances_under_the_pressure_of_fluid_that_comes_and_goes() {
    // The error norm is a mean over 180 unknowns. The one point where fluid enters may therefore have an error of 13
    // tolerances of ln V per step, and of a = 0.007 times that in friction. Errors of a hundred steps that follow the
    // square root of time add up like a random walk, to 0.9 tolerances. At 1e-8 rounding adds to them.
    for (tolerance, bound) in [(1e-6, 9e-7), (1e-8, 3e-8)] {
        let (worst, lowest) = under_fluid(tolerance);
        assert!(worst < bound, "{tolerance:e}: {worst:e}");
        // q/(beta phi) sqrt(t/(pi alpha)) at 100 d.
        let pressure = 1.25e-6 / 1e-9 * (8.64e6 / (std::f64::consts::PI * 0.1)).sqrt();
        assert!((lowest - (50e6 - pressure)).abs() < 1e-6 * pressure, "{lowest} {pressure}");
    }
}

#[test]
fn a_fault_that_fluid_opens_ends_at_its_last_good_state_and_names_the_point() {
    let plan = injected(1e-5);
    let out = plan.problem.run(&plan.problem.settings, &mut ()).unwrap();
    assert!(matches!(out.outcome, Outcome::Failed { .. }), "{:?}", out.outcome);
    assert_eq!(out.progress.opens, Some(0));
    assert!(out.unknowns.iter().all(|y| y.is_finite()));
    // Pressure reaches 50 MPa where q/(beta phi) sqrt(t/(pi alpha)) does.
    let expected = (50e6 * 1e-9 / 1e-5_f64).powi(2) * std::f64::consts::PI * 0.1;
    assert!((out.at.seconds() / expected - 1.0).abs() < 0.01, "{} {expected}", out.at.seconds());
    let report = Report::new(&plan, &out, &mut Balance::new(&plan.problem));
    assert!(report.outcome.reason().is_some_and(|s| s.contains("falls to zero")));
}

/// Entry of a matrix whose entries all differ.
fn entry(i: usize, j: usize) -> f64 {
    ((7 * i + 13 * j) % 11) as f64 - 4.5 + 0.1 * i as f64
}

#[test]
fn parts_of_an_operator_of_two_components_make_the_product_with_the_whole_matrix() {
    let n = 5;
    let part = |row: usize, column: usize, normal: bool| -> Box<dyn Operator> {
        let matrix = |row: usize| -> Vec<f64> {
            let at = |k: usize| entry(row * n + k / n, column * n + k % n);
            (0..n * n).map(at).collect()
        };
        Box::new(Dense::new(n, matrix(row), normal.then(|| matrix(2))))
    };
    let slip: Vec<f64> = (0..2 * n).map(|k| (k as f64).sin()).collect();
    let row = |i: usize| (0..2 * n).map(|j| entry(i, j) * slip[j]).sum::<f64>();
    let both = Both::new([part(0, 0, true), part(1, 1, true)], Some([part(0, 1, false), part(1, 0, false)]));
    let shear = both.shear_of(&slip);
    let normal = both.normal_of(&slip);
    for (i, found) in shear.iter().chain(&normal).enumerate() {
        assert!((found - row(i)).abs() < 1e-13, "{i}: {found} {}", row(i));
    }
    for (j, found) in both.stiffness().all().iter().enumerate() {
        let sum: f64 = (0..3 * n).map(|i| entry(i, j).abs()).sum();
        assert!((found - sum).abs() < 1e-12, "{j}");
    }
}
