//! Stick-slip of spring-loaded interfaces, with radiation damping.

pub(super) mod exponential;

use super::texts::{self, BodyRun};
use super::{fault_pressing, seas, slider as sliders};
use crate::cases::body_plots;
use crate::ledger::Draft;
use crate::{Capability, Case, CaseError, Evidence, Floor, Ledger, Plot, Series};
use asperity::catalogue::Entry;
use asperity::kinds::sliders::Entry as SliderEntry;
use asperity_cycles::Rupture;
use asperity_cycles::slider::{self as cycles, Problem, Rows, SliderState};
use asperity_friction::evolution::ageing::Ageing;
use asperity_friction::rate::RateLaw;
use asperity_friction::slider::{History, Slider};
use asperity_friction::strength::{Parameters, regularised::Regularised};
use asperity_ode::Method;
use asperity_run::Event;
use asperity_vary::SceneText;
use std::sync::Arc;

/// See the README.
pub const CASE: Case = Case {
    name: "stick_slip",
    readme: include_str!("README.md"),
    covers: &[Capability::InterfaceStates, Capability::Events],
    quick: true,
    run,
};

const COLUMN: &str = include_str!("../interface_rate_state/scene.toml");
const BLOCK: &str = include_str!("block.toml");
const DIRECT: &str = include_str!("../../../scenes/stick-slip.toml");

/// Parameters of the law of the column; L in \[m\].
const A: f64 = 0.010;
const B: f64 = 0.015;
const LENGTH: f64 = 10e-6;
/// Rate of the load point, also that of the initial steady state \[m/s\].
pub(super) const LOAD: f64 = 1e-6;
/// Normal traction of the column \[Pa\].
pub(super) const NORMAL: f64 = 1e7;
/// Radiation damping of the column \[Pa s/m\].
const DAMPING: f64 = 5e6;
/// Compliance of the column and of its penalty \[m/Pa\]: 0.2 m of 4 GPa, and 1000 GPa/m.
const COMPLIANCE: f64 = 0.2 / SHEAR + 1e-12;
/// Shear modulus of column and base \[Pa\].
const SHEAR: f64 = 4e9;
/// Width of the column \[m\].
pub(super) const WIDTH: f64 = 0.1;
/// Duration of its pressing stage \[s\].
pub(super) const PRESSED: f64 = 1.0;
/// End times of the later stages, counted from the end of pressing \[s\], and the rate of the load point in each \[m/s\].
const STAGES: [(f64, f64); 5] =
    [(600.0, LOAD), (620.0, 10.0 * LOAD), (720.0, LOAD), (1720.0, 0.0), (1870.0, LOAD)];
/// Springs with which the column creeps, and with which it sticks and slips: 2.4 and 0.52 of the critical stiffness in series
/// with the column \[N/m\].
const SPRINGS: [f64; 2] = [3e9, 3e8];
/// Tolerance of the references.
const TIGHT: f64 = 1e-10;
/// Source of the references of the column.
const SLIDER: &str = "one slider on a spring with damping, Radau IIA of order 5 at 1e-10";
/// Source of the references of the block.
const CONDENSED: &str =
    "the same block as fault of condensed bodies, which has no penalty (case sandwich_state)";

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    in_time(ledger)?;
    column_events(ledger, "the column's events", column(SPRINGS[1]))?;
    let (done, wanted) =
        column_events(ledger, "the column's events in space", in_space(column(SPRINGS[1] * DEPTH)))?;
    magnitudes(ledger, &done, &wanted)?;
    exponential::claims(ledger)?;
    block(ledger)?;
    ruptures(ledger)?;
    direct(ledger)
}

