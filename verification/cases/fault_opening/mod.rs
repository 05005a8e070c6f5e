//! Faults that open: cracks in a plate under tension, and shallow faults through events.

mod ramps;

use crate::cases::seas;
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger};
use asperity::kinds::faults::Report;
use asperity_cycles::{Balance, OPENING};
use asperity_ode::{Control, Outcome};
use asperity_plan::faults::Plan;
use asperity_vary::SceneText;

/// See the README.
pub const CASE: Case = Case {
    name: "fault_opening",
    readme: include_str!("README.md"),
    covers: &[
        Capability::FaultCycles,
        Capability::PlaneStrain,
        Capability::Solid3d,
        Capability::Loads,
        Capability::Events,
    ],
    quick: true,
    run,
};

const NORMAL: &str = include_str!("normal.toml");
const THRUST: &str = include_str!("thrust.toml");
const YOUNG: f64 = 80e9;
const POISSON: f64 = 0.25;
const SHEAR_MODULUS: f64 = 32e9;
/// Final half length of the cracks \[m\]; the fault is twice as long.
const A: f64 = 1000.0;
/// Half size of the plate over the half length: its fixed sides change openings by a fraction of order 1/FAR².
const FAR: f64 = 200.0;
/// Final tension less the initial pressure in the middle of the fault \[Pa\].
const PULL: f64 = 10e6;
/// Initial pressure in the middle \[Pa\].
const PRESSED: f64 = 1e6;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    apart(ledger)?;
    ramps::claims(ledger)?;
    uniform(ledger)?;
    smooth(ledger)?;
    shallow(ledger)
}

/// Two blocks without lateral contraction, each 1 km long, pulled apart by 1 m: in the plane, and in 3D with slip along one
/// direction or with vector slip.
fn apart(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (kinematics, element, slip) in [
        ("plane-strain", "quad9", ""),
        ("3d", "hex8", "rake = [0, 1, 1]"),
        ("3d", "hex27", "rake = [0, 1, 1]\nslip = \"free\""),
    ] {
        let (opening, cost) = Cost::measure(|| parted(kinematics, element, slip));
        let (least, most) = opening?;
        // Less the elongation at which the fault opens, from the stiffness of both blocks.
        let exact = 1.0 - PRESSED * 2.0 * A / YOUNG;
        ledger
            .claim(format!("least and largest opening between two blocks that are pulled apart, {kinematics}, {element}"))
            .unit("m")
            .values(&[least, most])
            .equals_each(&[exact, exact])
            .relative(1e-9)
            .evidence(Evidence::Exact, "way - f_n l/E: what is left of the way when nothing presses any more")
            .because("a patch test: rounding of the elimination, and of f_n, which is integrated under a constant rate")
            .why_not_tighter("the rounding of an elimination differs between processors")
            .covers(&[Capability::FaultCycles, Capability::Solid3d, Capability::Loads])
            .cost(&cost)
            .record();
    }
    Ok(())
}

/// A block between these places along x \[m\], in the plane or in space.
fn block(name: &str, [from, to]: [f64; 2], flat: bool, element: &str) -> String {
    let (min, max, divisions) = if flat {
        (format!("[{from:?}, 0.0]"), format!("[{to:?}, 600.0]"), "[3, 4]")
    } else {
        (format!("[{from:?}, 0.0, 0.0]"), format!("[{to:?}, 600.0, 400.0]"), "[3, 4, 3]")
    };
    format!(
        "[bodies.{name}]\nmaterial = \"rock\"\nmesh.block = {{ min = {min}, max = {max}, divisions = {divisions}, element = \"{element}\" }}\n"
    )
}

/// Smallest and largest final opening between the blocks \[m\].
fn parted(kinematics: &str, element: &str, slip: &str) -> Result<(f64, f64), CaseError> {
    let flat = kinematics != "3d";
    let across = if flat { "y = 0" } else { "y = 0, z = 0" };
    let text = format!(
        r#"
schema = 1
title = "two blocks"
kinematics = "{kinematics}"
[materials.rock]
young = {YOUNG:?}
poisson = 0.0
density = 2670.0
{}{}
[faults.main]
minus = "L.right"
plus = "R.left"
law = {{ kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.02, b = 0.015, l = "0.1 m", v_ref = "1 um/s", v_initial = "1e-12 m/s" }}
normal = {PRESSED:?}
normal_floor = "10 kPa"
opening = true
rate = "1e-12 m/s"
damping = "radiation"
{slip}
[[stages]]
name = "pulled"
duration = "1 d"
conditions = [{{ set = "L.left", x = 0, {across} }}, {{ set = "R.right", x = {{ to = 1.0 }}, {across} }}]
[time]
stepper = "fault-ode"
method = "stabilised"
"#,
        block("L", [-A, 0.0], flat, element),
        block("R", [0.0, A], flat, element)
    );
    let plan = seas::plan(&text)?;
    let mut opening = Vec::new();
    seas::found(&plan, &plan.problem.settings, |now| {
        opening = (0..plan.points.len()).filter_map(|p| now.at(&OPENING, p)).collect();
    })?;
    Ok(opening.iter().fold((f64::INFINITY, 0.0_f64), |(l, m), o| (l.min(*o), m.max(*o))))
}

