//! The same fault through cycles, with mass and as an interface, in the plane and in space, and the same block as a slider.

mod scenes;
mod shapes;

use crate::cases::run_files::{self, Folder, Waves, WrittenRun};
use crate::cases::slider_scene;
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger};
use asperity::kinds;
use scenes::{AREA, DAMPING, DURATION, HEIGHT, Idealisation, LAW, MODULUS, NORMAL, SHEAR, STEPS, TOLERANCE};
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
    let (exact, block) = (Exact::new(), block(start())?);
    let [plane, space] = [faults(Idealisation::Plane)?, faults(Idealisation::Space)?];
    for (all, idealised) in [(&plane, Idealisation::Plane), (&space, Idealisation::Space)] {
        values(ledger, all, idealised, &exact)?;
        energies(ledger, all, &exact)?;
        viscous(ledger, &all[1])?;
    }
    profiles(ledger, &plane, &exact)?;
    slider(ledger, &block, &exact)?;
    let [cycles, mass, interface] = plane;
    shapes::claims(ledger, &[cycles, mass, interface, block, inertia()?])?;
    shapes::in_space(ledger, &space)
}

/// The fault through cycles, between bodies with mass, and as an interface.
fn faults(idealised: Idealisation) -> Result<[KindRun; 3], CaseError> {
    Ok([cycles(idealised)?, mass(idealised)?, interface(idealised)?])
}

fn cycles(idealised: Idealisation) -> Result<KindRun, CaseError> {
    let WrittenRun { report, files, cost, .. } = WrittenRun::from_text(&scenes::cycles(idealised, start()))?;
    let kind = idealised.choose("cycles", "cycles in space");
    Ok(KindRun { kind, files, report: serde_json::to_value(report)?, cost })
}

fn mass(idealised: Idealisation) -> Result<KindRun, CaseError> {
    let Waves { report, files, cost } = Waves::from_text(&scenes::mass(idealised, start()))?;
    let kind = idealised.choose("bodies with mass", "bodies with mass in space");
    Ok(KindRun { kind, files, report: serde_json::to_value(report)?, cost })
}

fn interface(idealised: Idealisation) -> Result<KindRun, CaseError> {
    let (files, cost) = run_files::bodies(&scenes::interface(idealised, false))?;
    let report = serde_json::from_str(&files.text("report.json")?)?;
    Ok(KindRun { kind: idealised.choose("an interface", "an interface in space"), files, report, cost })
}

