//! Reports of runs of spring-sliders: events of both directions, rows at times and at peaks, imposed slip rates, stability.

use crate::common::sliders::{CYCLE, history, plan, planned, relative, written};
use crate::common::{plain_evolutions, varied};
use asperity::kinds::sliders::{Entry, NamedEvent, csv};
use asperity_cycles::slider::{SliderState, Stability, critical_stiffness, run};
use asperity_ode::Method;
use asperity_vary::Change::{Add, With, Without};
use nalgebra::DMatrix;

const MU0: f64 = 0.6;
const A: f64 = 0.01;
const V_REF: f64 = 1e-6;
const L: f64 = 1e-5;

fn law(evolution: &str, b: f64) -> String {
    law_with(evolution, &b.to_string(), "\"10 um\"", "")
}

/// A law of one state or several, with more parameters.
fn law_with(evolution: &str, b: &str, l: &str, more: &str) -> String {
    format!(
        "{{ kind = \"rate-and-state\", evolution = \"{evolution}\", mu0 = 0.6, a = 0.01, b = {b}, l = {l}, v_ref = \"1 um/s\", v_initial = \"1 um/s\"{more} }}"
    )
}

/// A slider with these lines in its table, and with these tables.
fn scene(load: &str, slider: &str, law: &str, rest: &str) -> String {
    format!(
        "schema = 1\ntitle = \"t\"\nkinematics = \"spring-slider\"\n{load}\n[sliders.block]\nnormal = \"5 MPa\"\n{slider}\nlaw = {law}\n{rest}\n"
    )
}

fn rows(text: &str) -> Vec<Vec<f64>> {
    let (folder, _) = written(&plan(text));
    history(folder.path(), "block.csv")
}

/// A load that moves back and forth, beginning in the direction of `sign`.
fn reversing(sign: &str) -> String {
    let load = format!("[load]\nrate = {{ mean = 0.0, amplitude = \"{sign}20 um/s\", period = \"1000 s\" }}");
    let slider = format!("stiffness = \"1.25 GPa/m\"\ndamping = \"5 MPa s/m\"\nstart = \"{sign}1 um/s\"");
    scene(&load, &slider, &law("ageing", 0.015), "[time]\nend = \"2000 s\"\n[events]\nabove = \"1 mm/s\"")
}

#[test]
fn the_mirrored_problem_has_the_mirrored_catalogue() {
    let backwards = varied(CYCLE, &[With("load.rate", "-1 um/s"), With("sliders.block.start", "-1.5 um/s")]);
    for (there, back) in [(CYCLE.to_string(), backwards), (reversing(""), reversing("-"))] {
        let [there, back] = [there, back].map(|t| Entry::all(&run(&plan(&t), &mut ()).unwrap()));
        assert!(there.len() >= 10 && there.len() == back.len(), "{} and {}", there.len(), back.len());
        for (e, m) in there.iter().zip(&back) {
            assert_eq!(e.direction, -m.direction);
            assert!(relative(e.onset, m.onset) < 1e-12, "{e:?} {m:?}");
            let pairs = [
                (e.peak_rate, m.peak_rate),
                (e.slip.unwrap(), -m.slip.unwrap()),
                (e.stress_drop.unwrap(), m.stress_drop.unwrap()),
                (e.at_onset.friction, -m.at_onset.friction),
            ];
            assert!(pairs.iter().all(|p| relative(p.0, p.1) < 1e-9), "{e:?} {m:?}");
            assert!(e.stress_drop.unwrap() > 0.0 && e.slip.unwrap() * f64::from(e.direction) > 0.0, "{e:?}");
        }
    }
}

