//! Slip of columns in antiplane motion that stops, and that the waves which return from the free ends of the columns revive.
//!
//! In units of the shear modulus, the density and the length of a column, both sides have the impedance 1. With the load S(t), the
//! imposed traction over the strength, and g the velocity of the wave that returns to a side, the characteristics on both sides give
//! V = 2 (S + 2 g) where that is positive, and 0 elsewhere. The side sends out f = V/2 - g, which returns from a free end as it left,
//! g(t) = f(t - 2). Friction is the strength where the fault slides, and what the load and the waves leave where it is at rest.

use super::{growth, last};
use crate::cases::run_files::Waves;
use crate::{Capability, CaseError, Evidence, Ledger, Plot, Series};

/// Cells along a column.
const CELLS: usize = 160;
/// Imposed tractions and their durations: the first starts slip, and the second ends it.
const PULSES: [[f64; 2]; 2] = [[0.4, 0.5], [-0.5, 1.0]];
const STRENGTH: f64 = 0.5;
/// Step over the time in which a wave crosses a cell.
const COURANT: f64 = 0.5;
/// End: waves return twice, and the second time slip does not begin again.
const END: f64 = 4.8;
const ROWS: usize = 192;
/// Shortest time in which slip rates rise, a quarter of a period.
const RISE: f64 = 0.25;

fn scene() -> String {
    let body = |name: &str, from: i32, to: i32| {
        format!(
            "[bodies.{name}]\nmaterial = \"rock\"\n\
             mesh.block = {{ min = [{from}, 0], max = [{to}, 1], divisions = [{CELLS}, 1], element = \"quad4\" }}\n"
        )
    };
    let pulse = |[traction, duration]: &[f64; 2]| {
        format!("{{ traction = {traction:?}, centre = [0, 0.5], radius = 1e4, duration = {duration:?} }}")
    };
    let pulses: Vec<String> = PULSES.iter().map(pulse).collect();
    format!(
        "schema = 1\ntitle = \"revived\"\nkinematics = \"antiplane\"\n[materials.rock]\nyoung = 2.5\npoisson = 0.25\ndensity = 1\n{}{}\
         [faults.f]\nminus = \"a.right\"\nplus = \"b.left\"\nlaw = {{ kind = \"coulomb\", mu = {STRENGTH:?} }}\nnormal = 1\n\
         shear = {STRENGTH:?}\npulses = [{}]\n\
         [[stages]]\nname = \"slip\"\nduration = {END:?}\nsteps = {}\nconditions = []\n\
         [time]\nstepper = \"explicit\"\nviscosity = 0\n\
         [output]\nsampling = {:?}\nprofiles = {ROWS}\nstations.f = [[0, 0]]\n",
        body("a", -1, 0),
        body("b", 0, 1),
        pulses.join(", "),
        (END * CELLS as f64 / COURANT).round(),
        END / ROWS as f64
    )
}

/// The load beyond the strength.
fn load(t: f64) -> f64 {
    PULSES.iter().map(|[traction, duration]| traction * growth(t, *duration)).sum()
}

/// The wave that returns to a side.
fn returning(t: f64) -> f64 {
    if t <= 2.0 { 0.0 } else { 0.5 * rate(t - 2.0) - returning(t - 2.0) }
}

/// Largest slope of a course.
fn steepest(of: &dyn Fn(f64) -> f64) -> f64 {
    let step = 1e-3;
    (0..(END / step) as i32)
        .map(|k| (of(f64::from(k + 1) * step) - of(f64::from(k) * step)).abs() / step)
        .fold(0.0, f64::max)
}

/// The slip rate.
fn rate(t: f64) -> f64 {
    (2.0 * (load(t) + 2.0 * returning(t))).max(0.0)
}

pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    let run = Waves::from_text(&scene())?;
    let rows = run.files.table("rate_profiles.csv")?.numbers();
    let peak = (0..=4000).map(|k| rate(END * f64::from(k) / 4000.0)).fold(0.0, f64::max);
    // (k h)²/24 (1 - C²) is the lag of a wave over its way, whose part of the slip rate changes by its slope within it.
    let wave = std::f64::consts::FRAC_PI_2 / RISE;
    let lag = (wave / CELLS as f64).powi(2) / 24.0 * END * wave;
    // The front of a wave whose slope changes there is an integral of Airy's function, which rounds the corner by 0.26 of the
    // change of slope times this width.
    let width = (END / CELLS.pow(2) as f64 * (1.0 - COURANT * COURANT) / 8.0).cbrt();
    let rounded = |of: &dyn Fn(f64) -> f64| 0.26 * steepest(of) * width;
    let each =
        |row: &Vec<f64>| row[1..].iter().map(|v| (10_f64.powf(*v) - rate(row[0])).abs()).fold(0.0, f64::max);
    let off: Vec<f64> = rows.iter().map(each).collect();
    let found: Vec<(f64, f64)> = rows.iter().map(|row| (row[0], 10_f64.powf(row[1]))).collect();
    ledger
        .claim("slip rates of columns whose slip ends, and which waves from their free ends revive, over the largest")
        .norm("largest difference through time")
        .value(off.iter().copied().fold(0.0, f64::max) / peak)
        .at_most(rounded(&rate) / peak)
        .evidence(Evidence::Exact, "characteristics of both columns: V = 2 (S + 2 g), g(t) = V(t - 2)/2 - g(t - 2)")
        .because("corners of the wave, where slip ends and begins, are rounded by 0.26 of the change of slope times (h² s (1 - C²)/8)^(1/3), s the way")
        .covers(&[Capability::DynamicRupture, Capability::Antiplane])
        .cost(&run.cost)
        .record();
    ledger
        .claim("slip rates of those columns, mean difference through time over the largest")
        .value(off.iter().sum::<f64>() / off.len() as f64 / peak)
        .at_most(4.0 * lag)
        .evidence(Evidence::Exact, "characteristics of both columns")
        .because("four times the lag (k h)²/24 of the returning wave over its way, since each return doubles it; corners last short")
        .why_not_tighter("the fault is at rest most of the time")
        .covers(&[Capability::DynamicRupture, Capability::Antiplane])
        .cost(&run.cost)
        .record();
    let table = run.files.table("stations/f_000")?;
    let (times, shear) = (table.column("t")?, table.column("shear_stress")?);
    let friction = |t: f64| (STRENGTH + load(t) + 2.0 * returning(t)).min(STRENGTH);
    let found_shear: Vec<f64> = shear.iter().map(|s| 1e6 * s).collect();
    ledger
        .claim("shear traction of the revived fault while it slides and while it is at rest")
        .norm("largest difference through time")
        .values(&found_shear)
        .equals_each(&times.iter().map(|t| friction(*t)).collect::<Vec<_>>())
        .absolute(2.0 * rounded(&friction))
        .evidence(
            Evidence::Exact,
            "the strength, or the load and twice the returning wave where that is less",
        )
        .because("as the slip rates; where the course turns back, its slope changes by twice the largest")
        .covers(&[Capability::DynamicRupture, Capability::Antiplane, Capability::Outputs])
        .cost(&run.cost)
        .record();
    let n = 40_000;
    let middle = |k: i32| rate(END * (f64::from(k) + 0.5) / f64::from(n));
    let slip = (0..n).map(middle).sum::<f64>() * END / f64::from(n);
    ledger
        .claim("slip of the revived fault at the end")
        .unit("m")
        .value(last(&table.column("slip")?)?)
        .equals(slip)
        .relative(4.0 * lag)
        .evidence(Evidence::Exact, "the integral of the slip rate")
        .because("as the slip rates")
        .why_not_tighter("a lag of the waves changes the integral over whole pulses by less")
        .covers(&[Capability::DynamicRupture, Capability::Antiplane, Capability::Outputs])
        .cost(&run.cost)
        .record();
    let exact: Vec<(f64, f64)> = found.iter().map(|(t, _)| (*t, rate(*t))).collect();
    ledger.plot(
        Plot::xy("columns that returning waves revive", "time", "slip rate")
            .series(Series::line("run", &found))
            .series(Series::points("characteristics", &exact)),
    );
    Ok(())
}
