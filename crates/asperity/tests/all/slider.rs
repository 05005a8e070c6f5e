//! Spring-sliders from scenes: events, histories, run-away, prescribed histories, and the same answers from library calls.

use crate::common::sliders::{CYCLE, history, plan, relative, written};
use crate::common::varied;
use asperity::kinds::sliders::{Entry, Report};
use asperity_cycles::Thresholds;
use asperity_cycles::slider::{DEFAULT_METHOD, Problem, Rows, SliderRun, SliderState, run};
use asperity_friction::slider::{Condition, History, Slider, Spring, System};
use asperity_laws as laws;
use asperity_ode::{Control, Failure, Method, Outcome};
use asperity_plan::reading::scene::law::{Evolution, Form, LawChoice, State, Strength};
use asperity_run::Observers;
use asperity_vary::Change::{Add, With, Without};
use nalgebra::Complex;

/// A slider a third stiffer than the critical stiffness, under these prescribed histories.
fn stable(load: &str, normal: &str, more: &str) -> String {
    format!(
        r#"
schema = 1
title = "stable"
kinematics = "spring-slider"
[load]
rate = {load}
[sliders.block]
normal = {normal}
stiffness = "5 GPa/m"
{more}
law = {{ kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.010, b = 0.015, l = "10 um", v_ref = "1 um/s", v_initial = "1 um/s" }}
[time]
end = "300 s"
"#
    )
}

/// A stable scene that runs until the effect of the start or of a change has decayed, as e^(-t/40 s).
fn settled(text: &str) -> String {
    varied(text, &[With("time.end", "1000 s")])
}

/// Two sliders, one with a state and one without, connected by a spring.
const COUPLED: &str = r#"
schema = 1
title = "two"
kinematics = "spring-slider"
[load]
rate = "1 um/s"
[sliders.left]
normal = "5 MPa"
stiffness = "1.25 GPa/m"
damping = "5 MPa s/m"
law = { kind = "rate-and-state", evolution = "slip", mu0 = 0.6, a = 0.010, b = 0.015, l = "10 um", v_ref = "1 um/s", v_initial = "1 um/s" }
start = "1.5 um/s"
[sliders.right]
normal = { mean = "8 MPa", amplitude = "1 MPa", period = "70 s" }
damping = "5 MPa s/m"
law = { kind = "rate", mu0 = 0.6, a = 0.01, v_ref = "1 um/s" }
[[springs]]
between = ["left", "right"]
stiffness = "0.5 GPa/m"
[time]
end = "900 s"
tolerance = 1e-9
[events]
above = "0.1 mm/s"
below = "20 um/s"
"#;

/// Moments seen by an observer.
#[derive(Clone, Debug)]
struct Row {
    time: f64,
    dt: f64,
    conditions: Vec<Condition>,
    slip: Vec<f64>,
    load: f64,
}

fn watched(plan: &Problem) -> (SliderRun, Vec<Row>) {
    let mut rows = Vec::new();
    let mut look = |now: &SliderState<'_>| {
        rows.push(Row {
            time: now.at.seconds(),
            dt: now.dt,
            conditions: now.conditions.to_vec(),
            slip: now.slip.to_vec(),
            load: now.load,
        });
    };
    let run = run(plan, &mut look).unwrap();
    (run, rows)
}

fn completed(text: &str) -> (SliderRun, Vec<Row>) {
    let (run, rows) = watched(&plan(text));
    assert_eq!(run.outcome, Outcome::Completed);
    (run, rows)
}

/// The row at a time, the last one where there are several.
fn at(rows: &[Row], time: f64) -> &Row {
    rows.iter().rfind(|r| r.time == time).unwrap_or_else(|| panic!("no row at {time}"))
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|v| v.to_bits()).collect()
}