#[test]
fn every_rise_through_the_threshold_is_an_event_whichever_way() {
    let mut rates = Vec::new();
    let mut look = |now: &SliderState<'_>| rates.push(now.conditions[0].rate);
    let found = Entry::all(&run(&plan(&reversing("")), &mut look).unwrap());
    for way in [1.0, -1.0] {
        // From below a tenth of the threshold to above it, seen at the steps.
        let (mut count, mut armed) = (0, true);
        for rate in rates.iter().map(|r| r * way) {
            if armed && rate > 1.001e-3 {
                (count, armed) = (count + 1, false);
            }
            armed |= rate < 0.99e-4;
        }
        let events = found.iter().filter(|e| f64::from(e.direction) == way).count();
        assert!(count >= 10 && events == count, "{way}: {events} events, {count} rises");
    }
    // Between events of different directions the slider was at rest at one instant.
    for w in found.windows(2).filter(|w| w[0].direction != w[1].direction) {
        assert_eq!(w[1].least_rate, 0.0, "{:?}", w[1]);
    }
}

/// mu of the regularised form.
fn friction(rate: f64, phi: f64) -> f64 {
    A * (rate / (2.0 * V_REF) * ((MU0 + phi) / A).exp()).asinh()
}

#[test]
fn stress_drop_and_states_of_events_are_those_of_spring_and_law() {
    let events = Entry::all(&run(&plan(CYCLE), &mut ()).unwrap());
    assert_eq!(events.len(), 10);
    for e in &events {
        // The traction of the spring drops by k times the slip of the slider relative to the load point.
        let exact = 1.25e9 * (e.slip.unwrap() - 1e-6 * e.duration.unwrap());
        assert!(relative(e.stress_drop.unwrap(), exact) < 1e-9, "{e:?}");
        for (edge, rate) in [(&e.at_onset, 1e-3), (e.at_end.as_ref().unwrap(), 1e-4)] {
            // Thresholds are located to the rounding of ln V = m - (mu0 + phi)/a, with terms of some sixty.
            assert!(relative(edge.friction, friction(rate, 0.015 * edge.states[0])) < 1e-12, "{edge:?}");
            assert!(relative(edge.traction, 5e6 * edge.friction + 5e6 * rate) < 1e-9, "{edge:?}");
        }
    }
}

#[test]
fn events_as_csv_have_a_field_for_each_column() {
    let plan = plan(CYCLE);
    let events = NamedEvent::all(&run(&plan, &mut ()).unwrap(), &["a, \"b\"".to_string()]);
    let text = csv(&events);
    let mut lines = text.lines();
    let head: Vec<&str> = lines.next().unwrap().split(',').collect();
    assert_eq!(head.len(), 16);
    for (line, NamedEvent { entry: e, .. }) in lines.zip(&events) {
        assert_eq!(line.matches("\"a, \"\"b\"\"\"").count(), 1, "{line}");
        // The name has a comma of its own.
        let fields: Vec<Option<f64>> = line.split(',').map(|v| v.parse().ok()).collect();
        assert_eq!(fields.len(), head.len() + 1);
        assert_eq!((fields[2], fields[4], fields[9]), (e.interval, e.stress_drop, e.slip));
        assert!(relative(fields[7].unwrap(), e.onset + e.duration.unwrap()) < 1e-14, "{line}");
        assert_eq!(fields[8], Some(1.0));
        assert_eq!(fields[16], Some(e.at_end.as_ref().unwrap().states[0]));
    }
    assert_eq!(text.lines().count(), 11);
}

#[test]
fn rows_stand_on_the_peaks() {
    let (folder, run) = written(&plan(CYCLE));
    let rows = history(folder.path(), "block.csv");
    let events = Entry::all(&run);
    let last = events.last().unwrap();
    let within = |r: &&Vec<f64>| r[0] >= last.onset - last.interval.unwrap() && r[0] >= events[8].onset + 1.0;
    let seen = rows.iter().filter(within).map(|r| r[3]);
    let (largest, least) = (seen.clone().fold(0.0, f64::max), seen.fold(f64::INFINITY, f64::min));
    // verification/independent/spring_slider.json, mild_ageing
    assert!(relative(largest, 0.044_971_867_774) < 1e-7, "{largest:e}");
    assert!(relative(least, 2.225_947_927_5e-9) < 1e-7, "{least:e}");
    assert_eq!(largest, last.peak_rate);
}

