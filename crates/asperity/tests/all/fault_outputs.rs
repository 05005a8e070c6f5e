//! Output files of faults through cycles: their required content, and limits of their growth.
#![allow(clippy::disallowed_methods)]

use crate::common::cycles::SCENE;
use crate::common::varied;
use asperity::kinds::faults::{Files, Position, Report, sheet};
use asperity_cycles::{FaultRun, Faults, Moment, Rupture};
use asperity_ode::Control;
use asperity_output::figures::{EventPanel, FigureRequest};
use asperity_plan::faults::Plan;
use asperity_plan::reading::scene;
use asperity_plan::{ScenePlan, plan_scene};
use asperity_run::{Event, ObserveError, Observer};
use asperity_vary::Change::{Add, With, WithOrSame};
use std::fs;
use std::path::Path;

fn plan(text: &str) -> Plan {
    match plan_scene(&scene::read(text).unwrap()).unwrap() {
        ScenePlan::Faults(plan) => *plan,
        ScenePlan::Bodies(_) | ScenePlan::Dynamic(_) => panic!("the scene has faults"),
    }
}

/// Writes the files of a run and remembers the largest rates of all steps: of the fastest point, then of each station.
struct RateWatch<'a> {
    files: Files<'a>,
    stations: Vec<usize>,
    largest: Vec<f64>,
    steps: usize,
    sizes: Vec<usize>,
}

impl Observer<Faults> for RateWatch<'_> {
    fn step(&mut self, moment: &Moment<'_>) -> Result<Control, ObserveError> {
        self.steps += 1;
        let rates = std::iter::once(moment.largest).chain(self.stations.iter().map(|&p| moment.speed(p)));
        self.largest.iter_mut().zip(rates).for_each(|(most, rate)| *most = most.max(rate));
        self.files.step(moment)
    }

    fn pause(&mut self, _: &mut dyn FnMut() -> FaultRun) -> Result<Option<&'static str>, ObserveError> {
        // The state of the files in a checkpoint is all that they keep in memory.
        self.sizes.push(serde_json::to_string::<Position>(&self.files.position()).unwrap().len());
        Ok(None)
    }
}

fn run<'a>(plan: &'a Plan, out: &Path) -> (RateWatch<'a>, FaultRun) {
    let stations: Vec<usize> = plan.faults[0].stations.iter().map(|s| s.1).collect();
    let largest = vec![0.0; stations.len() + 1];
    let files = Files::create(out, plan).unwrap();
    let mut seen = RateWatch { files, stations, largest, steps: 0, sizes: Vec::new() };
    let (problem, begin) = (&plan.problem, plan.begin());
    let run = problem.resume(begin, &problem.settings, None, &mut seen).unwrap();
    (seen, run)
}

/// Times \[s\] and slip rates \[m/s\] of a file.
fn rates(path: &Path, column: usize) -> Vec<[f64; 2]> {
    let text = fs::read_to_string(path).unwrap();
    let rows = text.lines().map(|l| l.split([',', ' ']).map(|v| v.parse().unwrap_or(f64::NAN)).collect());
    let rows = rows.map(|row: Vec<f64>| row);
    let rows = rows.filter(|row| row.len() > column && row[0].is_finite() && row[column].is_finite());
    rows.map(|row| [row[0], 10f64.powf(row[column])]).collect()
}

fn sizes(folder: &Path) -> Vec<u64> {
    let files = fs::read_dir(folder).unwrap().map(|e| e.unwrap());
    files.filter(|e| e.path().is_file()).map(|e| e.metadata().unwrap().len()).collect()
}

/// A laboratory block that a stage presses and the next one slides.
const PRESSED: &str = r#"
schema = 1
title = "pressed"
kinematics = "plane-strain"
[materials.granite]
young = "44.8 GPa"
poisson = 0.12
density = 2700
[bodies.A]
material = "granite"
mesh.block = { min = [0, 0], max = ["25 mm", "50 mm"], size = "5 mm", element = "quad4" }
[bodies.B]
material = "granite"
mesh.block = { min = ["25 mm", 0], max = ["50 mm", "50 mm"], size = "5 mm", element = "quad4" }
[faults.face]
minus = "A.right"
plus = "B.left"
law = { kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.005, b = 0.020, l = "2 um", v_ref = "1 um/s", v_initial = "1.3 um/s" }
rate = "-1 um/s"
damping = "radiation"
[[stages]]
name = "press"
duration = "10 s"
frictionless = ["face"]
conditions = [{ set = "A.left", x = { to = "0.0966 mm" } }, { set = "A.bottom", y = 0 }, { set = "B.right", x = 0 }, { set = "B.top", y = 0 }]
[[stages]]
name = "slide"
duration = "10 s"
conditions = [{ set = "B.top", y = { rate = "-1 um/s" } }]
[time]
stepper = "fault-ode"
[output]
stations.face = ["1 mm", "25 mm"]
"#;