/// The interface between bodies with inertia, whose files have energies.
fn inertia() -> Result<KindRun, CaseError> {
    let (files, cost) = run_files::bodies(&scenes::interface(Idealisation::Plane, true))?;
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

/// Reason of bounds of integrators with error control.
const STEPWISE: &str = "errors of ln V per step";
/// Bound of what such integrators find.
const TIGHT: (f64, &str) = (100.0 * TOLERANCE, STEPWISE);
/// Bound of what bodies with mass find.
const WAVES: (f64, &str) =
    (NOT_RETURNED, "no wave has returned from the far sides, where the spring takes 2 c_s T/H of eta V");
const MEGA: f64 = 1e6;

/// Slip, slip rates, friction and displacement of a fault at the end.
fn values(
    ledger: &mut Ledger,
    [cycles, mass, interface]: &[KindRun; 3],
    idealised: Idealisation,
    exact: &Exact,
) -> Result<(), CaseError> {
    let station = idealised.choose("stations/main_dp000", "stations/main_000");
    let [slip, rate, shear] =
        idealised.choose(["slip", "slip_rate", "shear_stress"], ["slip_2", "slip_rate_2", "shear_stress_2"]);
    // Backward Euler takes the rate at the end of each step.
    let euler = exact.falls / STEPS as f64;
    let of_steps = "Euler's rate is that at the end of a step, and falls by as much within one";
    let (once, twice) = ((euler, of_steps), (2.0 * euler, of_steps));
    let (probes, tip) = ("probes/main.csv", "points/tip.csv");
    let all = [
        (cycles, station, slip, exact.slip, TIGHT),
        (mass, station, slip, exact.slip, WAVES),
        (interface, probes, "slip", exact.slip, once),
        (interface, probes, "slip_rate", exact.rate, twice),
        (interface, probes, "friction", exact.friction, once),
        // The upper layer moves against x, and its middle half as far as its lower side.
        (cycles, tip, "displacement_x", -0.25 * exact.slip, TIGHT),
        (interface, tip, "displacement_x", -0.25 * exact.slip, once),
        (cycles, station, rate, exact.rate.log10(), TIGHT),
        (cycles, station, shear, exact.friction * NORMAL / MEGA, TIGHT),
        (mass, station, shear, exact.friction * NORMAL / MEGA, WAVES),
    ];
    for (ran, file, column, value, bound) in all {
        let found = last(&ran.files, file, column)?;
        claim(ledger, ran, (&format!("{column} in {file}"), found), value, bound);
    }
    Ok(())
}

/// Slip rates in profiles, which runs in the plane write.
fn profiles(ledger: &mut Ledger, [cycles, mass, _]: &[KindRun; 3], exact: &Exact) -> Result<(), CaseError> {
    let ringing =
        "columns of cells ring after the start, by less than a tenth of the slip rate: log10(1.1)/1.6";
    for (ran, bound) in [(cycles, (5e-4, "three decimals are written")), (mass, (3e-2, ringing))] {
        let found = last(&ran.files, "rate_profiles.csv", "1")?;
        claim(ledger, ran, ("rate_profiles.csv", found), exact.rate.log10(), bound);
    }
    Ok(())
}

/// Values and energies of the slider at the end.
fn slider(ledger: &mut Ledger, block: &KindRun, exact: &Exact) -> Result<(), CaseError> {
    let file = "history/main.csv";
    for (column, value) in [("slip", exact.slip), ("slip_rate", exact.rate), ("friction", exact.friction)] {
        let found = last(&block.files, file, column)?;
        claim(ledger, block, (&format!("{column} in {file}"), found), value, TIGHT);
    }
    for (name, part, work) in
        [("work of friction", "friction", exact.works[0]), ("radiated energy", "radiated", exact.works[1])]
    {
        claim(ledger, block, (name, energy(block, "lost", part)?), work, TIGHT);
    }
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

/// A part of the energy at the end.
fn energy(ran: &KindRun, group: &str, part: &str) -> Result<f64, CaseError> {
    let value = ran.report["energy"][group][part].as_f64();
    Ok(value.ok_or_else(|| format!("no energy {group}/{part}"))?)
}

/// Energy that damping of bodies with mass takes, in all rows of their table.
fn viscous(ledger: &mut Ledger, mass: &KindRun) -> Result<(), CaseError> {
    let table = mass.files.table("energy.csv")?;
    let column = |name: &str| table.column(name);
    let (found, mut left) = (column("viscous")?, column("start")?);
    let parts = [
        ("loads", 1.0),
        ("motions", 1.0),
        ("released", 1.0),
        ("kinetic", -1.0),
        ("elastic", -1.0),
        ("friction", -1.0),
        ("absorbed", -1.0),
    ];
    for (name, sign) in parts {
        left.iter_mut().zip(column(name)?).for_each(|(left, part)| *left += sign * part);
    }
    let largest = found.iter().copied().fold(0.0, f64::max);
    if largest <= 0.0 {
        return Err("damping takes no energy".into());
    }
    ledger
        .claim(format!("a fault that slides at once, as {}: viscous in energy.csv, all rows, over its largest", mass.kind))
        .norm("largest difference through time")
        .values(&found.iter().map(|value| value / largest).collect::<Vec<_>>())
        .equals_each(&left.iter().map(|value| value / largest).collect::<Vec<_>>())
        .absolute(1e-6)
        .evidence(Evidence::Exact, "what is given less what is kept and lost in the other columns: central differences keep the balance")
        .because("rounding of some thousand steps of parts that are some thousand times as large")
        .why_not_tighter("roundings of single steps cancel in part")
        .covers(&[Capability::Outputs])
        .cost(&mass.cost)
        .record();
    Ok(())
}

/// Works of a fault per area at the end.
fn energies(ledger: &mut Ledger, [cycles, mass, _]: &[KindRun; 3], exact: &Exact) -> Result<(), CaseError> {
    let of = |ran: &KindRun, group: &str, part: &str| Ok::<f64, CaseError>(energy(ran, group, part)? / AREA);
    let waves = (NOT_RETURNED, "slip without the stiffness of the layers");
    for (ran, bound) in [(cycles, TIGHT), (mass, waves)] {
        claim(ledger, ran, ("work of friction", of(ran, "lost", "friction")?), exact.works[0], bound);
    }
    claim(ledger, cycles, ("radiated energy", of(cycles, "lost", "radiated")?), exact.works[1], TIGHT);
    // What is radiated is kinetic and elastic energy of the waves, of which damping takes a little.
    let parts = [("kept", "kinetic"), ("kept", "elastic"), ("lost", "viscous")];
    let sum = parts.iter().map(|(group, part)| of(mass, group, part)).sum::<Result<f64, _>>()?;
    let twice = (2.0 * NOT_RETURNED, "twice the bound of slip, since energy is quadratic in slip rates");
    claim(ledger, mass, ("energy of the waves", sum), exact.works[1], twice);
    Ok(())
}
