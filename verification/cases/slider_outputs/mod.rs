//! Outputs of spring-slider runs: rows of histories, the catalogue, the plan.

mod pair;

use super::slider::{self, Independent, MU0, V_REF};
use super::slider_scene::{FRICTION, RATE, SLIP, STATE, TIME, files, plan, planned, text};
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger};
use asperity::kinds::sliders::Report;
use asperity_cycles::slider::{self as cycles, Problem, Rows};
use asperity_friction::evolution::definitions;
use asperity_ode::Method;
use asperity_vary::SceneText;

/// See the README.
pub const CASE: Case = Case {
    name: "slider_outputs",
    readme: include_str!("README.md"),
    covers: &[Capability::Slider, Capability::Events],
    quick: true,
    run,
};

/// Tolerance at which rows between steps are compared.
const LOOSE: f64 = 1e-6;

/// Change of ln V between rows, of which many lie in a step.
const CHANGE: f64 = 0.005;

/// a, L \[m\] and f_n \[Pa\] of all scenes.
const A: f64 = 0.01;
const L: f64 = 1e-5;
const NORMAL: f64 = 5e6;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let reference = Independent::read()?;
    velocity_steps(ledger)?;
    finals(ledger)?;
    cycles(ledger, &reference)?;
    backwards(ledger)?;
    holds(ledger, &reference)?;
    strengthening(ledger)?;
    stiffness(ledger)?;
    drawn(ledger)?;
    pair::claims(ledger)?;
    between_steps(ledger)
}

/// A law with these values of b and L.
fn law(evolution: &str, b: &str, more: &str) -> String {
    format!(
        "{{ kind = \"rate-and-state\", evolution = \"{evolution}\", mu0 = 0.6, a = 0.01, b = {b}, v_ref = \"1 um/s\", v_initial = \"1 um/s\", {more} }}"
    )
}

/// mu of the regularised form.
fn friction(rate: f64, phi: f64) -> f64 {
    A * (rate / (2.0 * V_REF) * ((MU0 + phi) / A).exp()).asinh()
}

/// phi after `time` at a constant slip rate.
fn relaxed(evolution: &str, b: f64, phi: f64, rate: f64, time: f64) -> f64 {
    let left = (-rate * time / L).exp();
    if evolution == "ageing" {
        let (theta, steady) = (L / V_REF * (phi / b).exp(), L / rate);
        b * (V_REF / L * (steady + (theta - steady) * left)).ln()
    } else {
        let steady = -b * (rate / V_REF).ln();
        steady + (phi - steady) * left
    }
}

/// Slip rate, slip and phi in the imposed course: 1 um/s for 20 s, 10 um/s for 10 s, then 0.1 um/s; before a jump at that time, or after it.
fn imposed(evolution: &str, b: f64, (time, after): (f64, bool)) -> [f64; 3] {
    let phi = |from: f64, rate: f64, time: f64| relaxed(evolution, b, from, rate, time);
    let until = |end: f64| time < end || time == end && !after;
    if until(20.0) {
        [1e-6, 1e-6 * time, 0.0]
    } else if until(30.0) {
        [1e-5, 2e-5 + 1e-5 * (time - 20.0), phi(0.0, 1e-5, time - 20.0)]
    } else {
        [1e-7, 1.2e-4 + 1e-7 * (time - 30.0), phi(phi(0.0, 1e-5, 10.0), 1e-7, time - 30.0)]
    }
}

