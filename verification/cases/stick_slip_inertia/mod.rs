//! A rigid column that sticks and slips, from equilibrium to inertia and back.

use super::slider;
use super::stick_slip::{self, WIDTH};
use super::texts::{self, BodyRun};
use crate::{Capability, Case, CaseError, Evidence, Ledger, Plot, Series};
use asperity::kinds::sliders::Entry as SliderEntry;
use asperity_cycles::slider as cycles;
use asperity_friction::slider::History;
use asperity_vary::SceneText;

/// See the README.
pub const CASE: Case = Case {
    name: "stick_slip_inertia",
    readme: include_str!("README.md"),
    covers: &[Capability::Handover, Capability::Inertia, Capability::InterfaceStates, Capability::Events],
    quick: true,
    run,
};

/// Stiffness of the machine \[N/m\].
const SPRING: f64 = 3e8;
/// Compliance of the column and of its penalty \[m/Pa\]: 0.2 m of 4e15 Pa, and 1e16 Pa/m.
const COMPLIANCE: f64 = 0.2 / 4e15 + 1e-16;
/// Mass of the column over its foot \[kg/m²\]: 0.2 m of 2700 kg/m³.
const MASS: f64 = 540.0;
/// Impedance of the slider with damping \[Pa s/m\].
const DAMPING: f64 = 5e6;
/// Number of events.
const EVENTS: usize = 4;
/// Source of the references.
const SLIDER: &str = "one slider with mass on a spring, Radau IIA of order 5 at 1e-10";

