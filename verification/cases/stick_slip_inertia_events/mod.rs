//! Five events of the laboratory block with inertia, beside the same block with radiation damping.

use super::stick_slip_inertia::energies;
use super::texts::{self, BodyRun};
use super::{slider, stick_slip};
use crate::{Capability, Case, CaseError, Evidence, Ledger, Plot, Series};
use asperity::catalogue::Entry;
use asperity::kinds::sliders::Entry as SliderEntry;
use asperity_cycles::slider as cycles;
use asperity_friction::evolution::ageing::Ageing;
use asperity_friction::rate::RateLaw;
use asperity_friction::slider::{History, Slider};
use asperity_friction::strength::{Parameters, regularised::Regularised};
use asperity_ode::Method;
use asperity_vary::SceneText;
use std::sync::Arc;

/// See the README.
pub const CASE: Case = Case {
    name: "stick_slip_inertia_events",
    readme: include_str!("README.md"),
    covers: &[Capability::Handover, Capability::Inertia, Capability::InterfaceStates, Capability::Events],
    quick: false,
    run,
};

const SCENE: &str = include_str!("../../../scenes/stick-slip-inertia.toml");

/// Parameters of the law; L in \[m\].
const A: f64 = 0.005;
const B: f64 = 0.020;
const LENGTH: f64 = 2e-6;
/// Rate of the load point \[m/s\].
const LOAD: f64 = 1e-6;
/// Impedance of both sides together \[Pa s/m\]: √(20 GPa 2700 kg/m³)/2.
const DAMPING: f64 = 3.674_234_6e6;
/// Mass of the middle block over both faces \[kg/m²\]: 50 mm by 50 mm by 2700 kg/m³ over 100 mm.
const MASS: f64 = 67.5;
/// Slip that tells main events from those of ringing corners \[m\].
const MAIN: f64 = 1e-4;
/// Source of the references.
const SLIDERS: &str = "two sliders with the law of the blocks, one with damping, the other with mass, Radau IIA of order 5 at 1e-10";

/// The main events of a run.
fn main_events(done: &BodyRun) -> Result<Vec<&Entry>, CaseError> {
    Ok(stick_slip::events(done)?.iter().filter(|e| e.mean_slip > MAIN).collect())
}

/// Mean of the quantities of all but the first of several events.
fn settled(events: &[&Entry], of: impl Fn(&Entry) -> f64) -> f64 {
    let later = &events[1..];
    later.iter().map(|e| of(e)).sum::<f64>() / later.len() as f64
}

/// Interval between the later events \[s\].
fn interval(events: &[&Entry]) -> f64 {
    (events[events.len() - 1].onset - events[1].onset) / (events.len() - 2) as f64
}

/// Slip \[m\] and interval \[s\] of the fourth event of a slider of this stiffness \[Pa/m\] under this normal traction \[Pa\].
fn sliding(stiffness: f64, normal: f64, damping: f64, mass: Option<f64>) -> Result<(f64, f64), CaseError> {
    let form = Regularised(Parameters::new(slider::MU0, A, slider::V_REF)?);
    let law = Arc::new(RateLaw::new(form, Ageing::new(B, LENGTH, slider::V_REF)?, LOAD, None)?);
    let block = Slider { law, stiffness, damping, mass, normal: History::Constant(normal) };
    let mut plan = slider::plan(block, History::Constant(LOAD), LOAD, 1.5, 1e4)?;
    (plan.method, plan.tolerance) = (Method::Radau5, 1e-10);
    slider::events(&mut plan, 4);
    let events = SliderEntry::all(&cycles::run(&plan, &mut ())?);
    let (last, before) = (events.get(3).ok_or("too few events")?, &events[2]);
    Ok((last.slip.ok_or("an event without end")?, last.onset - before.onset))
}

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let damped = SceneText::new(SCENE)
        .with("time.stepper", "implicit")
        .without("time.handover")
        .without("time.inertia")
        .add("interfaces.one.damping", "radiation")
        .add("interfaces.other.damping", "radiation");
    let quiet = texts::simulate(&damped.text()?)?;
    let done = texts::simulate(SCENE)?;
    let (with, without) = (main_events(&done)?, main_events(&quiet)?);
    if with.len() < 3 || without.len() < 3 {
        return Err("too few events".into());
    }
    alike(ledger, &done, &with);
    compared(ledger, (&done, &quiet), &with, &without)?;
    energies(
        ledger,
        &done,
        [0.05, 1e-9],
        [
            "blocks that still ring when no point slips any more: a tenth of their largest kinetic energy",
            "friction takes most of the vibrations before they are lost",
            "the trapezoidal rule is exact for linear bodies whose points stay closed",
        ],
    );
    drawn(ledger, &done, &quiet);
    Ok(())
}