/// Claims on rows at given times under an imposed slip rate, where slip, friction and states have closed forms.
fn velocity_steps(ledger: &mut Ledger) -> Result<(), CaseError> {
    let course = "rate = { table = [[\"0 s\", \"1 um/s\"], [\"20 s\", \"1 um/s\"], [\"20 s\", \"10 um/s\"], [\"30 s\", \"10 um/s\"], [\"30 s\", \"0.1 um/s\"]] }";
    let (mut missed, mut slips, mut frictions, mut states) = (0, 0.0_f64, 0.0_f64, 0.0_f64);
    let (done, cost) = Cost::measure(|| -> Result<(), CaseError> {
        for (evolution, b) in [("ageing", 0.015), ("ageing", -0.005), ("slip", 0.015), ("slip", -0.005)] {
            let law = law(evolution, &b.to_string(), "l = \"10 um\"");
            let rest = "[time]\nend = \"200 s\"\ntolerance = 1e-11\n[output]\ninterval = \"0.3 s\"";
            let [rows, _] = files(&plan(&text("", course, &law, rest))?)?;
            // At 30 s, the 100th interval, the rate jumps: a row before and one after.
            let asked = (0..=666).flat_map(|k: u32| {
                let rows: &[bool] = if k == 100 { &[false, true] } else { &[false] };
                rows.iter().map(move |after| (0.3 * f64::from(k), *after))
            });
            let asked: Vec<(f64, bool)> = asked.collect();
            missed += u64::from(rows.len() != asked.len());
            for (row, &(time, after)) in rows.iter().zip(&asked) {
                let [rate, slip, phi] = imposed(evolution, b, (time, after));
                missed += u64::from(row[TIME] != time || row[RATE] != rate);
                slips = slips.max((row[SLIP] - slip).abs());
                frictions = frictions.max((row[FRICTION] - friction(rate, phi)).abs() / A);
                let state = if evolution == "ageing" { b * row[STATE] } else { row[STATE] };
                states = states.max((state - phi).abs() / A);
            }
        }
        Ok(())
    });
    done?;
    ledger
        .claim("imposed velocity steps, ageing and slip law, b = 0.015 and -0.005: rows at another time or slip rate than asked for, of 4 x 668")
        .count(missed, 0)
        .evidence(Evidence::Exact, "multiples of the interval; the slip rates of the course")
        .because("a time that is asked for is a time, to the last bit")
        .cost(&cost)
        .record();
    ledger
        .claim("imposed velocity steps: slip in the rows against the integral of the course")
        .unit("m")
        .value(slips)
        .at_most(1e-18)
        .evidence(Evidence::Exact, "slip at constant rates")
        .because("rounding of 0.14 mm")
        .why_not_tighter("a few units in the last place")
        .cost(&cost)
        .record();
    ledger
        .claim("imposed velocity steps: friction in the rows against the relaxation in closed form, over a")
        .value(frictions)
        .at_most(1e-9)
        .evidence(Evidence::Exact, "relaxation at constant V")
        .because("a tolerance of 1e-11 a step, over some tens of steps")
        .why_not_tighter("the order of the sum of errors of steps is what is known")
        .cost(&cost)
        .record();
    ledger
        .claim("imposed velocity steps: states in the rows against the relaxation in closed form, over a")
        .value(states)
        .at_most(1e-9)
        .evidence(Evidence::Exact, "relaxation at constant V")
        .because("as friction")
        .why_not_tighter("as friction")
        .cost(&cost)
        .record();
    Ok(())
}