/// A plate with cells of this size along a fault across its middle, pulled steadily up to the tension [`PULL`]. `normal` lists
/// points of initial normal traction against distance along the fault, whose middle is at 2 [`A`].
fn plate(size: f64, normal: &[(f64, f64)]) -> String {
    let half = FAR * A;
    // Top and bottom are free: no stress along the fault.
    let way = (PULL + PRESSED) * (1.0 - POISSON * POISSON) / YOUNG * half;
    let points: Vec<String> = normal.iter().map(|(s, f)| format!("[{s:?}, {f:?}]")).collect();
    format!(
        r#"
schema = 1
title = "a crack"
kinematics = "plane-strain"
[materials.rock]
young = {YOUNG:?}
poisson = {POISSON}
density = 2670.0
[bodies.plate]
material = "rock"
mesh.fault = {{ trace = [[0.0, {:?}], [0.0, {:?}]], spacing = {size:?}, min = [{:?}, {:?}], max = [{half:?}, {half:?}], growth = 1.25, element = "quad9" }}
[faults.main]
minus = "plate.fault.minus"
plus = "plate.fault.plus"
law = {{ kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.02, b = 0.015, l = "0.1 m", v_ref = "1 um/s", v_initial = "1e-15 m/s" }}
profiles.normal = {{ along = "distance", points = [{}] }}
normal_floor = "10 kPa"
opening = true
rate = "1e-15 m/s"
damping = "radiation"
[[stages]]
name = "pulled"
duration = "1 yr"
conditions = [{{ set = "plate.left", x = {{ to = {:?} }} }}, {{ set = "plate.right", x = {{ to = {way:?} }} }}, {{ set = "plate.bottom", y = 0 }}]
[time]
stepper = "fault-ode"
method = "stabilised"
"#,
        2.0 * A,
        -2.0 * A,
        -half,
        -half,
        points.join(", "),
        -way
    )
}

/// Tension at a time, less the initial pressure in the middle \[Pa\].
fn pull(time: f64) -> f64 {
    (PULL + PRESSED) * time / seas::YEAR - PRESSED
}

/// Results of a plate.
struct PlateRun {
    /// Positions of the points relative to the middle of the fault \[m\].
    at: Vec<f64>,
    opening: Vec<f64>,
    slip: Vec<f64>,
    /// Drop of the shear traction in the middle \[Pa\].
    fall: f64,
    /// Times and the distance of the farthest open point from the middle.
    fronts: Vec<(f64, f64)>,
    /// Work of the openings \[J/m\].
    work: f64,
    /// Imbalance of the energy budget.
    imbalance: f64,
    cost: Cost,
}

fn pulled(plan: &Plan) -> Result<PlateRun, CaseError> {
    let at: Vec<f64> = plan.points.iter().map(|p| p.along - 2.0 * A).collect();
    let n = at.len();
    let middle = (0..n).min_by(|&i, &j| at[i].abs().total_cmp(&at[j].abs())).ok_or("no points")?;
    let mut balance = Balance::new(&plan.problem);
    let (mut opening, mut slip, mut fronts) = (Vec::new(), Vec::new(), Vec::new());
    let mut shear = [f64::NAN; 2];
    let mut look = |now: &asperity_cycles::Moment<'_>| {
        balance.step(now);
        opening = (0..n).map(|p| now.at(&OPENING, p).unwrap_or(f64::NAN)).collect();
        slip = now.slip().all().to_vec();
        let open = (0..n).filter(|&p| opening[p] > 0.0).map(|p| at[p].abs());
        fronts.extend(open.reduce(f64::max).map(|front| (now.at.seconds(), front)));
        let friction = now.normal(middle) * plan.problem.fault.law.scale(middle) * now.unknowns[middle];
        shear = [if shear[0].is_nan() { friction } else { shear[0] }, friction];
        Control::Go
    };
    let (out, cost) = Cost::measure(|| plan.problem.run(&plan.problem.settings, &mut look));
    let out = out?;
    if out.outcome != Outcome::Completed {
        return Err(format!("{:?}", out.outcome).into());
    }
    let energy = Report::new(plan, &out, &mut balance).energy;
    let cost = cost.count("points", n as f64).count("steps", out.counts.steps as f64);
    let (work, imbalance) = (energy.part("opening"), energy.imbalance);
    Ok(PlateRun { at, opening, slip, fall: shear[0] - shear[1], fronts, work, imbalance, cost })
}