const TIMES: [f64; 6] = [0.0, 0.3, 7.0, 100.0, 299.9, 300.0];

#[test]
fn rows_stand_at_the_times_asked_for_with_the_digits_of_the_method() {
    let load = "[load]\nrate = { mean = \"1 um/s\", amplitude = \"0.5 um/s\", period = \"20 s\" }";
    let base = scene(load, "stiffness = \"5 GPa/m\"", &law("ageing", 0.015), "");
    for method in [Method::Switching, Method::Dop853, Method::Tsit5, Method::Radau5] {
        let asked = format!(
            "{base}[time]\nend = \"300 s\"\ntolerance = 1e-9\nmethod = \"{}\"\n[output]\ntimes = {TIMES:?}\n",
            method.name()
        );
        let rows = rows(&asked);
        assert_eq!(rows.iter().map(|r| r[0]).collect::<Vec<_>>(), TIMES, "{}", method.name());
        for row in &rows[1..] {
            // A run that ends there does not interpolate.
            let mut until = plan(&format!("{base}[time]\nend = \"{} s\"\ntolerance = 1e-13\n", row[0]));
            until.method = Method::Dop853;
            let end = run(&until, &mut ()).unwrap();
            let exact =
                until.system.sliders()[0].law.slip(until.system.slider_unknowns(0, &end.unknowns)).0.rate;
            // The dense output is of the order of the error estimate or higher: errors of a step, and few steps in the memory L/V.
            assert!((row[3] / exact).ln().abs() < 1e-7, "{} {row:?} {exact:e}", method.name());
        }
    }
}

/// Largest error of ln V in rows of a run \[-\], against a run with a tolerance of 1e-12 that has rows at the same times.
fn error(problem: &asperity_cycles::slider::Problem, asked: bool) -> f64 {
    let mut found = Vec::new();
    let mut look = |now: &SliderState<'_>| {
        if now.asked == asked && now.at.seconds() > 0.0 {
            found.push((now.at.seconds(), now.conditions[0].rate));
        }
    };
    run(problem, &mut look).unwrap();
    let mut exact = problem.clone();
    (exact.tolerance, exact.method) = (1e-12, Method::Dop853);
    exact.output.times = found.iter().map(|row| row.0).collect();
    exact.output.interval = None;
    let mut rates = Vec::new();
    let mut look = |now: &SliderState<'_>| {
        if now.asked && now.at.seconds() > 0.0 {
            rates.push(now.conditions[0].rate);
        }
    };
    run(&exact, &mut look).unwrap();
    assert_eq!(rates.len(), found.len());
    found.iter().zip(&rates).map(|((_, rate), exact)| (rate / exact).ln().abs()).fold(0.0, f64::max)
}

#[test]
fn rows_asked_for_are_as_accurate_as_the_steps_between_which_they_stand() {
    let load = "[load]\nrate = { mean = \"1 um/s\", amplitude = \"0.5 um/s\", period = \"20 s\" }";
    let rest = "[time]\nend = \"100 s\"\ntolerance = 1e-6\n[output]\ninterval = \"0.37 s\"";
    let base = plan(&scene(load, "stiffness = \"5 GPa/m\"", &law("ageing", 0.015), rest));
    for method in [Method::Switching, Method::Dop853, Method::Tsit5, Method::Radau5] {
        let problem = asperity_cycles::slider::Problem { method, ..base.clone() };
        let (rows, steps) = (error(&problem, true), error(&problem, false));
        assert!(rows < 2.0 * steps, "{}: {rows:e} in rows, {steps:e} at steps", method.name());
    }
}