/// The slider at the end of the imposed course, in the report.
fn finals(ledger: &mut Ledger) -> Result<(), CaseError> {
    let course = "rate = { table = [[\"0 s\", \"1 um/s\"], [\"20 s\", \"1 um/s\"], [\"20 s\", \"10 um/s\"], [\"30 s\", \"10 um/s\"], [\"30 s\", \"0.1 um/s\"]] }";
    let b = 0.015;
    let (mut found, mut exact) = (Vec::new(), Vec::new());
    let (done, cost) = Cost::measure(|| -> Result<(), CaseError> {
        for evolution in ["ageing", "slip"] {
            let law = law(evolution, "0.015", "l = \"10 um\"");
            let plan = plan(&text("", course, &law, "[time]\nend = \"60 s\"\ntolerance = 1e-11"))?;
            let report = Report::new(&plan, &cycles::run(&plan, &mut ())?);
            let last = report.last.first().ok_or("no slider in the report")?;
            let [rate, _, phi] = imposed(evolution, b, (60.0, true));
            let state = if evolution == "ageing" { phi / b } else { phi };
            found.extend([last.slip_rate / rate, last.friction]);
            found.extend(&last.states);
            exact.extend([1.0, friction(rate, phi), state]);
        }
        Ok(())
    });
    done?;
    if found.len() != exact.len() {
        return Err("a state is missing".into());
    }
    ledger
        .claim("imposed velocity steps, ageing and slip law: slip rate over that imposed, friction and state at the end in the report")
        .values(&found)
        .equals_each(&exact)
        .absolute(1e-9)
        .evidence(Evidence::Exact, "relaxation at constant V")
        .because("a tolerance of 1e-11 a step, over some tens of steps")
        .why_not_tighter("the order of the sum of errors of steps is what is known")
        .cost(&cost)
        .record();
    Ok(())
}

/// Columns of the catalogue after the name.
const DIRECTION: usize = 0;
const ONSET: usize = 1;
const INTERVAL: usize = 2;
const DURATION: usize = 3;
const EVENT_SLIP: usize = 4;
const PEAK: usize = 5;
const LEAST: usize = 6;
const DROP: usize = 7;
/// Traction, friction and state at the onset, then at the end.
const AT_ONSET: usize = 8;
const AT_END: usize = 11;

const SHIPPED: &str = include_str!("../../../scenes/spring-slider.toml");
/// Stiffness \[Pa/m\], damping \[Pa s/m\] and load \[m/s\] of the shipped scene.
const SPRING: [f64; 3] = [1.25e9, 5e6, 1e-6];

/// Claims on ten cycles: the catalogue and the peaks in the history.
fn cycles(ledger: &mut Ledger, reference: &Independent) -> Result<(), CaseError> {
    let mut plan = plan(SHIPPED)?;
    plan.tolerance = 1e-10;
    let (read, cost) = Cost::measure(|| files(&plan));
    let [rows, events] = read?;
    let expected = reference.numbers("mild_ageing", "crossings_s")?;
    let recurrence = reference.number("mild_ageing", "last_interval_s")?;
    let late = events.iter().zip(&expected).map(|(e, t)| (e[ONSET] - t).abs() / recurrence);
    let apart =
        events.windows(2).zip(expected.windows(2)).map(|(e, t)| (e[1][INTERVAL] - (t[1] - t[0])).abs());
    let whole = events.len() == 10 && events.iter().all(|e| e.len() == 14);
    let largest = late.chain(apart.map(|t| t / recurrence)).fold(0.0, f64::max);
    ledger
        .claim("events.csv, ten events: onsets and intervals, error over the recurrence")
        .value(if whole { largest } else { f64::NAN })
        .at_most(1e-9)
        .evidence(Evidence::OtherCode, slider::SOURCE)
        .because("a tolerance of 1e-10 a step, amplified by what an event does to the time of the next")
        .why_not_tighter("the tolerance is a hundredth of the default, not the least")
        .cost(&cost)
        .record();
    let [most, least] = ["v_max_between_last_two", "v_min_between_last_two"]
        .map(|key| reference.number("mild_ageing", key).map(f64::ln));
    let (most, least, last) = (most?, least?, events.last().ok_or("no event")?);
    // The last cycle, from just before the onset of the last event but one to the onset of the last.
    let before = events[events.len() - 2][ONSET];
    let cycle = || rows.iter().filter(|r| r[TIME] > before - 100.0 && r[TIME] < last[ONSET]);
    let seen = |pick: fn(f64, f64) -> f64| cycle().map(|r| r[RATE].ln()).reduce(pick).unwrap_or(f64::NAN);
    ledger
        .claim("events.csv and history: ln V at the peak and at the least of a cycle")
        .values(&[last[PEAK].ln(), last[LEAST].ln(), seen(f64::max), seen(f64::min)])
        .equals_each(&[most, least, most, least])
        .absolute(1e-8)
        .evidence(Evidence::OtherCode, slider::SOURCE)
        .because("rows lie on the extremes, which are found to second order; a tolerance of 1e-10 over some hundred steps")
        .why_not_tighter("all errors of one sign would give that")
        .cost(&cost)
        .record();
    balance(ledger, &events, &cost);
    Ok(())
}