#[test]
fn ten_events_of_the_scene_recur_and_slip_as_far_as_the_load_point() {
    let plan = plan(CYCLE);
    let (run, rows) = watched(&plan);
    assert_eq!(run.outcome, Outcome::Stopped);
    let events = Entry::all(&run);
    assert_eq!(events.len(), 10);
    assert_eq!(plan.events, Some(Thresholds { on: 1e-3, off: 0.1 * 1e-3 }));
    let last = &events[9];
    // verification/independent/spring_slider.json, mild_ageing
    assert!(relative(last.interval.unwrap(), 343.110_389_978_976) < 1e-8, "{last:?}");
    assert!(relative(last.peak_rate, 0.044_971_867_774) < 1e-7, "{last:?}");
    assert!(relative(last.least_rate, 2.225_947_927_5e-9) < 1e-7, "{last:?}");
    for event in &events[4..] {
        // The limit cycle: the errors of event times at this tolerance are some 1e-9 of the interval.
        assert!(relative(event.interval.unwrap(), last.interval.unwrap()) < 1e-8, "{event:?}");
        assert!(relative(event.peak_rate, last.peak_rate) < 1e-6, "{event:?}");
        assert!(relative(event.slip.unwrap(), last.slip.unwrap()) < 1e-6, "{event:?}");
    }
    // From onset to onset traction and slip rate are the same, so that the slider has moved as far as the load point.
    let slip = |onset: f64| at(&rows, onset).slip[0];
    let (from, to) = (events[8].onset, last.onset);
    assert!(relative(slip(to) - slip(from), 1e-6 * last.interval.unwrap()) < 1e-7);
    // The run ends with the tenth event.
    assert!((run.at.seconds() - last.onset - last.duration.unwrap()).abs() < 1e-9);
    let now = rows.last().unwrap();
    assert!(relative(now.conditions[0].rate, 1e-4) < 1e-9, "{now:?}");
}

#[test]
fn onsets_are_where_the_slip_rate_crosses_the_threshold() {
    let (run, rows) = watched(&plan(CYCLE));
    for event in Entry::all(&run) {
        assert!(relative(at(&rows, event.onset).conditions[0].rate, 1e-3) < 1e-8, "{event:?}");
        let within = rows.iter().filter(|r| r.time >= event.onset);
        let within = within.take_while(|r| r.conditions[0].rate >= 1e-4 * (1.0 - 1e-9));
        let seen = within.map(|r| r.conditions[0].rate).fold(0.0, f64::max);
        assert!(seen <= event.peak_rate && relative(seen, event.peak_rate) < 1e-3, "{seen:e} {event:?}");
    }
}

#[test]
fn rows_of_histories_follow_the_slip_rate_closely() {
    for method in [Method::Dop853, Method::Tsit5, Method::Radau5, Method::Bdf, Method::Esdirk34] {
        let mut plan = plan(CYCLE);
        (plan.method, plan.most_events) = (method, Some(3));
        plan.tolerance = 1e-6;
        let (folder, run) = written(&plan);
        let rows = history(folder.path(), "block.csv");
        let widest = rows.windows(2).map(|w| (w[1][3] / w[0][3]).ln().abs()).fold(0.0, f64::max);
        assert!(widest <= 0.11, "{}: {widest}", method.name());
        assert!(rows.windows(2).all(|w| w[0][0] <= w[1][0]), "{}", method.name());
        assert_eq!(rows[0][0], 0.0);
        assert_eq!(rows.last().unwrap()[0], run.at.seconds(), "{}", method.name());
        // A row is written where ln V has changed by 0.05, at a thousandth of the run, or on one side of a jump.
        let travelled: f64 = rows.windows(2).map(|w| (w[1][3] / w[0][3]).ln().abs()).sum();
        let most = 2.0 * (travelled / 0.05 + 1000.0);
        assert!((rows.len() as f64) < most, "{}: {} rows, {most}", method.name(), rows.len());
    }
}