fn alike(ledger: &mut Ledger, done: &BodyRun, events: &[&Entry]) {
    let intervals: Vec<f64> = events.windows(2).skip(1).map(|e| e[1].onset - e[0].onset).collect();
    let (least, most) = intervals.iter().fold((f64::INFINITY, 0.0_f64), |(l, m), &t| (l.min(t), m.max(t)));
    ledger
        .claim("number of main events")
        .value(events.len() as f64)
        .equals(5.0)
        .absolute(1e-5)
        .evidence(Evidence::ConvergedSelf, "a limit cycle: the same blocks under the same load")
        .because("a count")
        .covers(&[Capability::Handover, Capability::Events])
        .cost(&done.cost)
        .record();
    ledger
        .claim("longest over shortest interval after the second event")
        .value(most / least)
        .equals(1.0)
        .absolute(0.05)
        .evidence(Evidence::ConvergedSelf, "a limit cycle: the same blocks under the same load")
        .because("an event begins where waves of the last one have left the tractions of single points, some per cent of a drop")
        .covers(&[Capability::Handover, Capability::Events])
        .cost(&done.cost)
        .record();
}

/// Width of both faces together \[m\].
const FACES: f64 = 0.1;

/// Mean normal traction of the faces in an event after `time`, between its values at the largest and the least force of the spring
/// \[Pa\].
fn normal(done: &BodyRun, time: f64) -> f64 {
    let springs = done.record.samples().iter().map(|s| s.springs.first().copied().flatten());
    let later = done.record.times().iter().zip(springs).filter(|(t, _)| **t > time);
    let all: Vec<(f64, f64)> =
        later.filter_map(|(_, s)| s.map(|s| (s.force.abs(), s.force.abs() / (s.friction * FACES)))).collect();
    let most = all.iter().max_by(|a, b| a.0.total_cmp(&b.0)).map_or(f64::NAN, |v| v.1);
    let least = all.iter().min_by(|a, b| a.0.total_cmp(&b.0)).map_or(f64::NAN, |v| v.1);
    0.5 * (most + least)
}

fn compared(
    ledger: &mut Ledger,
    (done, quiet): (&BodyRun, &BodyRun),
    with: &[&Entry],
    without: &[&Entry],
) -> Result<(), CaseError> {
    let stiffness = settled(without, |e| e.stress_drop / e.mean_slip);
    let normal = normal(quiet, without[1].onset);
    let damped = sliding(stiffness, normal, DAMPING, None)?;
    let heavy = sliding(stiffness, normal, 0.0, Some(MASS))?;
    let slow = [settled(without, |e| e.mean_slip) / damped.0, interval(without) / damped.1];
    ledger
        .claim("slip of an event and interval with radiation damping, over those of the slider")
        .values(&slow)
        .equals_each(&[1.0; 2])
        .relative(0.06)
        .evidence(Evidence::SemiAnalytic, SLIDERS)
        .because("normal traction at the corners is half as large again as in the middle, and the faces do not slip at once")
        .covers(&[Capability::InterfaceStates])
        .cost(&done.cost)
        .record();
    let found = [
        settled(with, |e| e.mean_slip) / settled(without, |e| e.mean_slip),
        interval(with) / interval(without),
    ];
    ledger
        .claim("slip of an event and interval with inertia, over those with radiation damping")
        .values(&found)
        .equals_each(&[heavy.0 / damped.0, heavy.1 / damped.1])
        .relative(0.2)
        .evidence(Evidence::SemiAnalytic, SLIDERS)
        .because("waves run into the side blocks and back: up to a fifth of the energy is then that of vibrations, and slip overshoots by less")
        .why_not_tighter("no slider has these vibrations; one with damping of 0.4 MPa s/m beside its mass slips as far as the blocks")
        .covers(&[Capability::Handover, Capability::Inertia])
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Macroscopic friction against displacement of the load point, with and without inertia.
fn drawn(ledger: &mut Ledger, done: &BodyRun, quiet: &BodyRun) {
    let curve = |run: &BodyRun| {
        let springs = run.record.samples().iter().filter_map(|s| s.springs.first().copied().flatten());
        stick_slip::thinned(springs.map(|s| (1e3 * s.load_point.abs(), s.friction)))
    };
    ledger.plot(
        Plot::xy("double direct shear", "displacement of the load point [mm]", "macroscopic friction [-]")
            .series(Series::line("with inertia", &curve(done)))
            .series(Series::line("with radiation damping", &curve(quiet)))
            .caption("scenes/stick-slip-inertia.toml, and the same blocks with radiation damping."),
    );
}