impl PlateRun {
    /// Error in the middle and largest error, both over the exact value in the middle.
    fn errors(&self, found: &[f64], peak: f64, shape: impl Fn(f64) -> f64) -> [f64; 2] {
        let mut nearest = (f64::INFINITY, 0.0);
        let mut largest = 0.0_f64;
        for (x, value) in self.at.iter().zip(found) {
            let error = (value / peak - shape(x / A)).abs();
            largest = largest.max(error);
            if x.abs() < nearest.0 {
                nearest = (x.abs(), error);
            }
        }
        [nearest.1, largest]
    }
}

/// Opening or slip in the middle of a crack per change of traction \[m/Pa\].
const COMPLIANCE: f64 = 2.0 * (1.0 - POISSON) * A / SHEAR_MODULUS;
const SNEDDON: &str =
    "2 (1 - nu) p/G sqrt(a^2 - x^2), a crack in the plane under uniform traction (Sneddon 1946)";

/// A weakly compressed part of the fault between parts that the tension cannot open: it opens from end to end, and slips as it
/// releases its initial shear traction.
fn uniform(ledger: &mut Ledger) -> Result<(), CaseError> {
    let edge = 1e-3;
    let normal = [(A, 1e9), (A + edge, PRESSED), (3.0 * A - edge, PRESSED), (3.0 * A, 1e9)];
    let (mut openings, mut slips, mut last) = (Vec::new(), Vec::new(), None);
    let ellipse = |u: f64| (1.0 - u * u).max(0.0).sqrt();
    for cells in [10, 20, 40, 80] {
        let size = 2.0 * A / f64::from(cells);
        let found = pulled(&seas::plan(&plate(size, &normal))?)?;
        let opening = found.errors(&found.opening, COMPLIANCE * PULL, ellipse);
        openings.push((size, opening[0]));
        slips.push((size, found.errors(&found.slip, COMPLIANCE * found.fall, ellipse)[0]));
        last = Some((found, opening[1], size));
    }
    let (found, largest, size) = last.ok_or("no level")?;
    for (what, levels) in [("opening", &openings), ("slip", &slips)] {
        ledger
            .order(format!("{what} in the middle of a crack that opens under a uniform pull"))
            .norm("relative error")
            .levels(levels)
            .expected(1.0)
            .within(0.1)
            .evidence(Evidence::Exact, SNEDDON)
            .because("the square root at the tips, which uniform cells of any order miss by O(h)")
            .finest(
                0.6 * 2.0 / 80.0,
                "cells of 1/40 of the half length; the crack looks longer or shorter by a part of a cell at each tip",
            )
            .why_not_tighter("the order changes by a tenth with where the square root falls between the points of few cells")
            .covers(&[Capability::FaultCycles, Capability::PlaneStrain, Capability::Loads])
            .cost(&found.cost)
            .record();
    }
    ledger
        .claim("largest error of the opening over that in the middle, 80 cells")
        .value(largest)
        .at_most(0.2 * (size / A).sqrt())
        .evidence(Evidence::Exact, SNEDDON)
        .because("at the tips opening changes within a cell by sqrt(2 h/a) of that in the middle; a seventh of it is missed on uniform cells")
        .covers(&[Capability::FaultCycles, Capability::PlaneStrain])
        .cost(&found.cost)
        .record();
    let work = std::f64::consts::PI * (1.0 - POISSON) * (PULL * A).powi(2) / (2.0 * SHEAR_MODULUS);
    ledger
        .claim("work of the pull on the opening, 80 cells")
        .unit("J/m")
        .value(found.work)
        .equals(work)
        .relative(2.0 * 0.6 * 2.0 / 80.0)
        .evidence(Evidence::Exact, "pi (1 - nu) p^2 a^2/(2 G), the energy of the same crack")
        .because("twice what the opening in the middle may be off: length and opening")
        .covers(&[Capability::FaultCycles])
        .cost(&found.cost)
        .record();
    closes(ledger, "a crack that opens and slips", found.imbalance, &found.cost);
    Ok(())
}