#[test]
fn a_fault_at_rest_has_the_least_slip_rate_in_all_tables() {
    let (plan, folder) = (plan(PRESSED), tempfile::tempdir().unwrap());
    drop(run(&plan, folder.path()));
    let tables = ["largest_rate.csv", "rate_profiles.csv", "stations/face_000", "stations/face_001"];
    for name in tables {
        let text = fs::read_to_string(folder.path().join(name)).unwrap();
        assert!(!text.contains("inf"), "{name}: {text}");
        assert!(text.contains("-20."), "{name}: {text}");
    }
}

#[test]
fn every_peak_stands_in_the_files_and_rows_come_by_change() {
    let (plan, folder) = (plan(SCENE), tempfile::tempdir().unwrap());
    let (seen, run) = run(&plan, folder.path());
    assert_eq!(run.events().len(), 3);
    let mut all = vec![rates(&folder.path().join("largest_rate.csv"), 1)];
    for name in ["main_dp000", "main_dp075", "main_dp150"] {
        all.push(rates(&folder.path().join("stations").join(name), 2));
    }
    for (rows, &largest) in all.iter().zip(&seen.largest) {
        let found = rows.iter().map(|r| r[1]).fold(0.0, f64::max);
        // An extremum within half a per cent of the previous row gets no row.
        assert!(found <= largest * (1.0 + 1e-5) && found > 0.995 * largest, "{found} {largest}");
        assert!(rows.windows(2).all(|w| w[0][0] < w[1][0]));
        assert!(rows.len() > 300 && rows.len() < seen.steps, "{} of {}", rows.len(), seen.steps);
    }
    for event in run.events() {
        let (onset, end) = (event.onset.seconds(), event.end.unwrap().seconds());
        let rows: Vec<_> = all[0].iter().filter(|r| (onset..=end).contains(&r[0])).collect();
        let found = rows.iter().map(|r| r[1]).fold(0.0, f64::max);
        assert!((found / event.peak - 1.0).abs() < 0.005, "{found} {}", event.peak);
    }
    // Numbers have more digits in some states than in others, but there are no more of them.
    let (early, late) = seen.sizes.split_at(seen.sizes.len() / 2);
    let [early, late] = [early, late].map(|sizes| *sizes.iter().max().unwrap());
    assert!(late as f64 <= 1.1 * early as f64, "what files keep in memory grows: {early} {late}");
}

#[test]
fn rows_do_not_follow_steps_where_events_begin_at_slow_rates() {
    let folder = tempfile::tempdir().unwrap();
    let count = |above: &str, name: &str| {
        // Four hundred years, with the first events.
        let changes = [
            WithOrSame("events.above", above),
            With("stages[0].duration", "400 yr"),
            With("events.stop_after", "1000"),
        ];
        let plan = plan(&varied(SCENE, &changes));
        let out = folder.path().join(name);
        fs::create_dir(&out).unwrap();
        let (seen, _) = run(&plan, &out);
        let profiles = fs::read_to_string(out.join("slip_profiles.csv")).unwrap().lines().count();
        (rates(&out.join("largest_rate.csv"), 1).len() as f64, profiles as f64, seen.steps as f64)
    };
    let (rows, _, _) = count("1e-3 m/s", "fast");
    let (slow, profiles, steps) = count("1.2e-9 m/s", "slow");
    // The times of rows do not depend on the thresholds of events.
    assert!((slow / rows - 1.0).abs() < 0.1, "{slow} {rows}");
    assert!(profiles < 0.25 * steps, "{profiles} profiles of {steps} steps");
}