/// The column with its head on a spring \[N/m\].
pub(super) fn column(spring: f64) -> SceneText {
    let drawn = |rate: &str| format!(r#"{{ spring = {spring:e}, rate = "{rate}" }}"#);
    let mut scene = SceneText::new(COLUMN)
        .add("interfaces.fault.measure", "node-to-point")
        .add("interfaces.fault.sliding", "small")
        .add("interfaces.fault.law.evolution", "ageing")
        .add("interfaces.fault.damping", "5 MPa s/m");
    for (stage, rate) in ["1 um/s", "10 um/s", "1 um/s", "0 m/s", "1 um/s"].iter().enumerate() {
        scene = scene.with(&format!("stages[{}].conditions[0].x", stage + 1), drawn(rate));
    }
    scene
}

/// Depth of the column in space \[m\]; its springs are not per metre of thickness.
const DEPTH: f64 = 0.1;

/// The column in space, whose sides along its depth are held.
fn in_space(scene: SceneText) -> SceneText {
    let block = |min: &str, max: &str, divisions: &str| {
        format!(r#"{{ min = {min}, max = {max}, divisions = {divisions}, element = "hex8" }}"#)
    };
    let scene = scene
        .with("kinematics", "3d")
        .with("bodies.column.mesh.block", block("[0, 0, 0]", "[0.1, 0.2, 0.1]", "[2, 2, 1]"))
        .with("bodies.base.mesh.block", block("[-0.05, -0.05, -0.05]", "[0.15, 0, 0.15]", "[5, 1, 5]"));
    let scene = (0..8).fold(scene, |scene, k| scene.add(&format!("stages[0].conditions[{k}].z"), "0"));
    ["column.front", "column.back", "base.front", "base.back"].iter().fold(scene, |scene, set| {
        scene.push("stages[0].conditions", format!(r#"{{ set = "{set}", z = 0 }}"#))
    })
}

/// The slider of the column.
fn one(spring: f64, load: History, end: f64) -> Result<Problem, CaseError> {
    slider(COMPLIANCE + WIDTH / spring, (DAMPING, None), load, end)
}

/// A slider with the law and the normal traction of the column on springs of this compliance \[m/Pa\], with this damping \[Pa s/m\]
/// and mass \[kg/m²\].
///
/// # Errors
/// Parameters out of range.
pub(super) fn slider(
    compliance: f64,
    (damping, mass): (f64, Option<f64>),
    load: History,
    end: f64,
) -> Result<Problem, CaseError> {
    let form = Regularised(Parameters::new(sliders::MU0, A, sliders::V_REF)?);
    let law = Arc::new(RateLaw::new(form, Ageing::new(B, LENGTH, sliders::V_REF)?, LOAD, None)?);
    let normal = History::Constant(NORMAL);
    let column = Slider { law, stiffness: 1.0 / compliance, damping, mass, normal };
    let mut plan = sliders::plan(column, load, LOAD, 1.0, end)?;
    // The unknown mu/a is zero: the spring is slack.
    plan.start[0] = 0.0;
    plan.method = Method::Radau5;
    plan.tolerance = TIGHT;
    Ok(plan)
}

/// Velocity steps and slide-hold-slide behind a spring, in every measure.
fn in_time(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (mut found, mut cost) = (Vec::new(), None);
    for column in [column(SPRINGS[0]), in_space(column(SPRINGS[0] * DEPTH))] {
        for measure in ["node-to-point", "mortar"] {
            for sliding in ["small", "finite"] {
                let scene = column
                    .clone()
                    .with_or_same("interfaces.fault.measure", measure)
                    .with_or_same("interfaces.fault.sliding", sliding);
                let done = texts::simulate(&scene.text()?)?;
                found.push(error(&done, &reference(&done)?));
                cost.get_or_insert(done.cost);
            }
        }
    }
    ledger
        .claim("friction of every point at every step, less that of the slider, node-to-point and mortar, small and finite sliding, in the plane and in space")
        .values(&found)
        .equals_each(&[0.0; 8])
        .absolute(1e-4)
        .evidence(Evidence::SemiAnalytic, SLIDER)
        .because("the default bounds the error of a step by 2e-6, and what steps leave adds up over those in which traction relaxes, some tens")
        .covers(&[Capability::InterfaceStates])
        .cost(&cost.ok_or("nothing was run")?)
        .record();
    Ok(())
}

/// Friction of the slider at the times of a run since the law began to act.
fn reference(done: &BodyRun) -> Result<Vec<f64>, CaseError> {
    let times: Vec<f64> = done.record.times().iter().map(|t| t - PRESSED).filter(|&t| t > 0.0).collect();
    let (mut table, mut from) = (Vec::new(), 0.0);
    for (end, rate) in STAGES {
        table.extend([[from, rate], [end, rate]]);
        from = end;
    }
    let mut plan = one(SPRINGS[0], History::table(table)?, from)?;
    plan.output = Rows { change: None, times, interval: None, histories: None };
    let mut friction = Vec::new();
    let mut look = |now: &SliderState<'_>| {
        if now.asked {
            friction.push(now.conditions[0].friction);
        }
    };
    cycles::run(&plan, &mut look)?;
    Ok(friction)
}

/// Largest difference of friction from that of the slider over all points and steps under the law.
fn error(done: &BodyRun, reference: &[f64]) -> f64 {
    let before = done.record.times().len() - reference.len();
    let points = &done.record.histories()[0].points;
    let each = points.iter().flat_map(|p| p.friction[before..].iter().zip(reference));
    each.map(|(found, wanted)| (found - wanted).abs()).fold(0.0, f64::max)
}

/// Events of all interfaces of a run.
pub(super) fn events(done: &BodyRun) -> Result<&[Entry], CaseError> {
    Ok(&done.report.events.as_ref().ok_or("the scene has no events")?.all)
}

/// Stick-slip of the column beside that of the slider.
fn column_events(
    ledger: &mut Ledger,
    name: &str,
    column: SceneText,
) -> Result<(BodyRun, Vec<SliderEntry>), CaseError> {
    let scene = (2..6).rev().fold(column, |scene, stage| scene.without(&format!("stages[{stage}]")));
    let scene = scene
        .with("stages[1].duration", "6000 s")
        .add("events", r#"{ above = "1 mm/s", below = "0.1 mm/s", stop_after = 4 }"#);
    let done = texts::simulate(&scene.text()?)?;
    let mut plan = one(SPRINGS[1], History::Constant(LOAD), 6e3)?;
    sliders::events(&mut plan, 4);
    let run = cycles::run(&plan, &mut ())?;
    let wanted = SliderEntry::all(&run);
    let bounds = Bounds { onset: 1e-4, slip: 2e-4, drop: 2e-4, peak: 5e-4 };
    let because =
        "the default bounds the error of friction of a step by 2e-6, and a few add up in a drop of 7e-2";
    against_slider(ledger, name, (&done, &wanted, bounds), |claim| {
        claim
            .evidence(Evidence::SemiAnalytic, SLIDER)
            .because(because)
            .covers(&[Capability::InterfaceStates, Capability::Events])
    })?;
    Ok((done, wanted))
}

/// Claims moment magnitudes of the column's events in space.
fn magnitudes(ledger: &mut Ledger, done: &BodyRun, wanted: &[SliderEntry]) -> Result<(), CaseError> {
    let found: Option<Vec<f64>> = events(done)?.iter().map(|event| event.magnitude).collect();
    let of = |slip: f64| (SHEAR * WIDTH * DEPTH * slip).log10() / 1.5 - 9.1 / 1.5;
    let wanted: Vec<f64> = wanted.iter().filter_map(|event| event.slip).map(of).collect();
    ledger
        .claim("moment magnitudes of the column's events in space")
        .values(&found.ok_or("an event in space has no magnitude")?)
        .equals_each(&wanted)
        .absolute(1e-4)
        .evidence(
            Evidence::SemiAnalytic,
            "Mw = (log10 M0 - 9.1)/1.5 (IASPEI 2013) with G times the face times the slip of the slider",
        )
        .because("slip has a bound of 2e-4, which is 6e-5 of its logarithm over 1.5")
        .why_not_tighter("the bound of slip is that of the claim on it")
        .covers(&[Capability::InterfaceStates, Capability::Events])
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Bounds of the relative errors of events.
#[derive(Clone, Copy)]
pub(super) struct Bounds {
    pub onset: f64,
    pub slip: f64,
    pub drop: f64,
    pub peak: f64,
}

/// Claims that the column's events are those of a slider; `finish` adds evidence and reasons. A peak slip rate is that of a step's
/// end.
///
/// # Errors
/// If the scene has no events.
pub(super) fn against_slider(
    ledger: &mut Ledger,
    of_what: &str,
    (done, wanted, bounds): (&BodyRun, &[SliderEntry], Bounds),
    finish: impl for<'a> Fn(Draft<'a>) -> Draft<'a>,
) -> Result<(), CaseError> {
    let found = events(done)?;
    let mut claim = |what: &str, unit: &str, values: Vec<f64>, reference: Vec<f64>, bound: f64| {
        let claim = ledger.claim(format!("{what} of {of_what}")).unit(unit);
        let claim = claim.values(&values).equals_each(&reference).relative(bound);
        finish(claim).cost(&done.cost).record();
    };
    let each = |of: fn(&Entry) -> f64| found.iter().map(of).collect::<Vec<f64>>();
    let of = |of: fn(&SliderEntry) -> Option<f64>| wanted.iter().filter_map(of).collect::<Vec<f64>>();
    let since: Vec<f64> = each(|e| e.onset).iter().map(|t| t - PRESSED).collect();
    // The drop of friction: the catalogue of surfaces leaves out what is radiated at onset and end, that of sliders does not.
    let fall = of(|e| Some(NORMAL * (e.at_onset.friction - e.at_end.as_ref()?.friction)));
    claim("onset", "s", since, of(|e| Some(e.onset)), bounds.onset);
    claim("slip", "m", each(|e| e.mean_slip), of(|e| e.slip), bounds.slip);
    claim("stress drop", "Pa", each(|e| e.stress_drop), fall, bounds.drop);
    claim("peak slip rate", "m/s", each(|e| e.peak_rate), of(|e| Some(e.peak_rate)), bounds.peak);
    Ok(())
}

/// The block, with these lines of its enforcement.
fn block_scene(enforcement: &str) -> SceneText {
    SceneText::new(BLOCK).with_or_same("interfaces.face.enforcement", enforcement)
}

/// Enforcement by a penalty of so many E/h.
fn penalty(times: u32) -> String {
    format!(r#"{{ kind = "penalty", normal = "{times} E/h", tangential = "{times} E/h" }}"#)
}

/// Enforcement without compliance.
const MULTIPLIERS: &str = r#"{ kind = "augmented-lagrangian", normal = "1 E/h", tangential = "1 E/h" }"#;

/// Duration of the stage that presses the block \[s\].
const BLOCK_PRESSED: f64 = 10.0;

/// The block with ten cells through each half. A face that slips as a whole needs no more.
fn coarse(scene: SceneText) -> SceneText {
    let size = |scene: SceneText, body: &str| scene.with(&format!("bodies.{body}.mesh.block.size"), "2.5 mm");
    ["A", "B"].into_iter().fold(scene, size)
}

/// First onset \[s\], last interval \[s\] and stress drop \[Pa\] of the block as a fault that a stage has pressed.
fn as_fault(scene: SceneText, number: usize) -> Result<[f64; 3], CaseError> {
    let mut plan = seas::plan(&scene.text()?)?;
    plan.problem.settings.most_events = Some(number);
    let found = seas::found(&plan, &plan.problem.settings, |_| {})?;
    let last = |e: &[Event<Rupture>]| e[e.len() - 1].onset.since(&e[e.len() - 2].onset);
    let drop = |e: &Event<Rupture>| {
        let (slip, drop) = (e.details.slip.component(0), e.details.drop.component(0));
        let over =
            |f: &dyn Fn(usize) -> f64| (0..slip.len()).map(|p| f(p) * plan.points[p].area).sum::<f64>();
        over(&|p| slip[p] * drop[p]) / over(&|p| slip[p].abs())
    };
    Ok([found.events[0].onset.seconds(), last(&found.events), drop(&found.events[number - 1])])
}

/// First onset since the end of pressing \[s\], last interval \[s\] and stress drop \[Pa\] of a run.
fn cycle(done: &BodyRun) -> Result<[f64; 3], CaseError> {
    let all = events(done)?;
    let (first, last) = all.first().zip(all.last()).ok_or("there was no event")?;
    Ok([first.onset - BLOCK_PRESSED, last.interval.ok_or("there was one event")?, last.stress_drop])
}

/// The whole face slips together: the interface against the fault, and the limit of its penalty.
fn block(ledger: &mut Ledger) -> Result<(), CaseError> {
    let wanted = as_fault(coarse(fault_pressing::block::pressed("4000 s")), 3)?;
    let exact = texts::simulate(&coarse(block_scene(MULTIPLIERS)).text()?)?;
    against(ledger, "the whole face slips together", (cycle(&exact)?, wanted, 2e-4), &exact);
    let [_, interval, _] = wanted;
    let mut levels = Vec::new();
    for times in [4, 20, 100] {
        let done = texts::simulate(&coarse(block_scene(&penalty(times))).text()?)?;
        levels.push((1.0 / f64::from(times), (cycle(&done)?[1] / interval - 1.0).abs()));
    }
    ledger
        .order("interval with a penalty against that of the fault, by the compliance of the penalty")
        .levels(&levels)
        .expected(1.0)
        .within(0.2)
        .floor(Floor::Rounding, 1e-9)
        .finest(1e-3, "a penalty of 100 E/h adds a hundredth of a cell's compliance on both sides of the face, of twenty cells")
        .evidence(Evidence::ConvergedSelf, CONDENSED)
        .because("normal traction and stiffness change in proportion to the compliance of springs in series")
        .why_not_tighter("errors of steps of 1e-5 of the interval")
        .covers(&[Capability::InterfaceStates])
        .cost(&exact.cost)
        .record();
    ledger.picture(
        "Mises stress after pressing",
        body_plots::recorded(&exact.record, "")?,
        "The block of the case.",
    );
    Ok(())
}

/// Claims that intervals and stress drops are those of the fault.
fn against(
    ledger: &mut Ledger,
    what: &str,
    (found, wanted, bound): ([f64; 3], [f64; 3], f64),
    done: &BodyRun,
) {
    ledger
        .claim(format!("first onset over that of the fault, last interval and stress drop likewise, multipliers, {what}"))
        .values(&found.iter().zip(wanted).map(|(a, b)| a / b).collect::<Vec<f64>>())
        .equals_each(&[1.0; 3])
        .relative(bound)
        .evidence(Evidence::ConvergedSelf, CONDENSED)
        .because("the same elements without a penalty; the default bounds the error of friction of a step by 2e-6, of a drop of 0.3")
        .why_not_tighter("steps of a rupture add up their errors where it begins and where it ends")
        .covers(&[Capability::InterfaceStates, Capability::Events])
        .cost(&done.cost)
        .record();
}

/// Ruptures cross the face at 10 m/s of slip rate.
fn ruptures(ledger: &mut Ledger) -> Result<(), CaseError> {
    let fault = fault_pressing::block::pressed("4000 s")
        .with_or_same("faults.face.law.l", "0.5 um")
        .with_or_same("stages[1].conditions[0].y.spring", "1.4e10");
    let wanted = as_fault(fault, 3)?;
    let scene = block_scene(MULTIPLIERS)
        .with("interfaces.face.law.l", "0.5 um")
        .with("stages[1].conditions[1].y.spring", "1.4e10")
        .add("time.friction_tolerance", "1e-5");
    let done = texts::simulate(&scene.text()?)?;
    against(ledger, "ruptures cross it", (cycle(&done)?, wanted, 1e-3), &done);
    Ok(())
}

/// Change of friction from one point of a curve to the next.
const SEEN: f64 = 2e-3;

/// Points of a curve of friction between which it changes enough to be seen.
pub(super) fn thinned(curve: impl Iterator<Item = (f64, f64)>) -> Vec<(f64, f64)> {
    let mut kept: Vec<(f64, f64)> = Vec::new();
    for point in curve {
        if kept.last().is_none_or(|last| (last.1 - point.1).abs() > SEEN) {
            kept.push(point);
        }
    }
    kept
}

/// The scene of the double direct shear test.
fn direct(ledger: &mut Ledger) -> Result<(), CaseError> {
    let done = texts::simulate(&SceneText::new(DIRECT).with("events.stop_after", 6).text()?)?;
    let all = events(&done)?;
    let intervals: Vec<f64> = all.iter().skip(2).filter_map(|e| e.interval).collect();
    let (least, most) = intervals.iter().fold((f64::INFINITY, 0.0_f64), |(l, m), &t| (l.min(t), m.max(t)));
    ledger
        .claim("double direct shear: number of events, and the longest over the shortest interval after the first")
        .values(&[all.len() as f64, most / least])
        .equals_each(&[6.0, 1.0])
        .absolute(1e-5)
        .evidence(Evidence::ConvergedSelf, "a limit cycle: the same blocks under the same load")
        .because("steps of one cycle and the next are all but the same, and so are their errors")
        .why_not_tighter("where steps fall depends on the rounding of times")
        .covers(&[Capability::InterfaceStates, Capability::Events])
        .cost(&done.cost)
        .record();
    let springs: Vec<_> =
        done.record.samples().iter().map(|s| s.springs.first().copied().flatten()).collect();
    let histories = done.record.histories();
    let friction = |k: usize| {
        histories
            .iter()
            .map(|h| h.points.iter().map(|p| p.area[k] * p.shear_traction[k]).sum::<f64>().abs())
            .sum::<f64>()
    };
    let off = springs
        .iter()
        .enumerate()
        .filter_map(|(k, s)| Some((s.as_ref()?.force.abs() / friction(k) - 1.0).abs()));
    ledger
        .claim("double direct shear: largest difference of the load cell from the friction of both faces, relative")
        .value(off.fold(0.0, f64::max))
        .at_most(1e-8)
        .evidence(Evidence::Exact, "balance of the middle block, which nothing else holds along y")
        .because("Newton's method ends at 1e-11 of the largest force of a term, some 1e3 times that of the spring")
        .why_not_tighter("tractions fall to a few per cent of the pressed ones after an event")
        .covers(&[Capability::InterfaceStates])
        .cost(&done.cost)
        .record();
    let curve = springs.iter().flatten().map(|s| (1e3 * s.load_point.abs(), s.friction));
    let curve = thinned(curve);
    ledger.plot(
        Plot::xy("double direct shear", "displacement of the load point [mm]", "macroscopic friction [-]")
            .series(Series::line("load cell over normal forces", &curve))
            .caption("The first six events of scenes/stick-slip.toml."),
    );
    Ok(())
}
