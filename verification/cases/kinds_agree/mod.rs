//! The same fault through cycles, with mass and as an interface, and the same block as a slider.

mod scenes;
mod shapes;

use crate::cases::slider_scene;
use crate::cases::written::{self, Folder, Waves, WrittenRun};
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger};
use asperity::kinds;
use scenes::{AREA, DAMPING, DURATION, HEIGHT, LAW, MODULUS, NORMAL, SHEAR, STEPS, TOLERANCE};
use serde_json::Value;

/// See the README.
pub const CASE: Case = Case {
    name: "kinds_agree",
    readme: include_str!("README.md"),
    covers: &[Capability::Outputs],
    quick: true,
    run,
};

/// Traction of the stiffness that is not felt before waves return, over eta V: 2 c_s T/H.
const NOT_RETURNED: f64 = 1e-2;

/// Files and report of a run.
struct KindRun {
    kind: &'static str,
    files: Folder,
    report: Value,
    cost: Cost,
}

/// Values at the end in closed form.
struct Exact {
    slip: f64,
    rate: f64,
    friction: f64,
    /// Work of friction, and energy that is radiated \[J/m²\].
    works: [f64; 2],
    /// Slip rate at the end over that at the start.
    falls: f64,
}

/// Friction under a slip rate, and its derivative by ln V \[Pa\].
fn strength(rate: f64) -> [f64; 2] {
    let [mu0, a, v0] = LAW;
    let x = 0.5 * rate / v0 * (mu0 / a).exp();
    [NORMAL * a * x.asinh(), NORMAL * a * x / x.hypot(1.0)]
}

/// Slip rate under this traction without slip \[m/s\], by Newton's method in ln V.
fn start() -> f64 {
    (0..60).fold(1e-3_f64, |rate, _| {
        let [f, slope] = strength(rate);
        rate * ((SHEAR - f - DAMPING * rate) / (slope + DAMPING * rate)).clamp(-1.0, 1.0).exp()
    })
}

impl Exact {
    fn new() -> Self {
        let (k, first, n) = (MODULUS / HEIGHT, start(), 20_000);
        // dt = -(f' + eta V)/(k V) dln V, where f' is the slope by ln V; in equal steps of time by the rule of the midpoint.
        let dt = DURATION / f64::from(n);
        let fall = |rate: f64| -k * rate / (strength(rate)[1] + DAMPING * rate);
        let (mut log, mut works) = (first.ln(), [0.0; 2]);
        for _ in 0..n {
            let middle = (log + 0.5 * dt * fall(log.exp())).exp();
            log += dt * fall(middle);
            works[0] += dt * middle * strength(middle)[0];
            works[1] += dt * DAMPING * middle * middle;
        }
        let rate = log.exp();
        let f = strength(rate)[0];
        Self {
            slip: (SHEAR - f - DAMPING * rate) / k,
            rate,
            friction: f / NORMAL,
            works,
            falls: 1.0 - rate / first,
        }
    }
}

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let exact = Exact::new();
    let all = [cycles()?, mass()?, interface()?, block(start())?];
    values(ledger, &all, &exact)?;
    energies(ledger, &all, &exact)?;
    let with_inertia = inertia()?;
    let [cycles, mass, interface, block] = all;
    let all = [cycles, mass, interface, block, with_inertia];
    shapes::claims(ledger, &all)
}

fn cycles() -> Result<KindRun, CaseError> {
    let WrittenRun { report, files, cost, .. } = WrittenRun::from_text(&scenes::cycles(start()))?;
    Ok(KindRun { kind: "cycles", files, report: serde_json::to_value(report)?, cost })
}

fn mass() -> Result<KindRun, CaseError> {
    let Waves { report, files, cost } = Waves::from_text(&scenes::mass(start()))?;
    Ok(KindRun { kind: "bodies with mass", files, report: serde_json::to_value(report)?, cost })
}

fn interface() -> Result<KindRun, CaseError> {
    let (files, cost) = written::bodies(&scenes::interface(false))?;
    let report = serde_json::from_str(&files.text("report.json")?)?;
    Ok(KindRun { kind: "an interface", files, report, cost })
}

/// The interface between bodies with inertia, whose files have energies.
fn inertia() -> Result<KindRun, CaseError> {
    let (files, cost) = written::bodies(&scenes::interface(true))?;
    let report = serde_json::from_str(&files.text("report.json")?)?;
    Ok(KindRun { kind: "an interface of bodies with inertia", files, report, cost })
}

fn block(rate: f64) -> Result<KindRun, CaseError> {
    let (problem, files) = (slider_scene::plan(&scenes::block(rate))?, Folder::new()?);
    let mut histories = kinds::sliders::Histories::create(files.path(), &problem)?;
    let (run, cost) = Cost::measure(|| asperity_cycles::slider::run(&problem, &mut histories));
    let run = run?;
    histories.finish()?;
    let report = kinds::sliders::Report::new(&problem, &run);
    std::fs::write(files.path().join("events.csv"), kinds::sliders::csv(&report.events))?;
    Ok(KindRun { kind: "a slider", files, report: serde_json::to_value(report)?, cost })
}

/// The last number of a column of a table.
fn last(files: &Folder, file: &str, column: &str) -> Result<f64, CaseError> {
    Ok(*files.table(file)?.column(column)?.last().ok_or("a table without rows")?)
}

