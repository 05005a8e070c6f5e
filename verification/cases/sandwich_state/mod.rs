//! Stick-slip of a laboratory block pulled by a machine of finite stiffness.

use crate::cases::seas::{self, CycleResults};
use crate::{Capability, Case, CaseError, Evidence, Ledger};
use asperity_cycles::operator::Dense;
use asperity_cycles::{Loading, Rupture, run as integrate};
use asperity_fem::table::Table;
use asperity_plan::faults::Plan;
use asperity_run::Event;
use asperity_vary::SceneText;

/// See the README.
pub const CASE: Case = Case {
    name: "sandwich_state",
    readme: include_str!("README.md"),
    covers: &[Capability::FaultCycles, Capability::PlaneStrain, Capability::AgeingLaw, Capability::Events],
    quick: true,
    run,
};

const SCENE: &str = include_str!("../../../scenes/sandwich-state.toml");
/// The independent implementation.
const SOURCE: &str =
    "verification/independent/sandwich_state.py: scipy's sparse solver and DOP853 on the same elements";
/// Length of the face \[m\].
const FACE: f64 = 50e-3;
/// Rate of the machine \[m/s\].
const LOAD: f64 = 1e-6;

/// The scene with elements of this size \[mm\].
pub(crate) fn block(size: f64, events: usize) -> Result<Plan, CaseError> {
    let scene = SceneText::new(SCENE)
        .with_or_same("bodies.A.mesh.block.size", format!("{size} mm"))
        .with_or_same("bodies.B.mesh.block.size", format!("{size} mm"));
    read(&scene.text()?, events)
}

/// The same with L = 10 um and a soft machine: the whole face slides together.
pub(crate) fn small_block(events: usize) -> Result<Plan, CaseError> {
    let scene = SceneText::new(SCENE)
        .with("faults.face.law.l", "10 um")
        .with("stages[0].conditions[3].y.spring", "2e9")
        .with("stages[0].duration", "4000 s");
    read(&scene.text()?, events)
}

fn read(text: &str, events: usize) -> Result<Plan, CaseError> {
    let mut plan = seas::plan(text)?;
    plan.problem.settings.most_events = Some(events);
    Ok(plan)
}

/// Onsets \[s\] found by the independent implementation with this number of elements along the face and this L \[m\].
fn independent(elements: u64, length: f64) -> Result<Vec<f64>, CaseError> {
    let all: serde_json::Value = serde_json::from_str(include_str!("../../independent/sandwich_state.json"))?;
    let of = |v: &&serde_json::Value| {
        v["elements along the face"].as_u64() == Some(elements) && v["L [m]"].as_f64() == Some(length)
    };
    let found = all.as_array().and_then(|a| a.iter().find(of)).ok_or("the file has no such run")?;
    let onsets = found["onsets [s]"].as_array().ok_or("the run has no onsets")?;
    onsets.iter().map(|v| v.as_f64().ok_or_else(|| "an onset is no number".into())).collect()
}

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (size, elements) in [(1.25, 40), (0.625, 80)] {
        stick_slip(ledger, size, elements)?;
    }
    one_slider(ledger)
}

fn onsets(ledger: &mut Ledger, what: &str, found: &CycleResults, reference: &[f64]) {
    let here: Vec<f64> = found.events.iter().take(reference.len()).map(|e| e.onset.seconds()).collect();
    ledger
        .claim(format!("onsets of the first events, {what}"))
        .unit("s")
        .values(&here)
        .equals_each(reference)
        .relative(3e-5)
        .evidence(Evidence::OtherCode, SOURCE)
        .because("the same elements; the error of ln V allowed in a step is 1e-4, that of the reference 1e-6")
        .why_not_tighter("errors of steps add up by chance; here most cancel")
        .covers(&[Capability::FaultCycles, Capability::PlaneStrain, Capability::Events])
        .cost(&found.cost)
        .record();
}

/// Mean over the face.
fn mean(plan: &Plan, values: &[f64]) -> f64 {
    plan.points.iter().zip(values).map(|(p, v)| p.area * v).sum::<f64>() / FACE
}

