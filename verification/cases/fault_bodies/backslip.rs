//! Loads by backslip between bodies: a plane fault against sides and creep, and normal tractions of a curved one.

use crate::cases::cycle_run::CycleRun;
use crate::cases::run_files::WrittenRun;
use crate::cases::seas;
use crate::{Capability, CaseError, Evidence, Ledger};
use asperity_plan::faults::Plan;
use asperity_vary::SceneText;
use std::fmt::Write as _;

/// A vertical strike-slip fault through a plate, whose lower part creeps.
const PLANE: &str = include_str!("../fault_balance/scene.toml");

/// Compares both loads on plane faults, and follows a curved one.
pub(super) fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    plane(ledger)?;
    beside(ledger)?;
    curved(ledger)
}

/// The plane fault, loaded by sides and creep, and by backslip, in this direction of slip.
fn both(sense: &str) -> Result<[Plan; 2], CaseError> {
    let scene = SceneText::new(PLANE)
        .with("events.stop_after", "3")
        // At the rate of the plates it would be in equilibrium, and rounding would start its first event.
        .with("faults.main.rate", format!("{sense}1e-10 m/s"))
        .with_or_same("faults.main.creep.rate", format!("{sense}1e-9 m/s"));
    let sides = if sense == "-" { ["0.5e-9 m/s", "-0.5e-9 m/s"] } else { ["-0.5e-9 m/s", "0.5e-9 m/s"] };
    let moved = scene
        .clone()
        .with_or_same("stages[0].conditions[0].z.rate", sides[0])
        .with_or_same("stages[0].conditions[1].z.rate", sides[1]);
    let held = scene
        .add("faults.main.creep.loading", "backslip")
        .with("stages[0].conditions[0].z", "0")
        .with("stages[0].conditions[1].z", "0");
    Ok([seas::plan(&moved.text()?)?, seas::plan(&held.text()?)?])
}

/// Claims that backslip of a plane fault loads it as sides and creep do, and that cycles are the same.
fn plane(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut worst = 0.0_f64;
    for sense in ["", "-"] {
        let rates = both(sense)?.map(|plan| plan.problem.loading.rates(1.0, plan.points.len(), false).0);
        let scale = rates[0].iter().fold(0.0_f64, |m, r| m.max(r.abs()));
        let off = rates[0].iter().zip(&rates[1]).map(|(a, b)| (a - b).abs());
        worst = off.fold(worst, |m, d| m.max(d / scale));
    }
    let plans = both("")?;
    let loads = plans.each_ref().map(|plan| plan.problem.loading.clone());
    let [moved, held] = plans;
    let [moved, held] = [CycleRun::with(&moved, TOLERANCE)?, CycleRun::with(&held, TOLERANCE)?];
    ledger
        .claim("backslip of a plane fault against sides and creep, both senses of slip: loads, largest difference over the largest")
        .value(worst)
        .at_most(1e-12)
        .evidence(Evidence::Exact, "plates that slip everywhere at one rate move as rigid blocks: no tractions")
        .because("rounding of two eliminations, whose loads are differences of tractions of single points that are thousands of times larger")
        .why_not_tighter("rounding depends on the order of elimination")
        .covers(&[Capability::FaultCycles, Capability::Antiplane])
        .cost(&held.cost)
        .record();
    let third = |found: &CycleRun| found.onsets().get(2).map(|t| t / seas::YEAR).ok_or("no third event");
    ledger
        .claim("onset of the third event by backslip against sides and creep")
        .unit("yr")
        .value(third(&held)?)
        .equals(third(&moved)?)
        .between(&loads[0], &loads[1])
        .relative(1e-9)
        .evidence(Evidence::Exact, "the same loads")
        .because("loads differ by rounding, and the time of an event by as much as its loads")
        .why_not_tighter("rounding of the loads, as above")
        .covers(&[Capability::FaultCycles, Capability::Events])
        .cost(&held.cost)
        .record();
    ledger
        .claim("imbalance of energy over its largest part, three events by backslip")
        .value(held.report.energy.imbalance)
        .at_most(0.5 * TOLERANCE)
        .evidence(
            Evidence::Exact,
            "work of loads on slip = elastic energy + work of friction + radiated energy",
        )
        .because("half a tolerance, as in the case fault_balance")
        .covers(&[Capability::FaultCycles])
        .cost(&held.cost)
        .record();
    Ok(())
}

/// Distance of the sides from the fault, and of the positions that are followed \[m\].
const SIDES: f64 = 8e3;
const PLACES: [f64; 4] = [-8e3, -3e3, 1e3, 8e3];
/// Rate of the plates \[m/s\], and the duration \[s\].
const PLATES: f64 = 1e-9;
const LASTS: f64 = 1e7;