#[test]
fn histories_keep_the_balance_of_the_springs() {
    let mut plan = plan(COUPLED);
    // With rows by change, each slider has its own rows.
    plan.output = Rows { change: None, interval: Some(0.5), ..Rows::default() };
    let (folder, _) = written(&plan);
    let (left, right) = (history(folder.path(), "left.csv"), history(folder.path(), "right.csv"));
    assert!(left.len() > 1000 && left.len() == right.len());
    let (k, coupling) = (1.25e9, 0.5e9);
    for (a, b) in left.iter().zip(&right) {
        let ([slip_a, slip_b], load) = ([a[2], b[2]], a[7]);
        // K u = k u_load - (T - T0), row by row of the stiffness matrix.
        let balance = [
            (k + coupling) * slip_a - coupling * slip_b - k * load + (a[5] - left[0][5]),
            coupling * (slip_b - slip_a) + (b[5] - right[0][5]),
        ];
        assert!(
            balance.iter().all(|r| r.abs() < 1e-13 * k * (load + 1e-3) + 1e-8),
            "{balance:?} at {}",
            a[0]
        );
        // Without mass the springs carry friction and damping.
        for row in [a, b] {
            assert!((row[5] - row[4] * row[6] - 5e6 * row[3]).abs() < 1e-9 * row[5], "{row:?}");
        }
    }
}

/// The mean of a rate that changes exponentially between two values.
fn mean(v0: f64, v1: f64) -> f64 {
    let log = (v1 / v0).ln();
    if log.abs() < 1e-6 { 0.5 * (v0 + v1) } else { (v1 - v0) / log }
}

#[test]
fn slip_is_the_integral_of_the_slip_rate() {
    let inertial = varied(
        CYCLE,
        &[
            With("sliders.block.damping", "0.2 MPa s/m"),
            Add("sliders.block.mass", "3000 kg/m^2"),
            With("events.stop_after", "2"),
        ],
    );
    for text in [CYCLE, &inertial, COUPLED] {
        let (run, rows) = watched(&plan(text));
        assert!(!matches!(run.outcome, Outcome::Failed { .. }), "{run:?}");
        for i in 0..rows[0].slip.len() {
            let forward = |r: &Row| r.conditions[i].rate > 0.0;
            let (mut gone, mut found) = (0.0, 0.0);
            for w in rows.windows(2).filter(|w| forward(&w[0]) && forward(&w[1])) {
                gone += w[1].slip[i] - w[0].slip[i];
                found += mean(w[0].conditions[i].rate, w[1].conditions[i].rate) * (w[1].time - w[0].time);
            }
            // Between rows ln V is linear up to second order, in steps of at most 0.1.
            assert!(gone > 1e-4 && relative(found, gone) < 2e-3, "slider {i}: {found:e} for {gone:e}");
        }
    }
}

#[test]
fn an_undamped_slider_runs_away_with_every_method_and_is_told_what_it_needs() {
    let text = CYCLE.lines().filter(|l| !l.starts_with("damping")).collect::<Vec<_>>().join("\n");
    let mut ends = Vec::new();
    for method in Method::ALL {
        let mut plan = plan(&text);
        plan.method = method;
        let (run, rows) = watched(&plan);
        let name = method.name();
        assert!(matches!(run.outcome, Outcome::Failed { .. }), "{name}: {:?}", run.outcome);
        // The last good state: on the branch that runs away, with all results until then.
        let last = rows.last().unwrap();
        assert!(run.unknowns.iter().all(|u| u.is_finite()), "{name}");
        assert!((1.0..=5e3).contains(&last.conditions[0].rate), "{name}: {last:?}");
        assert!(rows.iter().all(|r| r.conditions[0].friction > 0.5), "{name} left the branch");
        assert_eq!(Entry::all(&run).len(), 1, "{name}");
        assert_eq!(Entry::all(&run)[0].duration, None, "{name}");
        assert_eq!(last.time, run.at.seconds(), "{name}");
        let report = serde_json::to_value(Report::new(&plan, &run)).unwrap();
        let reason = report["outcome"]["stopped"]["reason"].as_str().unwrap();
        assert!(reason.contains("`block`") && reason.contains("`damping"), "{reason}");
        ends.push(run.at.seconds());
    }
    // The slip rate becomes infinite at one time, whatever the method.
    for end in &ends {
        assert!((end - ends[ends.len() - 1]).abs() < 1e-3, "{ends:?}");
    }
}