#[test]
fn files_stay_below_their_largest_size_and_the_run_says_so() {
    let text = varied(SCENE, &[Add("output.largest_file", "20 kB")]);
    let (plan, folder) = (plan(&text), tempfile::tempdir().unwrap());
    let (seen, run) = run(&plan, folder.path());
    for size in sizes(folder.path()).into_iter().chain(sizes(&folder.path().join("stations"))) {
        assert!((1000..=20_000).contains(&size), "{size}");
    }
    let warning = seen.files.warning().unwrap();
    assert!(
        warning.message.contains("beyond half of `largest_file` (0.02") && warning.help.is_some(),
        "{warning}"
    );
    // The last rows are near the end of the run.
    let rows = rates(&folder.path().join("largest_rate.csv"), 1);
    assert!(rows[rows.len() - 1][0] > 0.5 * run.at.seconds());
    // Plots are drawn from files of any length.
    let panel = EventPanel { title: String::new(), start: 0.0, end: 0.0, groups: Vec::new() };
    let drawn = sheet(&plan, &run, panel).draw(
        folder.path(),
        &folder.path().join("plots"),
        &FigureRequest::default(),
    );
    assert_eq!(drawn.unwrap().len(), 28);
}

#[test]
fn no_number_of_the_files_is_minus_zero() {
    let (plan, folder) =
        (plan(&varied(SCENE, &[With("events.stop_after", "1")])), tempfile::tempdir().unwrap());
    run(&plan, folder.path());
    let mut files =
        vec!["largest_rate.csv".to_string(), "slip_profiles.csv".into(), "rate_profiles.csv".into()];
    files.extend(["main_dp000", "main_dp075", "main_dp150"].map(|name| format!("stations/{name}")));
    for file in files {
        let text = fs::read_to_string(folder.path().join(&file)).unwrap();
        for word in text.split([' ', ',', '\n']).filter(|w| w.starts_with('-')) {
            assert!(word.parse::<f64>().is_ok_and(|v| v != 0.0), "{word} in {file}");
        }
    }
}

#[test]
fn time_above_the_rate_does_not_depend_on_the_rate_that_ends_events() {
    let folder = tempfile::tempdir().unwrap();
    let of = |below: &str, name: &str| -> Vec<Event<Rupture>> {
        let plan = plan(&varied(SCENE, &[Add("events.below", below)]));
        fs::create_dir(folder.path().join(name)).unwrap();
        run(&plan, &folder.path().join(name)).1.events().to_vec()
    };
    let (wide, narrow) = (of("1e-4 m/s", "wide"), of("0.9999e-3 m/s", "narrow"));
    for (w, n) in wide.iter().zip(&narrow) {
        let whole = |e: &Event<Rupture>| e.duration().unwrap();
        // With the same rate for both thresholds, the duration would be the time above it; here they differ by a
        // ten-thousandth.
        assert!((n.details.above / whole(n) - 1.0).abs() < 1e-3, "{} {}", n.details.above, whole(n));
        assert!(
            (w.details.above / n.details.above - 1.0).abs() < 1e-3,
            "{} {}",
            w.details.above,
            n.details.above
        );
        assert!(whole(w) > 1.5 * w.details.above, "{} {}", whole(w), w.details.above);
    }
}

/// Pairs of blocks without elastic connection: characteristic slip \[m\] and half width \[m\] determine when each slips.
fn pairs(which: &[(&str, f64, f64)]) -> String {
    let head = SCENE.split("[bodies.crust]").next().unwrap();
    let (mut bodies, mut faults, mut sides) = (String::new(), String::new(), String::new());
    for (name, l, half) in which {
        let foot = if *name == "P" { -1e5 } else { -2e5 };
        for (side, from, to) in [("l", -half, 0.0), ("r", 0.0, *half)] {
            let top = foot + 1000.0;
            bodies += &format!(
                "[bodies.{name}{side}]\nmaterial = \"rock\"\nmesh.block = {{ min = [{from}, {foot}], max = [{to}, {top}], divisions = [1, 1], element = \"quad4\" }}\n"
            );
        }
        faults += &format!(
            "[faults.{name}]\nminus = \"{name}l.right\"\nplus = \"{name}r.left\"\nlaw = {{ kind = \"rate-and-state\", evolution = \"ageing\", mu0 = 0.6, a = 0.010, b = 0.015, l = {l}, v_ref = \"1 um/s\", v_initial = \"1e-9 m/s\" }}\nnormal = \"50 MPa\"\nunder_resolved = \"allow\"\nrate = \"1.1e-9 m/s\"\ndamping = \"radiation\"\n"
        );
        sides += &format!(
            "{{ set = \"{name}l.left\", z = {{ rate = -0.5e-9 }} }}, {{ set = \"{name}r.right\", z = {{ rate = 0.5e-9 }} }}, "
        );
    }
    format!(
        "{head}{bodies}{faults}[[stages]]\nname = \"cycles\"\nduration = \"150 yr\"\nconditions = [{sides}]\n[time]\nstepper = \"fault-ode\"\nlog_rate_tolerance = 1e-7\n[events]\nabove = \"1e-4 m/s\"\n"
    )
}