#[test]
fn a_tolerance_near_rounding_does_not_hide_that_a_slider_is_stiff() {
    let load =
        "[load]\nrate = { table = [[\"0 s\", \"1 um/s\"], [\"1 s\", \"1 um/s\"], [\"1 s\", \"10 um/s\"]] }";
    let steps = |tolerance: &str| {
        let rest = format!("[time]\nend = \"2 s\"\ntolerance = {tolerance}\nmost_steps = 100000");
        let planned = planned(&scene(load, "stiffness = 1e16", &law("ageing", 0.015), &rest));
        (run(&planned.problem, &mut ()).unwrap().counts.steps, planned.warnings)
    };
    let ((loose, unwarned), (tight, warned)) = (steps("1e-11"), steps("1e-13"));
    // The error of the stiff method is of order 5: a hundredth of the tolerance takes 2.5 times the steps, and that of order 3 of its
    // estimate 4.6 times.
    assert!(tight < 10 * loose, "{loose} and {tight}");
    assert!(unwarned.is_empty() && warned[0].to_string().contains("digits"), "{warned:?}");
}

#[test]
fn rows_at_intervals_begin_at_zero_and_need_no_events() {
    let changes =
        [Add("output", "{ interval = \"12.5 s\" }"), Without("events.stop_after"), With("time.end", "400 s")];
    let rows = rows(&varied(CYCLE, &changes));
    let exact: Vec<f64> = (0..=32).map(|k| 12.5 * f64::from(k)).collect();
    assert_eq!(rows.iter().map(|r| r[0]).collect::<Vec<_>>(), exact);
    let both = format!("{CYCLE}\n[output]\nchange = 0.05\ntimes = [\"200 s\"]\n");
    let rows = self::rows(&both);
    assert!(rows.len() > 1000 && rows.iter().any(|r| r[0] == 200.0));
}

#[test]
fn histories_are_thinned_or_left_out() {
    let count = |output: &str| rows(&format!("{CYCLE}\n[output]\n{output}\n")).len();
    let (fine, coarse) = (count("change = 0.05"), count("change = 0.5"));
    assert!(coarse < fine / 3, "{coarse} and {fine}");
    let other = r#"{ normal = "5 MPa", stiffness = "5 GPa/m", law = { kind = "rate", mu0 = 0.6, a = 0.01, v_ref = "1 um/s" } }"#;
    let two = varied(CYCLE, &[Add("sliders.other", other)]);
    let (folder, _) = written(&plan(&format!("{two}\n[output]\nhistories = [\"other\"]\n")));
    let names: Vec<_> =
        std::fs::read_dir(folder.path().join("history")).unwrap().map(|e| e.unwrap().file_name()).collect();
    assert_eq!(names, ["other.csv"]);
    // A slider that slides steadily next to one in stick-slip has rows by its own changes only.
    assert!(history(folder.path(), "other.csv").len() < 1100);
    let (folder, _) = written(&plan(&format!("{two}\n[output]\nhistories = false\n")));
    assert!(!folder.path().join("history").exists());
}

/// psi after a step of the slip rate at constant rate since: theta = L/V + (theta_0 - L/V) exp(-V t/L).
fn aged(psi: f64, rate: f64, time: f64) -> f64 {
    let (theta, steady) = (L / V_REF * psi.exp(), L / rate);
    (V_REF / L * (steady + (theta - steady) * (-rate * time / L).exp())).ln()
}

/// phi of the slip law likewise: phi_ss + (phi_0 - phi_ss) exp(-V t/L).
fn slipped(b: f64, phi: f64, rate: f64, time: f64) -> f64 {
    let steady = -b * (rate / V_REF).ln();
    steady + (phi - steady) * (-rate * time / L).exp()
}