#[test]
fn a_slider_that_starts_steady_stays_steady() {
    let (_, rows) = completed(&stable("\"1 um/s\"", "\"5 MPa\"", ""));
    // At rest relative to the load, an explicit step grows up to the limit of stability. Rounding then grows to the
    // tolerance of a step in ln V, and that of friction to a times as much.
    assert!(rows.iter().all(|r| relative(r.conditions[0].rate, 1e-6) < 1e-8));
    // v_ref is the rate at which friction is mu0, up to the regularisation.
    assert!(rows.iter().all(|r| (r.conditions[0].friction - 0.6).abs() < 1e-10));
}

#[test]
fn after_a_step_of_the_load_the_slider_settles_at_the_new_rate() {
    let step = r#"{ table = [["0 s", "1 um/s"], ["100 s", "1 um/s"], ["100 s", "10 um/s"]] }"#;
    let (run, rows) = completed(&stable(step, "\"5 MPa\"", ""));
    assert!(relative(at(&rows, 100.0).conditions[0].rate, 1e-6) < 1e-9);
    let last = rows.last().unwrap();
    assert!(relative(last.conditions[0].rate, 1e-5) < 1e-8, "{last:?}");
    // mu0 + (a - b) ln(V/Vref)
    assert!((last.conditions[0].friction - (0.6 - 0.005 * 10f64.ln())).abs() < 1e-9, "{last:?}");
    assert!(relative(last.load, 1e-6 * 100.0 + 1e-5 * 200.0) < 1e-14);
    assert_eq!(run.at.seconds(), 300.0);
    assert!(rows.windows(2).any(|w| w[0].time == 100.0 && w[1].time == 100.0 && w[1].dt == 0.0));
}

#[test]
fn the_load_point_goes_as_far_as_its_rate_says() {
    let ramp = r#"{ table = [["0 s", "1 um/s"], ["100 s", "1 um/s"], ["110 s", "10 um/s"]] }"#;
    let (_, rows) = completed(&stable(ramp, "\"5 MPa\"", ""));
    for row in &rows {
        let (before, within) = (row.time.min(100.0), (row.time - 100.0).clamp(0.0, 10.0));
        let after = (row.time - 110.0).max(0.0);
        let exact = 1e-6 * before + (1e-6 + 0.45e-6 * within) * within + 1e-5 * after;
        assert!((row.load - exact).abs() < 1e-17 + 1e-14 * exact, "{row:?}");
    }
    let sine = r#"{ mean = "1 um/s", amplitude = "0.5 um/s", period = "20 s", start = "5 s" }"#;
    let (_, rows) = completed(&stable(sine, "\"5 MPa\"", ""));
    let frequency = std::f64::consts::TAU / 20.0;
    for row in &rows {
        let phase = |t: f64| (frequency * (t - 5.0)).cos();
        let exact = 1e-6 * row.time + 0.5e-6 / frequency * (phase(0.0) - phase(row.time));
        assert!((row.load - exact).abs() < 1e-17 + 1e-13 * exact.abs(), "{row:?}");
    }
}

#[test]
fn a_slider_follows_a_small_oscillation_as_linear_theory_says() {
    let share = 1e-4;
    let sine = r#"{ mean = "1 um/s", amplitude = "0.1 nm/s", period = "20 s" }"#;
    let (_, rows) = completed(&settled(&stable(sine, "\"5 MPa\"", "")));
    // x = δ ln V and y = δ ln θ: y' = -(V/L)(x + y) and f_n (a x' + b y') = k V (load - x).
    let (f_n, a, b, rate, k) = (5e6, 0.01, 0.015, 1e-6 / 1e-5, 5e9 * 1e-6);
    let omega = std::f64::consts::TAU / 20.0;
    let i = Complex::i() * omega;
    let response = Complex::from(k * share) / (i * f_n * a + k - i * f_n * b * rate / (i + rate));
    let late: Vec<&Row> = rows.iter().filter(|r| r.time > 500.0).collect();
    assert!(late.len() > 20, "{} rows", late.len());
    for row in late {
        let exact = (response * Complex::new(0.0, omega * row.time).exp()).im;
        let found = (row.conditions[0].rate / 1e-6).ln();
        // Of second order in the amplitude.
        assert!((found - exact).abs() < 10.0 * share * share, "{found:e} {exact:e} at {}", row.time);
    }
}