/// Claims that an energy budget closes.
fn closes(ledger: &mut Ledger, what: &str, imbalance: f64, cost: &Cost) {
    ledger
        .claim(format!("imbalance of the energy budget over its largest part, {what}"))
        .value(imbalance)
        .at_most(1e-4)
        .evidence(Evidence::Exact, "conservation of energy")
        .because("ten times the tolerance of ln V: the integrator knows none of the works")
        .why_not_tighter("errors of single steps add up in their own way in each run")
        .covers(&[Capability::FaultCycles])
        .cost(cost)
        .record();
}

/// Pressure on the fault grows with the square of the distance from its middle: the crack front is where the crack closes
/// smoothly, without a singularity.
fn smooth(ledger: &mut Ledger) -> Result<(), CaseError> {
    let exact = "(4 (1 - nu)/(3 G)) p a (1 - x^2/a^2)^(3/2), a^2 = A^2 p/P, where p - 2 P x^2/A^2 pulls: by Chebyshev polynomials";
    let mut levels = Vec::new();
    let mut last = None;
    for size in [400.0, 200.0, 100.0, 50.0] {
        // A profile point at each fault point, so that the traction is exact there.
        let at = |k: u32| 0.25 * size * f64::from(k);
        let count = (16.0 * A / size).round() as u32;
        let normal: Vec<(f64, f64)> =
            (0..=count).map(|k| (at(k), PRESSED + 2.0 * PULL * (at(k) / A - 2.0).powi(2))).collect();
        let found = pulled(&seas::plan(&plate(size, &normal))?)?;
        let shape = |u: f64| (1.0 - u * u).max(0.0).powf(1.5);
        let peak = COMPLIANCE * PULL * 2.0 / 3.0;
        levels.push((size, found.errors(&found.opening, peak, shape)[1]));
        last = Some((found, size));
    }
    let (found, size) = last.ok_or("no level")?;
    ledger
        .order("opening of a crack that closes smoothly")
        .norm("largest error over the opening in the middle")
        .levels(&levels)
        .expected(1.5)
        .within(0.25)
        .or_better()
        .evidence(Evidence::Exact, exact)
        .because("the power 3/2 at the front, which cells of second order miss by that power of their size; the front is found, not given")
        .finest((size / A).powi(2), "cells of second order where opening is smooth, and in the last one before the front a part of (2 h/a)^(3/2)")
        .why_not_tighter("errors at the front depend on where it lies in its cell, and the sides of the plate change all by up to 1e-4")
        .covers(&[Capability::FaultCycles, Capability::PlaneStrain, Capability::Loads])
        .cost(&found.cost)
        .record();
    let exact_front = |time: f64| A * (pull(time) / PULL).max(0.0).sqrt();
    // Cracks of fewer than ten points on either side are not resolved yet.
    let long = found.fronts.iter().filter(|(time, _)| exact_front(*time) > 5.0 * size);
    let off = |&(time, front): &(f64, f64)| (front - exact_front(time)).abs();
    ledger
        .claim("distance between the farthest open point and the front of the crack, largest of all steps, over that between points")
        .norm("while it is longer than ten points to either side")
        .value(long.map(off).fold(0.0, f64::max) / (0.5 * size))
        .at_most(1.5)
        .evidence(Evidence::Exact, "a = A sqrt(p/P): the crack that is open does not depend on how it came about")
        .because("the front lies between the last open point and the next; half a distance more where the cells put it elsewhere")
        .why_not_tighter("the front passes each point at some time, when the distance is a whole one")
        .covers(&[Capability::FaultCycles, Capability::Loads])
        .cost(&found.cost)
        .record();
    closes(ledger, "a crack that grows", found.imbalance, &found.cost);
    Ok(())
}

/// Results of a shallow fault through three events.
struct Shallow {
    /// Onsets \[yr\].
    onsets: Vec<f64>,
    report: Report,
    cost: Cost,
}

fn events(text: &str, floor: f64, opens: bool) -> Result<Shallow, CaseError> {
    let scene = SceneText::new(text)
        .with_or_same("faults.main.normal_floor", format!("{floor} MPa"))
        .with_or_same("faults.main.opening", opens);
    let plan = seas::plan(&scene.text()?)?;
    let mut balance = Balance::new(&plan.problem);
    let mut look = |now: &asperity_cycles::Moment<'_>| {
        balance.step(now);
        Control::Go
    };
    let (out, cost) = Cost::measure(|| plan.problem.run(&plan.problem.settings, &mut look));
    let out = out?;
    let report = Report::new(&plan, &out, &mut balance);
    if report.events.len() < 3 {
        return Err(format!("only {} events: {:?}", report.events.len(), out.outcome).into());
    }
    let cost = cost.counts(&report.counts);
    let onsets = report.events.iter().map(|e| e.onset / seas::YEAR).collect();
    Ok(Shallow { onsets, report, cost })
}