/// Slip, slip rates, friction and displacement at the end.
fn values(ledger: &mut Ledger, all: &[KindRun; 4], exact: &Exact) -> Result<(), CaseError> {
    let [cycles, mass, interface, block] = all;
    // Backward Euler takes the rate at the end of each step.
    let euler = exact.falls / STEPS as f64;
    let of_steps = "Euler's rate is that at the end of a step, and falls by as much within one";
    let of_tolerance = "errors of ln V per step";
    let of_waves = "no wave has returned from the far sides, where the spring takes 2 c_s T/H of eta V";
    let station = "stations/main_dp000";
    let probes = "probes/main.csv";
    let slips = [
        (cycles, station, "slip", exact.slip, 100.0 * TOLERANCE, of_tolerance),
        (mass, station, "slip", exact.slip, NOT_RETURNED, of_waves),
        (interface, probes, "slip [m] at x = 1; y = 0 m", exact.slip, euler, of_steps),
        (block, "history/main.csv", "slip", exact.slip, 100.0 * TOLERANCE, of_tolerance),
        (interface, probes, "slip_rate [m/s] at x = 1; y = 0 m", exact.rate, 2.0 * euler, of_steps),
        (block, "history/main.csv", "slip_rate", exact.rate, 100.0 * TOLERANCE, of_tolerance),
        (interface, probes, "friction [-] at x = 1; y = 0 m", exact.friction, euler, of_steps),
        (block, "history/main.csv", "friction", exact.friction, 100.0 * TOLERANCE, of_tolerance),
        // The upper layer moves against x, and its middle half as far as its lower side.
        (cycles, "points/tip.csv", "displacement_x", -0.25 * exact.slip, 100.0 * TOLERANCE, of_tolerance),
        (interface, "points/tip.csv", "displacement_x", -0.25 * exact.slip, euler, of_steps),
    ];
    for (ran, file, column, value, bound, because) in slips {
        let (name, found) = (column.split(" [").next().unwrap_or(column), last(&ran.files, file, column)?);
        claim(ledger, ran, (&format!("{name} in {file}"), found), value, (bound, because));
    }
    let mega = 1e6;
    let logs = [
        (cycles, "slip_rate", exact.rate.log10(), 100.0 * TOLERANCE, of_tolerance),
        (cycles, "shear_stress", exact.friction * NORMAL / mega, 100.0 * TOLERANCE, of_tolerance),
        (mass, "shear_stress", exact.friction * NORMAL / mega, NOT_RETURNED, of_waves),
    ];
    for (ran, column, value, bound, because) in logs {
        let found = last(&ran.files, station, column)?;
        claim(ledger, ran, (&format!("{column} in {station}"), found), value, (bound, because));
    }
    let found = last(&cycles.files, "rate_profiles.csv", "1")?;
    claim(
        ledger,
        cycles,
        ("rate_profiles.csv", found),
        exact.rate.log10(),
        (5e-4, "three decimals are written"),
    );
    let found = last(&mass.files, "rate_profiles.csv", "1")?;
    let ringing =
        "columns of cells ring after the start, by less than a tenth of the slip rate: log10(1.1)/1.6";
    claim(ledger, mass, ("rate_profiles.csv", found), exact.rate.log10(), (3e-2, ringing));
    Ok(())
}

fn claim(
    ledger: &mut Ledger,
    ran: &KindRun,
    (name, found): (&str, f64),
    value: f64,
    (bound, because): (f64, &str),
) {
    ledger
        .claim(format!("a fault that slides at once, as {}: {name}", ran.kind))
        .value(found)
        .equals(value)
        .relative(bound)
        .evidence(Evidence::Exact, "k delta = tau - f(V) - eta V, and the quadrature of its time")
        .because(because)
        .why_not_tighter("errors are bounded step by step, and cancel in part")
        .covers(&[Capability::Outputs])
        .cost(&ran.cost)
        .record();
}

/// Works per area at the end.
fn energies(
    ledger: &mut Ledger,
    [cycles, mass, _, block]: &[KindRun; 4],
    exact: &Exact,
) -> Result<(), CaseError> {
    let of = |ran: &KindRun, group: &str, part: &str, area: f64| {
        let value = ran.report["energy"][group][part].as_f64();
        Ok::<f64, CaseError>(value.ok_or_else(|| format!("no energy {group}/{part}"))? / area)
    };
    let tight = (100.0 * TOLERANCE, "errors of ln V per step");
    let waves = (NOT_RETURNED, "slip without the stiffness of the layers");
    for (ran, area, bound) in [(cycles, AREA, tight), (mass, AREA, waves), (block, 1.0, tight)] {
        claim(ledger, ran, ("work of friction", of(ran, "lost", "friction", area)?), exact.works[0], bound);
    }
    for (ran, area) in [(cycles, AREA), (block, 1.0)] {
        claim(ledger, ran, ("radiated energy", of(ran, "lost", "radiated", area)?), exact.works[1], tight);
    }
    // What is radiated is kinetic and elastic energy of the waves, of which damping takes a little.
    let parts = [("kept", "kinetic"), ("kept", "elastic"), ("lost", "viscous")];
    let sum = parts.iter().map(|(group, part)| of(mass, group, part, AREA)).sum::<Result<f64, _>>()?;
    let twice = (2.0 * NOT_RETURNED, "twice the bound of slip, since energy is quadratic in slip rates");
    claim(ledger, mass, ("energy of the waves", sum), exact.works[1], twice);
    Ok(())
}