#[test]
fn a_step_of_the_normal_traction_keeps_the_traction_of_the_spring_or_with_mass_the_rate() {
    let step = r#"{ table = [["0 s", "5 MPa"], ["100 s", "5 MPa"], ["100 s", "5.1 MPa"]] }"#;
    for (more, inertial) in
        [("", false), ("damping = \"5 MPa s/m\"", false), ("mass = \"3000 kg/m^2\"", true)]
    {
        let (_, rows) = completed(&settled(&stable("\"1 um/s\"", step, more)));
        let jump = rows.windows(2).find(|w| w[1].time == 100.0 && w[1].dt == 0.0).unwrap();
        let (before, after) = (&jump[0].conditions[0], &jump[1].conditions[0]);
        assert_eq!((jump[0].time, before.normal, after.normal), (100.0, 5e6, 5.1e6));
        assert!((jump[1].slip[0] - jump[0].slip[0]).abs() < 1e-15, "{more}: the slider jumped");
        assert!(relative(after.traction, before.traction) < 1e-12, "{more}: {before:?} {after:?}");
        if inertial {
            assert!(relative(after.rate, before.rate) < 1e-12, "{before:?} {after:?}");
        } else {
            assert!(after.rate < 0.5 * before.rate, "{before:?} {after:?}");
        }
        let last = rows.last().unwrap().conditions[0];
        assert!(relative(last.rate, 1e-6) < 1e-6, "{more}: {last:?}");
    }
}

#[test]
fn ramps_and_oscillations_of_the_normal_traction_are_as_written() {
    let ramp = r#"{ table = [["0 s", "5 MPa"], ["100 s", "5 MPa"], ["200 s", "4 MPa"]] }"#;
    let (_, rows) = completed(&stable("\"1 um/s\"", ramp, ""));
    for row in &rows {
        let exact = 5e6 - 1e4 * (row.time - 100.0).clamp(0.0, 100.0);
        assert!(relative(row.conditions[0].normal, exact) < 1e-14, "{row:?}");
    }
    let sine = r#"{ mean = "5 MPa", amplitude = "0.5 MPa", period = "30 s" }"#;
    let (_, rows) = completed(&stable("\"1 um/s\"", sine, ""));
    for row in &rows {
        let exact = 5e6 + 5e5 * (std::f64::consts::TAU * row.time / 30.0).sin();
        assert!(relative(row.conditions[0].normal, exact) < 1e-13, "{row:?}");
    }
}

#[test]
fn a_run_that_is_watched_is_the_same_to_the_bit() {
    let inertial = varied(
        CYCLE,
        &[
            Without("sliders.block.damping"),
            Add("sliders.block.mass", "3000 kg/m^2"),
            With("events.stop_after", "1"),
        ],
    );
    for text in [CYCLE, &inertial, COUPLED] {
        for method in Method::ALL {
            let mut plan = plan(text);
            if text == inertial && !method.implicit() {
                continue;
            }
            (plan.method, plan.tolerance, plan.most_events) = (method, 1e-5, Some(1));
            let blind = run(&plan, &mut ()).unwrap();
            let (seen, rows) = watched(&plan);
            assert!(rows.len() > 100, "{}", method.name());
            assert_eq!(bits(&blind.unknowns), bits(&seen.unknowns), "{}", method.name());
            assert_eq!((blind.at, blind.outcome), (seen.at, seen.outcome), "{}", method.name());
            assert_eq!(blind.catalogue, seen.catalogue, "{}", method.name());
            assert_eq!(blind.counts.steps, seen.counts.steps, "{}", method.name());
        }
    }
}

