//! Fluid that diffuses along a line fault from wells, implicitly in time, with permeability and storage of each point.

mod exact;
mod files;

use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger};
use asperity_vary::SceneText;
use exact::{JoinedHalfLines, Side};
use files::FluidRun;

/// See the README.
pub const CASE: Case = Case {
    name: "fluid_along_fault",
    readme: include_str!("README.md"),
    covers: &[Capability::FluidDiffusion, Capability::FaultCycles, Capability::Antiplane],
    quick: true,
    run,
};

const SCENE: &str = include_str!("scene.toml");
/// Flux of the well \[m/s\], and its distance along the fault \[m\].
const FLUX: f64 = 1.25e-6;
const WELL: f64 = 8e3;
/// Time at which two runs are compared, 99 d \[s\].
const LATE: f64 = 99.0 * 86400.0;
/// The layer of the scene.
const LAYER: Side = Side { mobility: 1e-10, storage: 1e-9 };
/// A layer of lower permeability and more storage.
const TIGHT: Side = Side { mobility: 1e-11, storage: 2.5e-9 };
/// Relative error of a number in a table: it has seven digits.
const DIGITS: f64 = 1e-6;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    uniform(ledger)?;
    graded(ledger)?;
    contrast(ledger)?;
    against_injection(ledger)?;
    closed(ledger)?;
    drained(ledger)?;
    energy(ledger)?;
    in_parts(ledger)
}

fn scene() -> SceneText {
    SceneText::new(SCENE)
}

/// The scene with cells of a size \[m\].
fn cells(size: f64) -> SceneText {
    scene().with_or_same("faults.main.line.spacing", format!("{size} m"))
}

/// Largest error of a line over the largest pressure, in the last row of the table.
fn error(ran: &FluidRun, line: &JoinedHalfLines) -> f64 {
    let (time, found) = ran.last();
    let exact: Vec<f64> = ran.positions.iter().map(|x| line.pressure(x - WELL, time)).collect();
    let most = exact.iter().fold(0.0, |m: f64, p| m.max(*p));
    found.iter().zip(exact).map(|(p, exact)| (p - exact).abs() / most).fold(0.0, f64::max)
}

/// Largest error of second order beside a well on a border of equal cells, over the pressure at the well: `h² x² ∂p/∂t/(48 D² t)` at
/// `x² = 4 D t`.
fn estimate(size: f64, time: f64) -> f64 {
    size * size * (-1.0_f64).exp() / (24.0 * LAYER.diffusivity() * time)
}

/// Claims the pressure of a well in a uniform fault.
fn uniform(ledger: &mut Ledger) -> Result<(), CaseError> {
    let line = JoinedHalfLines { sides: [LAYER; 2], well: 0.0, flux: FLUX };
    let (mut errors, mut finest) = (Vec::new(), None);
    for size in [160.0, 80.0, 40.0, 20.0] {
        let ran = FluidRun::from_scene(&cells(size))?;
        errors.push((size, error(&ran, &line)));
        finest = Some(ran);
    }
    let ran = finest.ok_or("no level")?;
    ledger
        .order("pressure along a uniform fault after 100 d, error over the pressure at the well")
        .norm("largest of all points, in pressure_profiles.csv")
        .levels(&errors)
        .expected(2.0)
        .within(0.1)
        .evidence(Evidence::Exact, "p = q/(S sqrt(D)) sqrt(t) ierfc(|x|/sqrt(4 D t)) (Carslaw and Jaeger)")
        .because("finite volumes on equal cells with the well on a border are of second order")
        .finest(
            1.5 * estimate(20.0, ran.last().0),
            "the leading term of the error has the closed form h^2/(24 D t) exp(-1); half of it for terms of higher order and the digits of the table",
        )
        .cost(&ran.cost)
        .record();
    Ok(())
}