/// Claims that slip, stress drop, tractions and states of events agree with spring and law.
fn balance(ledger: &mut Ledger, events: &[Vec<f64>], cost: &Cost) {
    let [stiffness, damping, load] = SPRING;
    let (mut drops, mut edges) = (0.0_f64, 0.0_f64);
    for e in events {
        let lost = stiffness * (e[EVENT_SLIP] - load * e[DURATION]);
        drops = drops.max((e[DROP] / lost - 1.0).abs());
        drops = drops.max(((e[AT_ONSET] - e[AT_END]) / lost - 1.0).abs());
        for (at, rate) in [(AT_ONSET, 1e-3), (AT_END, 1e-4)] {
            let [traction, mu, state] = [e[at], e[at + 1], e[at + 2]];
            edges = edges.max((mu - friction(rate, 0.015 * state)).abs() / A);
            edges = edges.max((traction - NORMAL * mu - damping * rate).abs() / (NORMAL * A));
        }
    }
    ledger
        .claim("events.csv: stress drop, and traction at the onset less that at the end, over what the spring loses")
        .value(drops)
        .at_most(1e-9)
        .evidence(Evidence::Exact, "k (slip - V_load duration)")
        .because("the slip of an event is a difference of slips, which carry rounding of 3 mm: 1e-12 of 0.25 mm, and of friction 1e-15 of 0.1")
        .why_not_tighter("differences of tractions of 3 MPa to 0.3 MPa, read from the file")
        .cost(cost)
        .record();
    ledger
        .claim("events.csv: friction by the law from state and threshold, and traction by friction and damping, over a and f_n a, at onsets and ends")
        .value(edges)
        .at_most(1e-9)
        .evidence(Evidence::Exact, "strength of the regularised form; T = f_n mu + eta V")
        .because("thresholds are met to rounding: ln V is m less (mu0 + phi)/a, numbers of some sixty")
        .why_not_tighter("the root is met to what rounding of ln V leaves of the time")
        .cost(cost)
        .record();
}

/// The same cycles with the load point moving backwards: quantities with a direction change sign, all else is unchanged.
fn backwards(ledger: &mut Ledger) -> Result<(), CaseError> {
    let scene = SceneText::new(SHIPPED).add("time.tolerance", "1e-10");
    let back = scene.clone().with("load.rate", "-1 um/s").with("sliders.block.start", "-1.5 um/s");
    let forth = files(&plan(&scene.text()?)?)?[1].clone();
    let (back, cost) = Cost::measure(|| files(&plan(&back.text()?)?));
    let back = &back?[1];
    let [stiffness, _, load] = SPRING;
    let lost = |e: &[f64]| stiffness * (e[EVENT_SLIP].abs() - load * e[DURATION]);
    let drops = back.iter().map(|e| (e[DROP] / lost(e) - 1.0).abs()).fold(0.0, f64::max);
    ledger
        .claim("events.csv of a slider that slides backwards: stress drop over what the spring loses")
        .value(if back.len() == 10 { drops } else { f64::NAN })
        .at_most(1e-11)
        .evidence(Evidence::Exact, "k (|slip| - |V_load| duration), positive in the direction of slip")
        .because("differences of slips of 3 mm, which carry rounding of 1e-12 of 0.25 mm")
        .why_not_tighter("it is printed and read again, as the tractions are")
        .cost(&cost)
        .record();
    let turned = |column: usize| TURNED.contains(&column);
    let mirror = |e: &[f64]| -> Vec<f64> {
        let signed = e.iter().enumerate().map(|(column, value)| if turned(column) { -value } else { *value });
        // The first event has no interval before it.
        signed.filter(|value| !value.is_nan()).collect()
    };
    let expected: Vec<f64> = forth.iter().flat_map(|e| mirror(e)).collect();
    let found: Vec<f64> = back.iter().flatten().copied().filter(|value| !value.is_nan()).collect();
    let ratios: Vec<f64> = found.iter().zip(&expected).map(|(a, b)| a / b).collect();
    ledger
        .claim("events.csv of a slider that slides backwards, over that of one that slides forwards with directions turned, ten events")
        .values(&ratios)
        .equals_each(&vec![1.0; expected.len()])
        .absolute(1e-12)
        .evidence(Evidence::Exact, "strength, spring and damping are odd in the slip rate")
        .because("rounding is the same in both directions, but for that of signed sums")
        .why_not_tighter("events amplify rounding")
        .cost(&cost)
        .record();
    Ok(())
}