#[test]
fn several_observers_see_the_same_rows_and_any_of_them_ends_the_run() {
    let plan = plan(COUPLED);
    let (_, rows) = watched(&plan);
    let (mut first, mut second) = (0, Vec::new());
    {
        let mut count = |_: &SliderState<'_>| first += 1;
        let mut look = |now: &SliderState<'_>| second.push(now.at.seconds());
        run(&plan, &mut Observers(vec![&mut count, &mut look])).unwrap();
    }
    assert_eq!(first, rows.len());
    assert_eq!(second, rows.iter().map(|row| row.time).collect::<Vec<_>>());
    let mut left = 5;
    let mut stop = |_: &SliderState<'_>| {
        left -= 1;
        if left == 0 { Control::Stop } else { Control::Go }
    };
    let ended = run(&plan, &mut Observers(vec![&mut (), &mut stop])).unwrap();
    assert_eq!(ended.outcome, Outcome::Stopped);
    assert!(ended.at.seconds() < rows[rows.len() / 2].time, "at the end of a step");
}

fn strength() -> Strength {
    Strength { form: Form::Regularised, mu0: 0.6, a: 0.01, v_ref: 1e-6, heat: None }
}

fn state_law(name: &'static str, own: Vec<Option<f64>>) -> LawChoice {
    let evolution = Evolution { name, own };
    LawChoice::RateAndState {
        strength: strength(),
        evolution,
        states: vec![State { b: 0.015, l: 1e-5, alpha: 0.0 }],
        v_initial: 1e-6,
        normal_initial: None,
        f_limit: None,
    }
}

fn block(choice: &LawChoice, stiffness: f64, normal: History) -> Slider {
    let law = laws::build_sliding(choice).unwrap().unwrap();
    Slider { law, stiffness, damping: 5e6, mass: None, normal }
}

/// The states of a slider that was steady at 1 um/s.
fn steady(system: &System, slider: usize) -> Vec<f64> {
    let law = &system.sliders()[slider].law;
    let mut states = vec![0.0; law.states()];
    law.steady(1e-6_f64.ln(), &mut states);
    states
}

fn same(mut call: Problem, text: &str) {
    let scene = plan(text);
    assert_eq!(call.names.len(), scene.names.len());
    (call.title, call.names) = (scene.title.clone(), scene.names.clone());
    let (a, b) = (run(&call, &mut ()).unwrap(), run(&scene, &mut ()).unwrap());
    assert_eq!(bits(&call.start), bits(&scene.start));
    assert_eq!(bits(&a.unknowns), bits(&b.unknowns));
    assert_eq!((a.at, &a.outcome, &a.catalogue, a.counts), (b.at, &b.outcome, &b.catalogue, b.counts));
    assert!(!Entry::all(&a).is_empty());
}

#[test]
fn a_library_call_and_a_scene_of_one_slider_give_the_same_bits() {
    let slider = block(&state_law("ageing", vec![None]), 1.25e9, History::Constant(5e6));
    let system = System::new(vec![slider], Vec::new(), History::Constant(1e-6)).unwrap();
    let start = system.start(&[1.5e-6], &[steady(&system, 0)]).unwrap();
    let mut call = Problem::new(system, start, 4000.0);
    call.events = Some(Thresholds { on: 1e-3, off: 0.1 * 1e-3 });
    (call.most_events, call.peaks) = (Some(10), true);
    same(call, CYCLE);
}