/// Claims the pressure on cells of unequal lengths.
fn graded(ledger: &mut Ledger) -> Result<(), CaseError> {
    let line = JoinedHalfLines { sides: [LAYER; 2], well: 0.0, flux: FLUX };
    let (mut errors, mut last) = (Vec::new(), None);
    for size in [20.0, 10.0, 5.0] {
        let spacing =
            format!("[[\"0 km\", \"{0} m\"], [\"8 km\", \"{size} m\"], [\"16 km\", \"{0} m\"]]", 8.0 * size);
        let ran = FluidRun::from_scene(&halves(scene()).with("faults.main.line.spacing", spacing))?;
        errors.push((size, error(&ran, &line)));
        last = Some(ran);
    }
    let ran = last.ok_or("no level")?;
    ledger
        .order("pressure on cells that grow eightfold from the well, error over the pressure at the well")
        .norm("largest of all points, in pressure_profiles.csv")
        .levels(&errors)
        .expected(2.0)
        .within(0.2)
        .evidence(Evidence::Exact, "as above")
        .because("fluxes between the centres of unequal cells have errors of first order that cancel from cell to cell")
        .finest(
            estimate(40.0, ran.last().0),
            "that of equal cells as long as the longest, near the ends, which the fluid does not reach",
        )
        .why_not_tighter("cells where the fluid is are up to a third of that")
        .cost(&ran.cost)
        .record();
    Ok(())
}

/// The scene with a corner of cells at the well, however long they are.
fn halves(scene: SceneText) -> SceneText {
    scene.with(
        "faults.main.line.trace",
        "[[\"0 km\", \"0 km\"], [\"0 km\", \"-8 km\"], [\"0 km\", \"-16 km\"]]",
    )
}

/// Text of profiles of two sides that meet at the middle of the fault.
fn sides(scene: SceneText, [left, right]: [Side; 2]) -> SceneText {
    // Linear over 2 mm, which lie between two points.
    let profile = |of: fn(Side) -> f64| {
        format!(
            "{{ along = \"distance\", points = [[7999.999, {:e}], [8000.001, {:e}]] }}",
            of(left),
            of(right)
        )
    };
    scene
        .without("faults.main.diffusion.permeability")
        .without("faults.main.diffusion.storage")
        .add("faults.main.diffusion.profiles", "{}")
        .add("faults.main.diffusion.profiles.permeability", profile(|side| 1e-3 * side.mobility))
        .add("faults.main.diffusion.profiles.storage", profile(|side| side.storage))
}

/// Claims the pressure of wells at a contrast of permeability and storage, and beside it.
fn contrast(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (name, well) in [("at the contrast", 0.0), ("1 km beside it", 1e3)] {
        let line = JoinedHalfLines { sides: [LAYER, TIGHT], well, flux: FLUX };
        let (mut errors, mut last) = (Vec::new(), None);
        for size in [80.0, 40.0, 20.0] {
            let scene = sides(cells(size), line.sides);
            let scene = scene.with_or_same("faults.main.diffusion.wells[0].at", format!("{} m", WELL - well));
            let ran = FluidRun::from_scene(&scene)?;
            errors.push((size, error(&ran, &line)));
            last = Some(ran);
        }
        let ran = last.ok_or("no level")?;
        ledger
            .order(format!(
                "pressure where permeability falls tenfold and storage grows 2.5-fold, well {name}, error over the largest pressure"
            ))
            .norm("largest of all points, in pressure_profiles.csv")
            .levels(&errors)
            .expected(2.0)
            .within(0.15)
            .evidence(
                Evidence::Exact,
                "two half-lines: the well and its image of strength (e1 - e2)/(e1 + e2), e = sqrt(k S/eta) (Carslaw and Jaeger)",
            )
            .because("with harmonic means flux and pressure are continuous at the contrast, to second order")
            .finest(
                400.0 / (16.0 * TIGHT.diffusivity() * ran.last().0),
                "h^2/8 of the curvature p/(2 D t) in the first cell of low permeability",
            )
            .cost(&ran.cost)
            .record();
    }
    Ok(())
}