fn stick_slip(ledger: &mut Ledger, size: f64, elements: u64) -> Result<(), CaseError> {
    let plan = block(size, 11)?;
    let mut at_onset: Vec<f64> = Vec::new();
    let mut open = false;
    let found = seas::found(&plan, &plan.problem.settings, |now| {
        let begins = now.under_way().is_some();
        if begins && !open {
            at_onset.push(mean(&plan, now.slip().component(0)));
        }
        open = begins;
    })?;
    let what = format!("elements of {size} mm");
    onsets(ledger, &what, &found, &independent(elements, 0.5e-6)?);
    let intervals: Vec<f64> = found.events.windows(2).map(|w| w[1].onset.since(&w[0].onset)).collect();
    let largest = intervals.iter().fold(0.0_f64, |m, v| m.max((v / intervals[0] - 1.0).abs()));
    ledger
        .claim(format!("ten intervals differ from the first by at most, relative, {what}"))
        .value(largest)
        .at_most(1e-4)
        .evidence(Evidence::ConvergedSelf, "a limit cycle: the same block under the same load")
        .because("the error of ln V allowed in a step; events are alike")
        .why_not_tighter("errors of steps add up by chance; here most cancel")
        .covers(&[Capability::FaultCycles])
        .cost(&found.cost)
        .record();
    budget(ledger, &what, &found, &at_onset);
    rupture(ledger, &what, &plan, &found);
    Ok(())
}

/// Claim that slip from onset to onset equals the displacement of the machine.
fn budget(ledger: &mut Ledger, what: &str, found: &CycleResults, at_onset: &[f64]) {
    let (first, last) = (1, at_onset.len() - 1);
    let time = found.events[last].onset.since(&found.events[first].onset);
    ledger
        .claim(format!("mean slip over nine cycles over the way of the machine, {what}"))
        .value((at_onset[last] - at_onset[first]).abs() / (LOAD * time))
        .equals(1.0)
        .relative(1e-3)
        .evidence(Evidence::Exact, "slip budget of a cycle: the block is as it was")
        .because("slip is taken at the step after the onset, in which the block slides by up to a thousandth of an event")
        .why_not_tighter("the step after the onset falls anywhere within an event")
        .covers(&[Capability::FaultCycles])
        .cost(&found.cost)
        .record();
}

/// Claims that each event nucleates at an end, crosses the face and lowers the force.
fn rupture(ledger: &mut Ledger, what: &str, plan: &Plan, found: &CycleResults) {
    let from_end = |e: &Event<Rupture>| {
        let y = plan.points[e.details.hypocentre].at[1];
        y.min(FACE - y)
    };
    let farthest = found.events.iter().map(from_end).fold(0.0, f64::max);
    ledger
        .claim(format!("largest distance of a hypocentre from the nearer end of the face, {what}"))
        .unit("m")
        .value(farthest)
        .at_most(0.1 * FACE)
        .evidence(Evidence::OtherCode, SOURCE)
        .because("events nucleate at the ends, where corners concentrate stress; the fastest point lies an element or two inside")
        .covers(&[Capability::Events])
        .cost(&found.cost)
        .record();
    let share = |e: &Event<Rupture>| {
        let slip: Vec<f64> = e.details.slip.component(0).iter().map(|s| s.abs()).collect();
        slip.iter().fold(f64::INFINITY, |m, &s| m.min(s)) / mean(plan, &slip)
    };
    let least = found.events.iter().map(share).fold(f64::INFINITY, f64::min);
    ledger
        .claim(format!("least slip of a point over the mean of an event, {what}"))
        .value(least)
        .at_least(0.8)
        .evidence(
            Evidence::Exact,
            "in a limit cycle every point slips as much: what an event leaves to it is creep between events",
        )
        .because("the rupture crosses the whole face; where it begins a tenth or so has crept before")
        .covers(&[Capability::Events])
        .cost(&found.cost)
        .record();
    let drop = |e: &Event<Rupture>| {
        mean(
            plan,
            &e.details
                .drop
                .component(0)
                .iter()
                .zip(e.details.slip.component(0))
                .map(|(d, s)| d * s.signum())
                .collect::<Vec<_>>(),
        )
    };
    let drops: Vec<f64> = found.events[1..].iter().map(drop).collect();
    let slip = mean(plan, found.events[1].details.slip.component(0)).abs();
    let worst = drops.iter().fold(f64::INFINITY, |m, &d| m.min(d));
    ledger
        .claim(format!(
            "least fall of the force in an event over that of a rigid block on the machine's spring, {what}"
        ))
        .value(worst * FACE / (1.4e10 * slip))
        .at_least(0.5)
        .evidence(
            Evidence::Exact,
            "a rigid block would let it fall by the spring's stiffness times slip; an elastic one by less",
        )
        .because("the blocks are several times as stiff as the machine")
        .why_not_tighter("the claim is that the force falls; its size follows from the onsets")
        .covers(&[Capability::Events])
        .cost(&found.cost)
        .record();
}