#[test]
fn a_library_call_and_a_scene_of_two_sliders_give_the_same_bits() {
    let normal = History::sine(8e6, 1e6, 70.0, 0.0).unwrap();
    let rate = LawChoice::Rate { strength: strength(), f_limit: None };
    let sliders = vec![
        block(&state_law("slip", Vec::new()), 1.25e9, History::Constant(5e6)),
        block(&rate, 0.0, normal),
    ];
    let springs = vec![Spring { between: [0, 1], stiffness: 0.5e9 }];
    let system = System::new(sliders, springs, History::Constant(1e-6)).unwrap();
    let start = system.start(&[1.5e-6, 1e-6], &[steady(&system, 0), steady(&system, 1)]).unwrap();
    let mut call = Problem::new(system, start, 900.0);
    call.tolerance = 1e-9;
    call.events = Some(Thresholds { on: 1e-4, off: 2e-5 });
    call.peaks = true;
    same(call, COUPLED);
}

#[test]
fn the_method_is_the_default_unless_the_scene_says_otherwise() {
    assert_eq!(plan(CYCLE).method, DEFAULT_METHOD);
    assert_eq!(plan(&varied(CYCLE, &[Add("time.method", "bdf")])).method, Method::Bdf);
}

#[test]
fn a_slider_with_little_mass_is_nearly_one_without() {
    let heavy = |mass: &str| {
        let text =
            stable("{ mean = \"1 um/s\", amplitude = \"0.5 um/s\", period = \"20 s\" }", "\"5 MPa\"", mass);
        completed(&text).0.unknowns
    };
    let (without, little, less) = (heavy(""), heavy("mass = 3000"), heavy("mass = 300"));
    // The difference is proportional to the mass.
    let [far, near] = [little, less].map(|with| (with[0] - without[0]).abs());
    assert!(far < 1e-3 && near < 0.2 * far + 1e-7, "{far:e} {near:e}");
}

/// A slider with a mass that an event leaves at 1e-17 m/s and less.
fn inertial(law: &str, stiffness: &str, mass: &str, method: &str) -> String {
    format!(
        r#"
schema = 1
title = "inertial"
kinematics = "spring-slider"
[load]
rate = "1e-9 m/s"
[sliders.block]
normal = "50 MPa"
stiffness = "{stiffness}"
mass = "{mass}"
law = {{ kind = "rate-and-state", {law}, mu0 = 0.6, b = 0.015, l = "8 mm", v_ref = "1 um/s", v_initial = "1e-9 m/s" }}
start = "1.5e-9 m/s"
[time]
end = "1e12 s"
method = "{method}"
[events]
above = "1 mm/s"
stop_after = 3
"#
    )
}

#[test]
fn inertial_sliders_come_to_rest_and_start_again() {
    for (law, stiffness, mass) in [
        // The slider comes to rest within 1e-22 s of an event that is 8e8 s after the start.
        ("form = \"regularised\", evolution = \"slip\", a = 0.006", "28.125 MPa/m", "71.24 kg/m^2"),
        // Some steps are at the limit of the stability region, others within it.
        ("form = \"regularised\", evolution = \"slip\", a = 0.010", "6.25 MPa/m", "1.5e5 kg/m^2"),
        // V = 1e-66 m/s between events.
        ("form = \"bare\", evolution = \"ageing\", a = 0.0045", "3.28125 MPa/m", "2e6 kg/m^2"),
    ] {
        let last = |method: &str, tolerance: f64| {
            let mut plan = plan(&inertial(law, stiffness, mass, method));
            plan.tolerance = tolerance;
            plan.most_steps = 100_000;
            let run = run(&plan, &mut ()).unwrap();
            assert_eq!(run.outcome, Outcome::Stopped, "{law} {method}: {:?}", run.counts);
            Entry::from_slider(&run, 0).into_iter().nth(2).unwrap().interval.unwrap()
        };
        // Radau's method and that of the library share nothing but the equations.
        let reference = last("radau5", 1e-10);
        for (method, tolerance, bound) in [
            ("switching", 1e-8, 1e-8),
            ("switching", 1e-12, 1e-8),
            ("radau5", 1e-11, 1e-8),
            ("esdirk34", 1e-8, 1e-6),
        ] {
            let error = relative(last(method, tolerance), reference);
            assert!(error < bound, "{law} {method} at {tolerance:e}: {error:e}");
        }
    }
}