/// Claims that a fault slips under this fluid as under that of `injection`.
fn against_injection(ledger: &mut Ledger) -> Result<(), CaseError> {
    let size = 20.0;
    let well = "{ at = \"8 km\", flux = \"1.25e-6 m/s\", diffusivity = 0.1, porosity = 0.1, compressibility = 1e-8 }";
    let injection = cells(size).without("faults.main.diffusion").add("faults.main.injection", well);
    let [diffused, injected] = [FluidRun::from_scene(&cells(size))?, FluidRun::from_scene(&injection)?];
    let [slips, others] = [&diffused, &injected].map(|ran| ran.at_stations("slip", LATE));
    let (slips, others) = (slips?, others?);
    let most = others.iter().fold(0.0, |m: f64, s| m.max(*s));
    ledger
        .claim("slip at four stations after 99 d, cells of 20 m")
        .unit("m")
        .values(&slips)
        .equals_each(&others)
        .absolute(1e-4 * most)
        .between("faults.main.diffusion", "faults.main.injection")
        .evidence(Evidence::Exact, "the same fault with `injection`, whose pressure has a closed form")
        .because("pressures differ by 1e-5 of their largest value while the fault slips, and slip grows with a power of the pressure; two hundred steps have errors of ln V of 1e-5 each")
        .cost(&diffused.cost)
        .record();
    let line = JoinedHalfLines { sides: [LAYER; 2], well: 0.0, flux: FLUX };
    ledger
        .claim("pressure of `injection` after 100 d, error over the pressure at the well")
        .value(error(&injected, &line))
        .at_most(1e-6)
        .evidence(Evidence::Exact, "p = q/(S sqrt(D)) sqrt(t) ierfc(|x|/sqrt(4 D t)) (Carslaw and Jaeger)")
        .because("the table has seven digits, and times of its rows eleven")
        .cost(&injected.cost)
        .record();
    let pressure = line.pressure(0.0, LATE);
    let [normal, other] = [&diffused, &injected].map(|ran| ran.at_stations("normal_stress", LATE));
    ledger
        .claim("normal traction at four stations after 99 d, cells of 20 m")
        .unit("MPa")
        .values(&normal?)
        .equals_each(&other?)
        .absolute(1.5e-6 * estimate(size, LATE) * pressure)
        .between("faults.main.diffusion", "faults.main.injection")
        .evidence(Evidence::Exact, "the same fault with `injection`, whose pressure has a closed form")
        .because("one and a half times the leading term of the error of cells; rows of both tables are a step apart")
        .cost(&diffused.cost)
        .record();
    Ok(())
}

/// Claims that no fluid is lost where it fills a fault whose permeability varies over twelve orders.
fn closed(ledger: &mut Ledger) -> Result<(), CaseError> {
    let points = "[[1000, 1e-10], [1001, 1e-22], [1400, 1e-22], [1401, 1e-14]]";
    let profile = format!("{{ along = \"distance\", points = {points} }}");
    let wells = "[{ at = \"0.5 km\", flux = { steps = [[\"1 d\", 2e-7], [\"20 d\", -1e-7], [\"60 d\", 0]] } }, { at = \"3.33 km\", flux = 5e-8, until = \"70 d\" }]";
    let scene = scene()
        .with("faults.main.line.trace[1]", "[\"0 km\", \"-4 km\"]")
        .without("faults.main.diffusion.permeability")
        .add("faults.main.diffusion.profiles", "{}")
        .add("faults.main.diffusion.profiles.permeability", profile)
        .with("faults.main.diffusion.wells", wells)
        .with("output.stations.main", "[\"0.5 km\"]");
    let ran = FluidRun::from_scene(&scene)?;
    let day = 86400.0;
    let injected = |t: f64| {
        let first =
            2e-7 * (t.min(20.0 * day) - day).max(0.0) - 1e-7 * (t.min(60.0 * day) - 20.0 * day).max(0.0);
        first + 5e-8 * t.min(70.0 * day)
    };
    let most = injected(100.0 * day);
    let stored = |pressure: &[f64]| LAYER.storage * 40.0 * pressure.iter().sum::<f64>();
    let lost = ran.rows.iter().map(|(time, p)| (stored(p) - injected(*time)).abs() / most);
    ledger
        .claim("fluid in a fault with closed ends less that of two wells, over what they have injected in the end")
        .norm("largest of all rows of pressure_profiles.csv")
        .value(lost.fold(0.0, f64::max))
        .at_most(DIGITS)
        .evidence(Evidence::Exact, "the storage times the integral of p is the volume injected")
        .because("the table has seven digits; steps conserve fluid to rounding, also beside flow that is twelve orders faster")
        .why_not_tighter("digits that are left out are random")
        .cost(&ran.cost)
        .record();
    Ok(())
}