/// The column with these slip rates of the hand-over.
fn scene(above: &str, below: &str) -> SceneText {
    (2..6)
        .rev()
        .fold(stick_slip::column(SPRING), |scene, stage| scene.without(&format!("stages[{stage}]")))
        .without("interfaces.fault.damping")
        .with("materials.column.young", "1e7 GPa")
        .add("materials.column.density", "2700 kg/m^3")
        .with("interfaces.fault.enforcement.tangential", "1e7 GPa/m")
        .with("stages[1].duration", "6000 s")
        .with("time.stepper", "auto")
        .add("time.handover", format!(r#"{{ above = "{above}", below = "{below}" }}"#))
        .add("events", format!(r#"{{ above = "1 mm/s", below = "0.1 mm/s", stop_after = {EVENTS} }}"#))
}

/// Events of the slider with this damping \[Pa s/m\] and mass \[kg/m²\].
fn slider(damping: f64, mass: Option<f64>) -> Result<Vec<SliderEntry>, CaseError> {
    let mut plan = stick_slip::slider(
        COMPLIANCE + WIDTH / SPRING,
        (damping, mass),
        History::Constant(stick_slip::LOAD),
        6e3,
    )?;
    slider::events(&mut plan, EVENTS);
    Ok(SliderEntry::all(&cycles::run(&plan, &mut ())?))
}

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let done = texts::simulate(&scene("1 mm/s", "0.1 mm/s").text()?)?;
    let wanted = slider(0.0, Some(MASS))?;
    events(ledger, &done, &wanted)?;
    overshoot(ledger, &done, &wanted)?;
    handover(ledger, &done)?;
    ledger.plot(
        Plot::xy("stick-slip of the column", "time [s]", "friction [-]")
            .series(Series::line("column", &stick_slip::thinned(friction(&done).into_iter())))
            .caption(
                "Four events with inertia; between them the column passes through states of equilibrium.",
            ),
    );
    Ok(())
}

/// Times and friction of the first point.
fn friction(done: &BodyRun) -> Vec<(f64, f64)> {
    let points = &done.record.histories()[0].points;
    let first = points.first().map_or(&[][..], |p| &p.friction);
    done.record.times().iter().copied().zip(first.iter().copied()).collect()
}

fn events(ledger: &mut Ledger, done: &BodyRun, wanted: &[SliderEntry]) -> Result<(), CaseError> {
    let bounds = stick_slip::Bounds { onset: 2e-4, slip: 5e-4, drop: 1e-4, peak: 3e-4 };
    stick_slip::against_slider(ledger, "the column's events with inertia", (done, wanted, bounds), |claim| {
        claim
            .evidence(Evidence::SemiAnalytic, SLIDER)
            .because("the default bounds the error of friction of a step by 2e-6, and a few add up in a drop of 0.15")
            .why_not_tighter("the steps of the slider and of the column fall differently, and so do their errors")
            .covers(&[Capability::Handover, Capability::Inertia, Capability::Events])
    })
}

/// Slip with inertia over that with damping, in the limit cycle.
fn overshoot(ledger: &mut Ledger, done: &BodyRun, wanted: &[SliderEntry]) -> Result<(), CaseError> {
    let last = |events: &[SliderEntry]| events.last().and_then(|e| e.slip).ok_or("no event");
    let damped = last(&slider(DAMPING, None)?)?;
    let found = stick_slip::events(done)?.last().ok_or("no event")?.mean_slip;
    ledger
        .claim("slip of the last event over that of a slider with damping instead of mass")
        .value(found / damped)
        .equals(last(wanted)? / damped)
        .relative(5e-4)
        .evidence(Evidence::SemiAnalytic, SLIDER)
        .because("as the slip of events; twice the slip to the balance of the spring with friction at speed, and a little more since friction falls with speed")
        .covers(&[Capability::Handover])
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Errors of the hand-over, and how little they matter.
fn handover(ledger: &mut Ledger, done: &BodyRun) -> Result<(), CaseError> {
    let mut last = Vec::new();
    for (above, below) in [("10 mm/s", "1 mm/s"), ("0.1 mm/s", "10 um/s")] {
        let other = texts::simulate(&scene(above, below).text()?)?;
        last.push(stick_slip::events(&other)?.last().and_then(|e| e.interval).ok_or("one event")?);
    }
    let interval = stick_slip::events(done)?.last().and_then(|e| e.interval).ok_or("one event")?;
    ledger
        .claim("last interval with hand-overs at 10 mm/s and 0.1 mm/s, over that with 1 mm/s")
        .values(&last.iter().map(|t| t / interval).collect::<Vec<f64>>())
        .equals_each(&[1.0; 2])
        .relative(5e-5)
        .evidence(Evidence::ConvergedSelf, "the same column with inertia from a hundredth of the slip rate on")
        .because("forces of inertia are 1e-5 of those of the spring at 10 mm/s; steps differ, and so do their errors")
        .covers(&[Capability::Handover])
        .cost(&done.cost)
        .record();
    let passages = &done.report.passages;
    ledger
        .claim("number of passages with inertia")
        .value(passages.len() as f64)
        .equals(EVENTS as f64)
        .absolute(1e-5)
        .evidence(Evidence::Exact, "one for each event: a column that has come to rest sticks")
        .because("a count")
        .covers(&[Capability::Handover])
        .cost(&done.cost)
        .record();
    energies(
        ledger,
        done,
        [1e-7, 2e-7],
        [
            "a column that returns below 0.1 mm/s after 0.5 m/s has 4e-8 of the energy",
            "friction lets the column creep in the return, which takes some energy from the spring",
            "the trapezoidal rule is exact for a linear column; rounding of displacements moves the forces of a column that is a million times as stiff as its spring",
        ],
    );
    Ok(())
}

/// Claims on the energy that is lost in returns, and on the budget: their bounds, the source of the first, and the reasons of both.
pub(super) fn energies(
    ledger: &mut Ledger,
    done: &BodyRun,
    bounds: [f64; 2],
    [source, lost, missing]: [&str; 3],
) {
    let most = done.report.passages.iter().map(|p| p.lost.abs()).fold(0.0, f64::max);
    ledger
        .claim("largest share of the kinetic energy lost in the return")
        .value(most)
        .at_most(bounds[0])
        .evidence(Evidence::Exact, source)
        .because(lost)
        .covers(&[Capability::Handover])
        .cost(&done.cost)
        .record();
    ledger
        .claim("largest part of the energy budget that is missing, over its largest part")
        .value(done.report.energy.imbalance)
        .at_most(bounds[1])
        .evidence(Evidence::Exact, "conservation of energy")
        .because(missing)
        .covers(&[Capability::Handover, Capability::Inertia])
        .cost(&done.cost)
        .record();
}