/// Columns that change sign with the direction: direction, slip, traction and friction at both ends.
const TURNED: [usize; 6] = [DIRECTION, EVENT_SLIP, AT_ONSET, AT_ONSET + 1, AT_END, AT_END + 1];

/// Peaks of friction after holds, from the rows of a history.
fn holds(ledger: &mut Ledger, reference: &Independent) -> Result<(), CaseError> {
    for evolution in ["ageing", "slip"] {
        let name = format!("slide_hold_slide_{evolution}");
        let (times, expected) =
            (reference.numbers(&name, "hold_s")?, reference.numbers(&name, "peak_minus_steady_mu")?);
        let (found, cost) =
            Cost::measure(|| times.iter().map(|&t| healed(evolution, t)).collect::<Result<Vec<_>, _>>());
        ledger
            .claim(format!("slide-hold-slide, {evolution} law: largest friction of the history above steady after holds of 1 s to 1e4 s"))
            .values(&found?)
            .equals_each(&expected)
            .absolute(2e-6)
            .evidence(Evidence::OtherCode, slider::SOURCE)
            .because("rows lie within 0.01 of ln V of each other; beside the peak friction is lower by kappa/2 (d ln V)^2, with kappa = 0.025, over the pace of ln V in V/L, near one")
            .why_not_tighter("where rows fall beside the peak is chance")
            .cost(&cost)
            .record();
    }
    Ok(())
}

fn healed(evolution: &str, hold: f64) -> Result<f64, CaseError> {
    let (stop, go) = (1.0, 1.0 + hold);
    let load = format!(
        "[load]\nrate = {{ table = [[\"0 s\", \"1 um/s\"], [\"{stop} s\", \"1 um/s\"], [\"{stop} s\", \"0 m/s\"], [\"{go} s\", \"0 m/s\"], [\"{go} s\", \"1 um/s\"]] }}"
    );
    let rest = format!("[time]\nend = \"{} s\"\n[output]\nchange = 0.01", go + 200.0);
    let slider = "stiffness = \"12.5 GPa/m\"\ndamping = \"5 MPa s/m\"";
    let [rows, _] = files(&plan(&text(&load, slider, &law(evolution, "0.015", "l = \"10 um\""), &rest))?)?;
    let after = rows.iter().filter(|r| r[TIME] >= go);
    Ok(after.map(|r| r[FRICTION]).fold(0.0, f64::max) - MU0)
}