/// Claims the steady flow from a well to drained ends.
fn drained(ledger: &mut Ledger) -> Result<(), CaseError> {
    // Where permeability jumps, cells of 160 m meet those of 40 m.
    let spacing =
        "[[\"0 km\", \"160 m\"], [\"8 km\", \"160 m\"], [\"8.0001 km\", \"40 m\"], [\"16 km\", \"40 m\"]]";
    let scene = sides(halves(scene()).with("faults.main.line.spacing", spacing), [LAYER, TIGHT])
        .add("faults.main.diffusion.ends", "drained")
        .with("faults.main.diffusion.wells[0]", "{ at = \"7.123 km\", flux = \"2e-8 m/s\" }")
        .with("stages[0].duration", "2000 yr");
    let ran = FluidRun::from_scene(&scene)?;
    // Resistance from the upper end to a place.
    let to = |x: f64| x.min(WELL) / LAYER.mobility + (x - WELL).max(0.0) / TIGHT.mobility;
    let (whole, at) = (to(2.0 * WELL), 7123.0);
    let exact = |x: &f64| 2e-8 * to(x.min(at)) * (whole - to(x.max(at))) / whole;
    let exact: Vec<f64> = ran.positions.iter().map(exact).collect();
    let ratios: Vec<f64> = ran.last().1.iter().zip(&exact).map(|(p, exact)| p / exact).collect();
    ledger
        .claim("pressure of steady flow to drained ends over the exact one, at all points, after 2000 yr")
        .values(&ratios)
        .equals_each(&vec![1.0; ratios.len()])
        .absolute(DIGITS)
        .evidence(Evidence::Exact, "flow through resistances in series")
        .because("finite volumes are exact for steady flow; the slowest mode decays over 50 yr, and the table has seven digits")
        .why_not_tighter("digits")
        .cost(&ran.cost)
        .record();
    Ok(())
}

/// Claims the energy budget of a fault under fluxes that jump.
fn energy(ledger: &mut Ledger) -> Result<(), CaseError> {
    let flux = "{ steps = [[\"0 d\", 1.25e-6], [\"70 d\", 2e-6], [\"85 d\", 0]] }";
    let ran = FluidRun::from_scene(&scene().with("faults.main.diffusion.wells[0].flux", flux))?;
    ledger
        .claim("imbalance of the energy budget over its largest part, under a flux that jumps three times")
        .norm("report.json")
        .value(ran.imbalance()?)
        .at_most(3e-8)
        .evidence(Evidence::Exact, "work of the loads is elastic energy, friction under f_n less p, and radiation")
        .because(
            "errors of ln V of 1e-5 change friction by a times that, 1e-7 of it; those of two hundred steps are random, and sum up to 1e-8 of the whole",
        )
        .cost(&ran.cost)
        .record();
    Ok(())
}

/// Claims that a run in parts writes the files of a whole one.
fn in_parts(ledger: &mut Ledger) -> Result<(), CaseError> {
    let scene = cells(80.0).add("time.log_rate_tolerance", "1e-11");
    let ((interruptions, differing), cost) = {
        let (found, cost) = Cost::measure(|| files::in_parts(&scene));
        (found?, cost)
    };
    ledger
        .claim("files of an interrupted run that differ from those of a whole one")
        .norm("byte by byte, without the part `run` of the report")
        .count(differing, 0)
        .evidence(Evidence::Exact, "a run and the same run in parts are one")
        .because("pressure is a function of time, whatever the steps of the run")
        .cost(&cost)
        .record();
    ledger
        .claim("interruptions of that run")
        .value(interruptions as f64)
        .at_least(3.0)
        .evidence(Evidence::Exact, "a limit of wall time of zero interrupts a run at each restart")
        .because("with fewer, little would be restored")
        .why_not_tighter("it tells a run in parts from a whole one")
        .cost(&cost)
        .record();
    Ok(())
}