/// Blocks beside a locked fault that cuts them apart, loaded by sides that move at this rate past each other, or by backslip.
fn locked(creep: &str, sides: f64) -> String {
    let block = |name: &str, [from, to]: [f64; 2]| {
        format!(
            "[bodies.{name}]\nmaterial = \"rock\"\nmesh.block = {{ min = [{from:?}, -4000.0], max = [{to:?}, 0.0], divisions = [4, 2], element = \"quad4\" }}\n"
        )
    };
    let place = |(k, x): (usize, &f64)| {
        let body = if *x < 0.0 { "L" } else { "R" };
        format!(
            "receivers.r{k} = [{x:?}, -1300.0]\npoints.p{k} = {{ body = \"{body}\", at = [{x:?}, -1300.0] }}\n"
        )
    };
    format!(
        r#"
schema = 1
title = "beside a locked fault"
kinematics = "antiplane"
[materials.rock]
young = "80 GPa"
poisson = 0.25
density = 2670
{}{}[faults.main]
minus = "L.right"
plus = "R.left"
law = {{ kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.02, b = 0.015, l = "30 mm", v_ref = "1 um/s", v_initial = "1e-9 m/s" }}
normal = "50 MPa"
rate = 1e-20
damping = "radiation"
{creep}
[[stages]]
name = "locked"
duration = {LASTS:?}
conditions = [{{ set = "L.left", z = {} }}, {{ set = "R.right", z = {} }}]
[time]
stepper = "fault-ode"
[output]
{}"#,
        block("L", [-SIDES, 0.0]),
        block("R", [0.0, SIDES]),
        rate(-0.5 * sides),
        rate(0.5 * sides),
        PLACES.iter().enumerate().map(place).collect::<String>()
    )
}

/// A motion at a rate, or none.
fn rate(rate: f64) -> String {
    if rate == 0.0 { "0".into() } else { format!("{{ rate = {rate:e} }}") }
}

/// Claims the motion of bodies beside a locked fault: with the plates far away.
fn beside(ledger: &mut Ledger) -> Result<(), CaseError> {
    let backslip = format!("creep = {{ rate = {PLATES:e}, loading = \"backslip\" }}");
    for (what, text, plates) in [
        ("moving sides", locked("", PLATES), 0.0),
        ("backslip, with the motion of the plates added", locked(&backslip, 0.0), 0.5 * PLATES),
    ] {
        let done = WrittenRun::from_text(&text)?;
        let mut worst = [0.0_f64; 3];
        for (k, x) in PLACES.into_iter().enumerate() {
            let last = |table: &str, name: &str| -> Result<[f64; 2], CaseError> {
                let table = done.files.table(table)?;
                let time = *table.column("time")?.last().ok_or("no row")?;
                Ok([time, *table.column(name)?.last().ok_or("no row")?])
            };
            let receiver = format!("receivers/r{k}.csv");
            let added = plates * x.signum();
            let found = [
                last(&receiver, "velocity_z")?.map(|v| v + added)[1],
                last(&receiver, "displacement_z").map(|[time, u]| u / time + added)?,
                last(&format!("points/p{k}.csv"), "displacement_z").map(|[time, u]| u / time + added)?,
            ];
            let wanted = 0.5 * PLATES * x / SIDES;
            worst = std::array::from_fn(|k| worst[k].max((found[k] - wanted).abs() / PLATES));
        }
        ledger
            .claim(format!("blocks beside a locked fault, loaded by {what}: velocity and displacement of receivers, and displacement of points, largest errors over those of the plates"))
            .values(&worst)
            .equals_each(&[0.0; 3])
            .absolute(1e-10)
            .evidence(Evidence::Exact, "uniform shear of both blocks as one: V x/(2 W), from the fault to the sides, which move with the plates")
            .because("columns have ten digits, and the fault slides at 1e-11 of the plates at first")
            .why_not_tighter("the slip rate of the fault at the start is a choice")
            .covers(&[Capability::FaultCycles, Capability::Antiplane, Capability::Outputs])
            .cost(&done.cost)
            .record();
    }
    Ok(())
}

/// Tolerance of the runs.
const TOLERANCE: f64 = 1e-5;
/// Number of events of the curved fault.
const EVENTS: usize = 6;