/// b < 0: friction after a tenfold step of the load.
fn strengthening(ledger: &mut Ledger) -> Result<(), CaseError> {
    let load =
        "[load]\nrate = { table = [[\"0 s\", \"1 um/s\"], [\"10 s\", \"1 um/s\"], [\"10 s\", \"10 um/s\"]] }";
    let (found, cost) = Cost::measure(|| -> Result<Vec<f64>, CaseError> {
        let mut last = Vec::new();
        for evolution in definitions().into_iter().filter(|row| row.is_plain()) {
            let law = law(evolution.name, "-0.005", "l = \"10 um\"");
            let scene = text(load, "stiffness = \"5 GPa/m\"", &law, "[time]\nend = \"600 s\"");
            let [rows, _] = files(&plan(&scene)?)?;
            last.push(rows.last().ok_or("no row")?[FRICTION]);
        }
        Ok(last)
    });
    let found = found?;
    ledger
        .claim("b = -0.005, laws without parameters of their own: friction in the last row, long after a tenfold step of the load")
        .values(&found)
        .equals_each(&vec![MU0 + (A + 0.005) * 10f64.ln(); found.len()])
        .absolute(1e-9)
        .evidence(Evidence::Exact, "steady friction mu0 + (a - b) ln(V/Vref)")
        .because("a tolerance of 1e-8 in ln V, times a, and a bare logarithm to e^(-2 mu/a)")
        .why_not_tighter("a few steps of tolerance")
        .cost(&cost)
        .record();
    Ok(())
}

/// k/k_c and k_c as a plan prints them.
fn printed(summary: &str) -> Result<[f64; 2], CaseError> {
    let number = |key: &str| -> Result<f64, CaseError> {
        let after = summary.split_once(key).ok_or("the plan has no k_c")?.1;
        Ok(after.split([',', ' ', '\n']).next().ok_or("no number")?.parse()?)
    };
    Ok([number("k/k_c = ")?, number(", k_c = ")?])
}

/// Gu et al. (1984): `kappa_c/2` of two states, with rho = L1/L2, in units of f_n/L1.
fn two_states(b: [f64; 2], rho: f64) -> f64 {
    let (first, second, both) = (b[0] - A, rho * rho * (b[1] - A), b[0] + b[1] - A);
    let root = ((first + second).powi(2) + 4.0 * rho * rho * A * both).sqrt();
    (first + second + 2.0 * rho * both + root) / (2.0 * (1.0 + rho))
}

/// Claims on the critical stiffness that plans print.
fn stiffness(ledger: &mut Ledger) -> Result<(), CaseError> {
    let stiff = 1e9;
    let (mut ratios, mut expected) = (Vec::new(), Vec::new());
    let mut look = |law: &str, more: &str, critical: f64| -> Result<(), CaseError> {
        let slider = format!("stiffness = {stiff:e}\n{more}");
        let scene = text("[load]\nrate = \"1 um/s\"", &slider, law, "[time]\nend = \"1 s\"");
        let [ratio, found] = printed(&planned(&scene)?.summary())?;
        ratios.extend([found / critical, ratio]);
        expected.extend([1.0, stiff / critical]);
        Ok(())
    };
    let one = law("ageing", "0.015", "l = \"10 um\"");
    look(&one, "", NORMAL / L * 0.005)?;
    // Here eta V/f_n = 0.002 and n = M V^2/(f_n L) = 0.002.
    look(&one, "damping = \"1e10 Pa s/m\"", NORMAL / L * 0.003)?;
    look(&one, "mass = 1e11", NORMAL / L * 0.005 * (1.0 + 0.002 / A))?;
    for (b, rho) in
        [([0.012, 0.003], 0.1), ([0.02, 0.005], 0.5), ([0.004, 0.016], 0.02), ([0.015, -0.002], 0.2)]
    {
        let law = law("slip", &format!("{b:?}"), &format!("l = [\"10 um\", \"{} um\"]", 10.0 / rho));
        look(&law, "", NORMAL / L * two_states(b, rho))?;
    }
    for c in [0.5, 2.0] {
        look(
            &law("nagata", "0.015", &format!("l = \"10 um\", c = {c}")),
            "",
            NORMAL / L * 0.005 / (1.0 + c),
        )?;
    }
    ledger
        .claim("plans of nine sliders: k_c over that of theory, and k/k_c: one state, damped, with mass; two states; memory of shear traction")
        .values(&ratios)
        .equals_each(&expected)
        .absolute(2e-6)
        .evidence(Evidence::Exact, "Ruina (1983); Gu et al. (1984); (b - a) f_n/[L (1 + c)]")
        .because("plans print k_c with seven digits and k/k_c with six after the point")
        .why_not_tighter("the digits printed")
        .covers(&[Capability::Slider, Capability::SeveralStates, Capability::LawFamily])
        .record();
    Ok(())
}