/// With L = 10 um the block behaves as one slider with the stiffness of block and machine, whose normal traction
/// changes with slip.
fn one_slider(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut plan = small_block(3)?;
    let mut uniform = f64::INFINITY;
    let mut last = 0.0;
    let found = seas::found(&plan, &plan.problem.settings, |now| {
        // The first step after the slip rate passes 1 mm/s.
        if now.largest >= 1e-3 && last < 1e-3 {
            let slowest = now.rate.all().iter().fold(f64::INFINITY, |m, v| m.min(v.abs()));
            uniform = uniform.min(slowest / now.largest);
        }
        last = now.largest;
    })?;
    onsets(ledger, "L = 10 um", &found, &independent(40, 1e-5)?);
    ledger
        .claim("slowest over fastest point when the block passes 1 mm/s, L = 10 um")
        .value(uniform)
        .at_least(0.98)
        .evidence(Evidence::OtherCode, "definition of the benchmark: uniform to 2 % in an independent solver")
        .because("the block is a tenth of the size in which an event could nucleate")
        .covers(&[Capability::FaultCycles])
        .cost(&found.cost)
        .record();
    let slider = slider(&mut plan)?;
    let here: Vec<f64> = found.events.iter().map(|e| e.onset.seconds()).collect();
    ledger
        .claim("onsets against those of one slider with the stiffness of block and machine, L = 10 um")
        .unit("s")
        .values(&here)
        .equals_each(&slider)
        .relative(1e-2)
        .evidence(
            Evidence::ConvergedSelf,
            "the integrator of sliders, itself held against Taylor series (slider_cycles)",
        )
        .because("slip rates are uniform to 2 % in the fast part of a cycle, and the stiffness that is felt to half of that")
        .why_not_tighter("interseismic creep is not uniform, which a slider does not have")
        .covers(&[Capability::FaultCycles, Capability::Slider])
        .cost(&found.cost)
        .record();
    Ok(())
}

/// Onsets \[s\] of identical sliders: every point gets the mean over the face of the response to uniform slip and to
/// the machine.
fn slider(plan: &mut Plan) -> Result<Vec<f64>, CaseError> {
    let n = plan.points.len();
    let shear = plan.problem.fault.operator.shear_of(&vec![1.0; n]);
    let normal = plan.problem.fault.operator.normal_of(&vec![1.0; n]);
    let means = |response: &[f64]| -> Vec<f64> {
        let stiffness = mean(plan, response);
        (0..n * n).map(|k| stiffness * plan.points[k % n].area / FACE).collect()
    };
    let operator = Dense::new(n, means(&shear), Some(means(&normal)));
    let (pull, press) = plan.problem.loading.rates(1.0, n, true);
    let end = plan.problem.settings.end;
    let mut loading = Loading::new(1);
    loading.add(
        Table::new(vec![0.0, end], vec![0.0, end]),
        vec![mean(plan, &pull); n],
        vec![mean(plan, &press); n],
    );
    plan.problem.fault.operator = Box::new(operator);
    let (fault, start) = (&plan.problem.fault, plan.problem.start.clone());
    let out = integrate(fault, &loading, start, &plan.problem.settings, &mut ())?;
    Ok(out.events().iter().map(|e| e.onset.seconds()).collect())
}