/// A fault along an arc of 40 km and a radius of 40 km in a plate, plane strain, which strengthens towards its ends; `parts` holds its creep,
/// and the sides move along y at these rates.
fn arc(creep: &str, sides: [&str; 2]) -> Result<Plan, CaseError> {
    let mut trace = String::new();
    for k in -2..=2 {
        let (s, c) = (0.25 * f64::from(k)).sin_cos();
        let _ = write!(trace, "[{:?}, {:?}], ", 40e3 * (c - 1.0), -40e3 * s);
    }
    seas::plan(&format!(
        r#"
schema = 1
title = "a curved fault"
kinematics = "plane-strain"
[materials.rock]
young = "80 GPa"
poisson = 0.25
density = 2670
[bodies.plate]
material = "rock"
mesh.fault = {{ trace = [{trace}], spacing = "500 m", min = ["-200 km", "-200 km"], max = ["200 km", "200 km"], growth = 1.4, element = "quad4" }}
[faults.main]
minus = "plate.fault.minus"
plus = "plate.fault.plus"
law = {{ kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.010, b = 0.015, l = "30 mm", v_ref = "1 um/s", v_initial = "1e-9 m/s" }}
profiles.a = {{ along = "distance", points = [["8 km", 0.025], ["10 km", 0.010], ["30 km", 0.010], ["32 km", 0.025]] }}
normal = "50 MPa"
rate = "1e-10 m/s"
damping = "radiation"
{creep}
[[stages]]
name = "cycles"
duration = "8000 yr"
conditions = [{{ set = "plate.left", x = 0, y = {} }}, {{ set = "plate.right", x = 0, y = {} }}]
[time]
stepper = "fault-ode"
[events]
above = "1e-3 m/s"
stop_after = {EVENTS}
"#,
        sides[0], sides[1]
    ))
}

/// Largest change of normal traction of any point from the end of the third event to that of the last, over that at the start, and the
/// events of the run.
fn drift(plan: &Plan) -> Result<(f64, seas::CycleResults), CaseError> {
    let mut ends: Vec<Vec<f64>> = Vec::new();
    let found = seas::found(plan, &plan.problem.settings, |now| {
        if now.events().len() > ends.len() {
            ends.push((0..plan.points.len()).map(|p| now.normal(p)).collect());
        }
    })?;
    let [_, _, third, .., last] = ends.as_slice() else { return Err("too few events".into()) };
    let moved = third.iter().zip(last).zip(&plan.problem.fault.normal).map(|((a, b), f)| (b - a).abs() / f);
    Ok((moved.fold(0.0, f64::max), found))
}

/// Claims that normal tractions of a curved fault return with backslip, and that they drift where the sides move.
fn curved(ledger: &mut Ledger) -> Result<(), CaseError> {
    let lagging = arc("creep = { rate = \"1e-9 m/s\", loading = \"backslip\" }", ["0", "0"])?;
    let n = lagging.points.len();
    let shear = lagging.problem.fault.operator.shear_of(&vec![1e-9; n]);
    let normal = lagging.problem.fault.operator.normal_of(&vec![1e-9; n]);
    let loads = lagging.problem.loading.rates(1.0, n, true);
    let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, |m: f64, v| m.max(v.abs()));
    let left =
        |of_slip: &[f64], of_loads: &[f64]| largest(&mut of_slip.iter().zip(of_loads).map(|(a, b)| a + b));
    ledger
        .claim("curved fault that slips at the rate of its plates: rates of shear and normal tractions over those of its load")
        .value(left(&shear, &loads.0).max(left(&normal, &loads.1)) / largest(&mut loads.0.iter().copied()))
        .at_most(1e-14)
        .evidence(Evidence::Exact, "there is no deficit")
        .because("rounding of the same sums with both signs")
        .why_not_tighter("the sums may be formed in another order")
        .covers(&[Capability::FaultCycles, Capability::PlaneStrain])
        .record();
    let (still, found) = drift(&lagging)?;
    let sheared = arc("", ["{ rate = \"-5e-9 m/s\" }", "{ rate = \"5e-9 m/s\" }"])?;
    let (drifted, other) = drift(&sheared)?;
    ledger
        .claim("curved fault by backslip: normal tractions at the end of the sixth event against that of the third, largest change over the start")
        .value(still)
        .at_most(1e-3)
        .evidence(Evidence::Exact, "tractions follow the deficit, which returns in a cycle that repeats itself")
        .because("slip per cycle of 3 m changes normal tractions by some percent, and cycles repeat to better than a hundredth of it after three events")
        .why_not_tighter("how well cycles repeat depends on how soon the start is forgotten")
        .covers(&[Capability::FaultCycles, Capability::PlaneStrain, Capability::Events])
        .cost(&found.cost)
        .record();
    ledger
        .claim("the same between sides that move past each other")
        .value(drifted)
        .at_least(0.05)
        .evidence(Evidence::Exact, "the sign: slip along an arc strains what it leads to, and nothing takes the strain back")
        .because("slip per cycle over the radius, 3 m/40 km, times 80 GPa is 6 MPa of 50 MPa, where the fault ends; three cycles pass")
        .why_not_tighter("it is an estimate, of which the middle of the fault has a part")
        .covers(&[Capability::FaultCycles, Capability::PlaneStrain])
        .cost(&other.cost)
        .record();
    ledger.table(
        "onsets of events on a curved fault",
        &["by backslip [yr]", "between moving sides [yr]"],
        found.onsets.iter().zip(&other.onsets).map(|(a, b)| [format!("{a:.3}"), format!("{b:.3}")]),
    );
    Ok(())
}