#[test]
fn velocity_steps_under_an_imposed_rate_follow_the_closed_form() {
    let steps = "rate = { table = [[\"0 s\", \"1 um/s\"], [\"20 s\", \"1 um/s\"], [\"20 s\", \"10 um/s\"], [\"30 s\", \"10 um/s\"], [\"30 s\", \"0.1 um/s\"]] }";
    let rest = "[time]\nend = \"200 s\"\ntolerance = 1e-11\n[output]\ninterval = \"0.25 s\"";
    for b in [0.015, -0.005] {
        for evolution in ["ageing", "slip"] {
            let rows = rows(&scene("", steps, &law(evolution, b), rest));
            // Before and after each jump.
            assert_eq!(rows.len(), 803);
            let mut before = f64::NEG_INFINITY;
            for row in &rows {
                let phi = |from: f64, rate: f64, time: f64| match evolution {
                    "ageing" => b * aged(from / b, rate, time),
                    _ => slipped(b, from, rate, time),
                };
                let stepped = phi(0.0, 1e-5, 10.0);
                let time = row[0];
                let after = time == std::mem::replace(&mut before, time);
                let until = |end: f64| time < end || time == end && !after;
                let (rate, slip, phi) = if until(20.0) {
                    (1e-6, 1e-6 * time, 0.0)
                } else if until(30.0) {
                    (1e-5, 2e-5 + 1e-5 * (time - 20.0), phi(0.0, 1e-5, time - 20.0))
                } else {
                    (1e-7, 1.2e-4 + 1e-7 * (time - 30.0), phi(stepped, 1e-7, time - 30.0))
                };
                assert_eq!(row[3], rate, "{row:?}");
                assert!((row[2] - slip).abs() < 1e-18, "{row:?} {slip:e}");
                // States to some hundred times the tolerance.
                assert!((row[4] - friction(rate, phi)).abs() < 1e-9 * A, "{evolution} {b}: {row:?}");
                assert!(relative(row[5], 5e6 * row[4]) < 1e-12);
            }
        }
    }
}

#[test]
fn an_imposed_rate_may_turn_round() {
    let sine = "rate = { mean = 0.0, amplitude = \"5 um/s\", period = \"40 s\", start = \"-10 s\" }";
    let rest = "[time]\nend = \"100 s\"\n[output]\ninterval = \"0.3 s\"";
    let w = std::f64::consts::TAU / 40.0;
    for row in rows(&scene("", sine, &law("ageing", 0.015), rest)) {
        let rate = 5e-6 * (w * (row[0] + 10.0)).sin();
        assert!((row[3] - rate).abs() < 1e-19 && row[4] * rate >= 0.0, "{row:?}");
        let slip = 5e-6 / w * ((w * 10.0).cos() - (w * (row[0] + 10.0)).cos());
        assert!((row[2] - slip).abs() < 1e-17, "{row:?} {slip:e}");
        assert!((row[4].abs() - friction(rate.abs(), 0.015 * row[8])).abs() < 1e-12, "{row:?}");
    }
}