/// Floors of the normal traction \[MPa\], each half of the previous one.
const FLOORS: [f64; 4] = [1.0, 0.5, 0.25, 0.125];

fn shallow(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut rows = Vec::new();
    let mut thrusts = Vec::new();
    for floor in FLOORS {
        thrusts.push(events(THRUST, floor, true)?);
    }
    let normal = [false, true].map(|opens| events(NORMAL, FLOORS[1], opens));
    let [closed, open] = normal;
    let (closed, open, held) = (closed?, open?, events(THRUST, FLOORS[1], false)?);
    let mut row = |name: &str, floor: f64, found: &Shallow| {
        let opened = found.report.openings.first();
        let use_ = &found.report.floors[0];
        rows.push([
            name.to_string(),
            format!("{floor}"),
            format!("{:.3}", found.onsets[2]),
            format!("{:.3}", found.report.events[2].largest_slip),
            format!("{:.2}", use_.least / 1e6),
            opened.map_or("-".into(), |o| format!("{:.4} at {} points", o.largest, o.points)),
        ]);
    };
    row("normal, floor alone", FLOORS[1], &closed);
    row("normal, opens", FLOORS[1], &open);
    row("thrust, floor alone", FLOORS[1], &held);
    for (floor, found) in FLOORS.iter().zip(&thrusts) {
        row("thrust, opens", *floor, found);
    }
    ledger.table(
        "shallow faults",
        &[
            "fault",
            "floor [MPa]",
            "third event [yr]",
            "its largest slip [m]",
            "least normal traction [MPa]",
            "largest opening [m]",
        ],
        rows,
    );
    for (name, found) in [("a normal fault through events", &open), ("a thrust through events", &thrusts[1])]
    {
        closes(ledger, name, found.report.energy.imbalance, &found.cost);
        pulls(ledger, name, &found.report, &found.cost);
    }
    let recurrence = thrusts[3].onsets[2] - thrusts[3].onsets[1];
    let change = |k: usize| (FLOORS[k], (thrusts[k].onsets[2] - thrusts[k + 1].onsets[2]).abs() / recurrence);
    ledger
        .order("third event of the thrust, as the floor falls")
        .norm("change of its onset by half the floor, over the recurrence")
        .levels(&[change(0), change(1), change(2)])
        .expected(1.0)
        .within(0.25)
        .or_better()
        .evidence(Evidence::ConvergedSelf, "the floor against half of it")
        .because("friction of open points is proportional to the floor, and where they are does not depend on it")
        .finest(2e-3, "a quarter of 1 MPa at two of 35 points, under some 20 MPa in the mean: half of it is 6e-4 of the strength; and more where an event begins elsewhere")
        .why_not_tighter("events begin at points: a change that moves a hypocentre by one is not proportional to its cause")
        .covers(&[Capability::Events])
        .cost(&thrusts[3].cost)
        .record();
    Ok(())
}

/// Claims that a fault bears no tension and that it has opened.
fn pulls(ledger: &mut Ledger, what: &str, report: &Report, cost: &Cost) {
    let (floor, opened) = (&report.floors[0], &report.openings[0]);
    ledger
        .claim(format!("least normal traction that the bodies exert, {what}"))
        .unit("Pa")
        .value(floor.least)
        .equals(0.0)
        .absolute(1e-3)
        .evidence(Evidence::Exact, "open sides press nothing, and closed ones do not pull")
        .because("1e-13 of what pulls, which is some MPa at most")
        .why_not_tighter("it is exact where any point is open; else it may be positive")
        .covers(&[Capability::Events])
        .cost(cost)
        .record();
    ledger
        .claim(format!("largest opening, {what}"))
        .unit("m")
        .value(opened.largest)
        .at_least(1e-3)
        .evidence(Evidence::Exact, "with the floor alone the bodies pull by more than 1 MPa over cells of 500 m: 2 (1 - nu)/G of that times 250 m is a centimetre")
        .because("a tenth of that")
        .why_not_tighter("an opening that is missing is what it guards against")
        .covers(&[Capability::Events])
        .cost(cost)
        .record();
}