/// A slider that one with an imposed rate loads through a spring: what the spring carries is friction and damping.
fn drawn(ledger: &mut Ledger) -> Result<(), CaseError> {
    const SPRING: f64 = 1e9;
    for (order, names) in [("first", ["puller", "block"]), ("last", ["block", "puller"])] {
        let scene = format!(
            "schema = 1\ntitle = \"t\"\nkinematics = \"spring-slider\"\n\
             [sliders.block]\nnormal = \"5 MPa\"\ndamping = \"4 MPa s/m\"\nlaw = {0}\n\
             [sliders.puller]\nnormal = \"5 MPa\"\nrate = {1}\nlaw = {0}\n\
             [[springs]]\nbetween = [\"{2}\", \"{3}\"]\nstiffness = \"1 GPa/m\"\n\
             [time]\nend = \"60 s\"\n[output]\ninterval = \"0.5 s\"\n",
            law("ageing", "0.005", "l = \"10 um\""),
            "{ table = [[\"0 s\", \"1 um/s\"], [\"10 s\", \"1 um/s\"], [\"10 s\", \"4 um/s\"]] }",
            names[0],
            names[1],
        );
        let (rows, cost) = Cost::measure(|| files(&plan(&scene)?));
        let [rows, _] = rows?;
        let traction = |row: &[f64]| NORMAL * row[FRICTION] + 4e6 * row[RATE];
        let first = traction(rows.first().ok_or("no rows")?);
        let travelled = |t: f64| 1e-6 * t + 3e-6 * (t - 10.0).max(0.0);
        let missing = rows
            .iter()
            .map(|row| (SPRING * (travelled(row[TIME]) - row[SLIP]) - (traction(row) - first)).abs() / first);
        ledger
            .claim(format!("slider drawn by another one, named {order} in the spring: what the spring carries less friction and damping, over the first traction"))
            .norm(format!("largest of {} rows", rows.len()))
            .value(missing.fold(0.0, f64::max))
            .at_most(1e-12)
            .evidence(Evidence::Exact, "balance of forces, with the travel of the imposed rate")
            .because("slip is computed from this balance, in the spring's 1e9 Pa/m times 0.2 mm: rounding of friction")
            .why_not_tighter("rounding")
            .cost(&cost)
            .record();
    }
    Ok(())
}