#[test]
fn a_slider_on_a_spring_to_an_imposed_one_is_a_slider_on_a_load_point() {
    let imposed = r#"{ normal = "1 MPa", rate = "1 um/s", law = { kind = "rate", mu0 = 0.6, a = 0.01, v_ref = "1 um/s" } }"#;
    let machine = varied(
        CYCLE,
        &[
            Without("sliders.block.stiffness"),
            Without("load"),
            Add("sliders.machine", imposed),
            Add("springs", r#"[{ between = ["block", "machine"], stiffness = "1.25 GPa/m" }]"#),
        ],
    );
    let [alone, pulled] = [CYCLE, &machine].map(|t| Entry::all(&run(&plan(t), &mut ()).unwrap()));
    assert_eq!((alone.len(), pulled.len()), (10, 10));
    for (a, p) in alone.iter().zip(&pulled) {
        // The error norm has one unknown more, so that steps differ.
        assert!(
            relative(a.onset, p.onset) < 1e-8 && relative(a.slip.unwrap(), p.slip.unwrap()) < 1e-6,
            "{a:?} {p:?}"
        );
    }
}

/// Largest growth rate of small perturbations of steady sliding [V/L], from the Jacobian of the equations.
fn growth(text: &str) -> f64 {
    let plan = plan(text);
    let n = plan.start.len();
    let mut jacobian = vec![0.0; n * n];
    plan.system.segment(0.0).jacobian(0.0, &plan.start, &mut jacobian);
    let values = DMatrix::from_column_slice(n, n, &jacobian).complex_eigenvalues();
    values.iter().map(|e| e.re).fold(f64::NEG_INFINITY, f64::max) * L / 1e-6
}

/// A law of several states.
fn states(evolution: &str, b: &str, l: &str) -> String {
    law_with(evolution, b, l, "")
}

#[test]
fn stability_at_any_stiffness_is_that_of_the_jacobian() {
    // A state that weakens over a short slip and one that strengthens over a long slip: with a mass, soft springs are
    // stable again.
    let late = states("slip", "[0.015, -0.010]", "[\"10 um\", \"1 mm\"]");
    let soon = states("slip", "[0.012, 0.003]", "[\"10 um\", \"100 um\"]");
    let laws = [late, soon, law_with("nagata", "0.015", "\"10 um\"", ", c = 0.5")];
    for (law, more) in laws.iter().flat_map(|l| [(l, ""), (l, "mass = 4e13")]) {
        let (mut seen, mut last) = (Vec::new(), true);
        for power in 0..=220 {
            let k = 1e5 * 10f64.powf(f64::from(power) / 30.0);
            let slider = format!("stiffness = {k:e}\n{more}");
            let text = scene("[load]\nrate = \"1 um/s\"", &slider, law, "[time]\nend = \"1 s\"");
            let plan = planned(&text);
            let unstable = Stability::new(&plan.problem.system.sliders()[0], 1e-6, 5e6).unstable(k);
            assert_eq!(unstable, growth(&text) > 0.0, "{law} {more} {k:e}");
            if unstable != last {
                seen.push(unstable);
                last = unstable;
            }
            let again = plan.summary().contains("stable again");
            assert_eq!(
                again,
                seen == [false] && law.contains("1 mm") && !more.is_empty(),
                "{}",
                plan.summary()
            );
        }
        let windows: &[bool] =
            if law.contains("1 mm") && !more.is_empty() { &[false, true, false] } else { &[false] };
        assert_eq!(seen, windows, "{law} {more}");
    }
}

#[test]
fn critical_stiffness_is_where_growth_changes_sign() {
    let one = |evolution, more| law_with(evolution, "0.015", "\"10 um\"", more);
    let plain = plain_evolutions().map(|evolution| law(evolution, 0.015));
    let others = [
        one("ageing", ", form = \"cut-off\", v_cut = \"3 um/s\", v_cut_state = \"20 um/s\""),
        one("flash", ", mu_w = 0.2, v_w = \"0.1 m/s\""),
        states("slip", "[0.012, 0.003]", "[\"10 um\", \"100 um\"]"),
        states("ageing", "[0.006, 0.005, 0.008]", "[\"10 um\", \"30 um\", \"15 um\"]"),
        one("nagata", ", c = 2.0"),
    ];
    let laws: Vec<String> = plain.chain(others).collect();
    // Mass for which inertia raises k_c: n = M V^2/(f_n L) of the size of a.
    for more in ["", "damping = \"1e10 Pa s/m\"", "mass = 1e11", "damping = \"1e10 Pa s/m\"\nmass = 1e11"] {
        for law in &laws {
            let at = |k: f64| {
                let slider = format!("stiffness = {k:e}\n{more}");
                scene("[load]\nrate = \"1 um/s\"", &slider, law, "[time]\nend = \"1 s\"")
            };
            let sample = plan(&at(1e9));
            let critical = critical_stiffness(&sample.system.sliders()[0], 1e-6, 5e6);
            let [below, above] = [0.999, 1.001].map(|share| growth(&at(share * critical)));
            assert!(below > 0.0 && above < 0.0, "{law} {more}: {below:e} {above:e} at {critical:e}");
        }
        let s = &plan(&scene(
            "[load]\nrate = 1e-6",
            &format!("stiffness = 1e9\n{more}"),
            &laws[0],
            "[time]\nend = 1",
        ))
        .system;
        let (eta, mass) = (s.sliders()[0].damping, s.sliders()[0].mass.unwrap_or(0.0));
        let a = A + eta * 1e-6 / 5e6;
        let exact = 5e6 / L * (0.015 - a) * (1.0 + mass * 1e-12 / (5e6 * L) / a);
        assert!(relative(critical_stiffness(&s.sliders()[0], 1e-6, 5e6), exact) < 1e-6, "{more}");
    }
}

#[test]
fn the_plan_names_the_stiffness_ratio_and_warns_of_what_runs_away() {
    let damped = planned(CYCLE);
    // k_c = f_n (b - a - eta V/f_n)/L with eta V/f_n of 1e-6.
    assert!(damped.summary().contains("k/k_c = 0.500100"), "{}", damped.summary());
    assert!(damped.warnings.is_empty() && !damped.summary().contains("note"));
    let text = CYCLE.lines().filter(|l| !l.starts_with("damping")).collect::<Vec<_>>().join("\n");
    let mut undamped = planned(&text);
    assert_eq!(undamped.warnings.len(), 1);
    asperity_scene::warning::locate(&mut undamped.warnings[0], &text);
    let place = undamped.warnings[0].place.unwrap();
    assert!(text.lines().nth(place.line - 1).unwrap().starts_with("stiffness"), "{place:?}");
    let stiff = planned(&varied(&text, &[With("sliders.block.stiffness", "2.6 GPa/m")]));
    assert!(stiff.warnings.is_empty());
    assert!(stiff.summary().contains("events come from the start alone"), "{}", stiff.summary());
}

#[test]
fn a_negative_b_is_stable_on_any_spring_and_steady_where_theory_says() {
    for evolution in plain_evolutions() {
        for power in -6..=6 {
            let slider = format!("stiffness = {:e}", 1e9 * 10f64.powi(power));
            let text =
                scene("[load]\nrate = \"1 um/s\"", &slider, &law(evolution, -0.005), "[time]\nend = \"1 s\"");
            assert!(growth(&text) < 0.0, "{evolution} at {slider}");
        }
        let load = "[load]\nrate = { table = [[\"0 s\", \"1 um/s\"], [\"10 s\", \"1 um/s\"], [\"10 s\", \"10 um/s\"]] }";
        let text = scene(load, "stiffness = \"5 GPa/m\"", &law(evolution, -0.005), "[time]\nend = \"600 s\"");
        let last = rows(&text).pop().unwrap();
        assert!((last[4] - (0.6 + 0.015 * 10f64.ln())).abs() < 1e-8, "{evolution}: {last:?}");
    }
}

#[test]
fn the_jacobian_of_a_chain_has_entries_for_sliders_and_springs_alone() {
    let chain = |n: usize| {
        let block = |i: usize| {
            format!(
                "[sliders.s{i}]\nnormal = \"5 MPa\"\nstiffness = \"0.3 GPa/m\"\ndamping = \"5 MPa s/m\"\nlaw = {}\n",
                law("ageing", 0.015)
            )
        };
        let spring = |i: usize| {
            format!("[[springs]]\nbetween = [\"s{i}\", \"s{}\"]\nstiffness = \"0.5 GPa/m\"\n", i + 1)
        };
        let head = "schema = 1\ntitle = \"t\"\nkinematics = \"spring-slider\"\n[load]\nrate = \"1 um/s\"\n";
        let blocks: String = (0..n).map(block).collect();
        let springs: String = (0..n - 1).map(spring).collect();
        plan(&format!("{head}{blocks}{springs}[time]\nend = \"1 s\"\n"))
    };
    for n in [2, 10, 40] {
        let plan = chain(n);
        let places = plan.system.places();
        assert_eq!(places.len(), 4 * n + 8 * (n - 1));
        let segment = plan.system.segment(0.0);
        let (mut k, size) = (0, plan.start.len());
        let (mut dense, mut summed) = (vec![0.0; size * size], vec![0.0; size * size]);
        segment.entries(0.0, &plan.start, |place, value| {
            assert_eq!(place, places[k]);
            summed[place.1 * size + place.0] += value;
            k += 1;
        });
        assert_eq!(k, places.len());
        segment.jacobian(0.0, &plan.start, &mut dense);
        assert_eq!(dense, summed);
    }
}