#[test]
fn each_fault_of_several_has_the_catalogue_it_has_alone() {
    // Each pair slips as one: corners of pairs on shorter ways slip apart after a few events, from rounding.
    let all = [("P", 0.017, 2000.0), ("Q", 0.013, 1600.0)];
    let folder = tempfile::tempdir().unwrap();
    let both = plan(&pairs(&all));
    let out = folder.path().join("both");
    fs::create_dir(&out).unwrap();
    let (_, ended) = run(&both, &out);
    let mut balance = asperity_cycles::Balance::new(&both.problem);
    let report = Report::new(&both, &ended, &mut balance);
    assert_eq!(report.faults.len(), 2);
    for (fault, pair) in report.faults.iter().zip(all) {
        let alone = plan(&pairs(&[pair]));
        let out = folder.path().join(pair.0);
        fs::create_dir(&out).unwrap();
        let (_, ended) = run(&alone, &out);
        let mut balance = asperity_cycles::Balance::new(&alone.problem);
        let alone = Report::new(&alone, &ended, &mut balance);
        assert!(alone.faults.is_empty());
        assert_eq!(fault.surface, pair.0);
        assert_eq!(fault.events.len(), alone.events.len());
        assert!(fault.events.len() >= 3, "{}", fault.events.len());
        for (a, b) in fault.events.iter().zip(&alone.events) {
            let near =
                |a: f64, b: f64, bound: f64| assert!((a / b - 1.0).abs() < bound, "{a} {b} of {}", pair.0);
            // The pairs are not connected elastically. The remaining differences are errors of the tolerance over a
            // cycle, and those of peaks, which are taken at the ends of steps.
            near(a.onset, b.onset, 1e-5);
            near(a.moment, b.moment, 1e-5);
            near(a.largest_slip, b.largest_slip, 1e-5);
            near(a.duration, b.duration, 1e-3);
            near(a.duration_above, b.duration_above, 1e-3);
            near(a.peak_rate, b.peak_rate, 5e-3);
            near(a.interval.unwrap_or(1.0), b.interval.unwrap_or(1.0), 1e-5);
        }
    }
    // All events together are more than those of either fault, and intervals between them belong to no single fault.
    assert!(report.events.len() > report.faults[0].events.len());
}

#[test]
fn slow_events_and_fast_ones_are_all_those_above_the_slow_rate_each_once() {
    let folder = tempfile::tempdir().unwrap();
    let report = |changes: &[asperity_vary::Change], name: &str| {
        let plan = plan(&varied(SCENE, changes));
        let out = folder.path().join(name);
        fs::create_dir(&out).unwrap();
        let (_, ended) = run(&plan, &out);
        Report::new(&plan, &ended, &mut asperity_cycles::Balance::new(&plan.problem))
    };
    // All events above 1 mm/s, and then those that become less fast than the mean of them apart from the others.
    let all = report(&[], "all").events;
    let fast = all.iter().map(|e| e.peak_rate).sum::<f64>() / all.len() as f64;
    let (above, rates) = (format!("{fast}"), ["1e-3 m/s", "1e-4 m/s"]);
    let [above, below] = [WithOrSame("events.above", &above), Add("events.below", rates[1])];
    let slow = [Add("events.slow_above", rates[0]), Add("events.slow_below", rates[1])];
    let until = [With("events.stop_after", "1000"), With("stages[0].duration", "500 yr")];
    let both = report(&[&[above, below], &slow[..], &until].concat(), "both");
    let wanted = report(&until, "longer").events;
    let wanted: Vec<_> = wanted.iter().filter(|e| e.peak_rate < fast).collect();
    let found = both.slow_events.unwrap();
    assert!(!found.is_empty() && !both.events.is_empty(), "{} {}", found.len(), both.events.len());
    assert_eq!(found.len(), wanted.len());
    for (found, wanted) in found.iter().zip(wanted) {
        assert!((found.onset - wanted.onset).abs() < 1e-6 * wanted.onset, "{found:?} {wanted:?}");
        assert!((found.peak_rate / wanted.peak_rate - 1.0).abs() < 1e-3 && found.peak_rate < fast);
    }
    // No slow event overlaps with a fast one.
    for slow in &found {
        let apart = |fast: &asperity::catalogue::Entry| {
            slow.onset + slow.duration <= fast.onset || fast.onset + fast.duration <= slow.onset
        };
        assert!(both.events.iter().all(apart), "{slow:?}");
    }
}