/// Rows between the steps of each method, and how their number grows with the accuracy.
fn between_steps(ledger: &mut Ledger) -> Result<(), CaseError> {
    let problem = |method: Method, tolerance: f64| -> Result<Problem, CaseError> {
        let law = law("ageing", "0.005", "l = \"10 um\"");
        let load = "[load]\nrate = { table = [[\"0 s\", \"1 um/s\"], [\"20 s\", \"10 um/s\"]] }";
        let slider = "stiffness = \"1 GPa/m\"\ndamping = \"4 MPa s/m\"";
        let rest = "[time]\nend = \"40 s\"\n[output]\ninterval = \"0.1 s\"";
        Ok(Problem { method, tolerance, ..plan(&text(load, slider, &law, rest))? })
    };
    let [reference, _] = files(&problem(Method::Radau5, 1e-13)?)?;
    for method in [Method::Tsit5, Method::Dop853, Method::Radau5, Method::Switching] {
        let (rows, cost) = Cost::measure(|| files(&problem(method, LOOSE)?));
        let [rows, _] = rows?;
        let apart = rows.iter().zip(&reference).map(|(row, exact)| (row[RATE] / exact[RATE]).ln().abs());
        ledger
            .claim(format!("{}: ln of the slip rate in rows between steps against a run at a tolerance of 1e-13", method.name()))
            .norm(format!("largest of {} rows", reference.len()))
            .value(if rows.len() == reference.len() { apart.fold(0.0, f64::max) } else { f64::NAN })
            .at_most(10.0 * LOOSE)
            .evidence(Evidence::ConvergedSelf, "Radau IIA at a tolerance of 1e-13")
            .because("a tolerance a step, over some tens of steps, and the dense output of a step may err by as much")
            .why_not_tighter("how errors of steps add up is not known beforehand")
            .cost(&cost)
            .record();
    }
    for method in [Method::Tsit5, Method::Dop853, Method::Radau5, Method::Switching] {
        dense(ledger, method, &problem)?;
    }
    for (method, order) in [(Method::Tsit5, 5.0), (Method::Dop853, 8.0)] {
        let steps = |tolerance: f64| -> Result<f64, CaseError> {
            Ok(slider::finish(&problem(method, tolerance)?)?.counts.steps as f64)
        };
        let growth = steps(1e-6 * LOOSE)? / steps(LOOSE)?;
        ledger
            .claim(format!("{}: steps for a tolerance of 1e-12 over those for 1e-6, over the ratio that its order gives", method.name()))
            .value(growth / 1e6_f64.powf(1.0 / order))
            .at_most(1.5)
            .evidence(Evidence::Exact, "the error of a step of order p falls with the power p of its length, as the estimate is scaled")
            .because("loose steps are bounded by stability as well, which lowers the ratio; half as much again for steps at the corners of the load")
            .why_not_tighter("the ratio falls below one where stability bounds the steps")
            .record();
    }
    Ok(())
}

/// Claims on rows by the change of the slip rate, which the polynomial of a step gives.
fn dense(
    ledger: &mut Ledger,
    method: Method,
    problem: &dyn Fn(Method, f64) -> Result<Problem, CaseError>,
) -> Result<(), CaseError> {
    let by_change = Rows { change: Some(CHANGE), times: Vec::new(), interval: None, histories: None };
    let drawn = Problem { output: by_change, ..problem(method, LOOSE)? };
    let (rows, cost) = Cost::measure(|| files(&drawn));
    let [mut rows, _] = rows?;
    // Where the rate of the load has a corner there are two.
    rows.dedup_by_key(|row| row[TIME]);
    let times = rows.iter().map(|row| row[TIME]).collect();
    let asked = Rows { change: None, times, interval: None, histories: None };
    let [exact, _] = files(&Problem { output: asked, ..problem(Method::Radau5, 1e-13)? })?;
    let apart = rows.iter().zip(&exact).map(|(row, exact)| (row[RATE] / exact[RATE]).ln().abs());
    let steps = slider::finish(&problem(method, LOOSE)?)?.counts.steps;
    if rows.len() != exact.len() || (rows.len() as u64) < 2 * steps {
        return Err(format!("{} rows of {} times and {steps} steps", rows.len(), exact.len()).into());
    }
    ledger
        .claim(format!("{}: ln of the slip rate in rows by its change, within steps, against a run at a tolerance of 1e-13", method.name()))
        .norm("largest of all rows")
        .value(apart.fold(0.0, f64::max))
        .at_most(10.0 * LOOSE)
        .evidence(Evidence::ConvergedSelf, "Radau IIA at a tolerance of 1e-13, by steps to the times of the rows")
        .because("a tolerance a step, over some tens of steps, and the polynomial of a step may err by as much")
        .why_not_tighter("how errors of steps add up is not known beforehand")
        .cost(&cost)
        .record();
    Ok(())
}