#[test]
fn a_method_that_begins_anew_at_each_extreme_says_what_to_take_instead() {
    let law = "form = \"bare\", evolution = \"ageing\", a = 0.006";
    let text = varied(
        &inertial(law, "2.8125 MPa/m", "71.24 kg/m^2", "bdf"),
        &[
            With("load.rate", "1e-7 m/s"),
            With("sliders.block.law.v_initial", "1e-7 m/s"),
            With("sliders.block.start", "1.5e-7 m/s"),
        ],
    );
    let mut plan = plan(&text);
    // Rounding decides if it stalls; this few steps are not enough in any case.
    (plan.tolerance, plan.most_steps) = (1e-7, 500);
    let hint = run(&plan, &mut ()).unwrap().progress.hint.unwrap();
    assert!(hint.contains("500 steps") && hint.contains("take `method = \"switching\"`"), "{hint}");
    (plan.peaks, plan.most_steps) = (false, 100_000);
    assert_eq!(run(&plan, &mut ()).unwrap().outcome, Outcome::Stopped);
    (plan.peaks, plan.method) = (true, DEFAULT_METHOD);
    assert_eq!(run(&plan, &mut ()).unwrap().outcome, Outcome::Stopped);
}

#[test]
fn a_form_without_a_value_at_rest_ends_where_friction_does() {
    let (bare, cut_off) = (
        [Add("sliders.block.law.form", "bare")],
        [Add("sliders.block.law.form", "cut-off"), Add("sliders.block.law.v_cut", "1 cm/s")],
    );
    for form in [&bare[..], &cut_off] {
        for mass in ["", "mass = \"2000 kg/m^2\""] {
            for method in ["switching", "radau5"] {
                let reversed =
                    "{ table = [[\"0 s\", \"1 um/s\"], [\"10 s\", \"1 um/s\"], [\"10 s\", \"-10 um/s\"]] }";
                let text = stable(reversed, "\"5 MPa\"", &format!("damping = \"5 MPa s/m\"\n{mass}"));
                let text = varied(&varied(&text, form), &[Add("time.method", method)]);
                let plan = plan(&text);
                let run = run(&plan, &mut ()).unwrap();
                let what = format!("{form:?} {mass} {method}: {:?} {:?}", run.outcome, run.progress.hint);
                assert_eq!(run.outcome, Outcome::Failed { reason: Failure::Ends }, "{what}");
                assert!(run.progress.hint.unwrap().contains("friction of `block` falls to zero"), "{what}");
                // 0.5 to 0.6 f_n over k at 10 um/s.
                assert!((55.0..75.0).contains(&run.at.seconds()), "{what} {:?}", run.at);
            }
        }
    }
}

/// Errors of a scene that is refused.
fn refused(text: &str) -> String {
    asperity_plan::sliders::planner::read(text).unwrap_err().to_string()
}

#[test]
fn rows_at_intervals_are_as_many_as_a_table_can_have_and_few_in_a_step() {
    let text = stable("\"1 um/s\"", "\"5 MPa\"", "");
    let told = refused(&varied(&text, &[Add("output", "{ interval = 1e-9 }")]));
    assert!(told.contains("3.0e11 rows"), "{told}");
    // Steps of steady sliding would be as long as the run: rows are in memory until the end of their step.
    let (run, rows) = completed(&varied(&text, &[Add("output", "{ interval = 1e-3 }")]));
    assert!(run.counts.steps >= 300, "{} steps", run.counts.steps);
    assert!(rows.len() >= 300_001, "{} rows", rows.len());
}

#[test]
fn a_table_that_begins_after_the_run_is_refused() {
    let late = r#"{ table = [["400 s", "5 MPa"], ["500 s", "6 MPa"]] }"#;
    let told = refused(&stable("\"1 um/s\"", late, ""));
    assert!(told.contains("the table of `normal` begins at 400.0 s, and the run ends at 300.0 s"), "{told}");
}
