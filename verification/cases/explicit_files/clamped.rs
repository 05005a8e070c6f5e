//! A sliding fault that a compression wave from a loaded side clamps until it stops, and lets go again.
//!
//! Both sides have the impedance 1. Before waves return from the sides, V = 2 (S(t) - μ σ(t - d/c_p)) where that is positive, with
//! the imposed traction S beyond the strength at the start, and the pressure σ on the side at the distance d. The shear traction is
//! friction, or S where that holds the fault.

use super::{growth, last};
use crate::cases::run_files::Waves;
use crate::{Capability, CaseError, Evidence, Ledger, Plot, Series};
use std::f64::consts::TAU;

const MU: f64 = 0.5;
const NORMAL: f64 = 1.0;
/// Imposed traction, which grows in half a second, before the wave arrives.
const TRACTION: f64 = 0.1;
const RISE: f64 = 0.5;
/// Largest pressure, twice what stops the fault, of a cosine of this period.
const PRESSURE: f64 = 0.4;
const PERIOD: f64 = 0.8;
/// Distance of the loaded side over the speed of compression waves, √3.
const ARRIVAL: f64 = 0.577_350_269_189_625_8;
/// Time before which waves from the ends of the fault do not arrive at its middle.
const END: f64 = 1.6;
const CELL: f64 = 0.025;
const ROWS: usize = 80;

fn pressure(t: f64) -> f64 {
    if (0.0..PERIOD).contains(&t) { 0.5 * PRESSURE * (1.0 - (TAU * t / PERIOD).cos()) } else { 0.0 }
}

fn scene() -> String {
    let row = |k: i32| {
        let t = PERIOD * f64::from(k) / 160.0;
        format!("[{t:?}, {:?}]", pressure(t))
    };
    let rows: Vec<String> = (0..=160).map(row).collect();
    format!(
        "schema = 1\ntitle = \"clamped\"\nkinematics = \"plane-strain\"\n[materials.rock]\nyoung = 2.5\npoisson = 0.25\ndensity = 1\n\
         [bodies.a]\nmaterial = \"rock\"\nmesh.block = {{ min = [-3, -1], max = [3, 0], size = {CELL:?}, element = \"quad4\" }}\n\
         [bodies.b]\nmaterial = \"rock\"\nmesh.block = {{ min = [-3, 0], max = [3, 1], size = {CELL:?}, element = \"quad4\" }}\n\
         [faults.f]\nminus = \"a.top\"\nplus = \"b.bottom\"\nlaw = {{ kind = \"coulomb\", mu = {MU:?} }}\nnormal = {NORMAL:?}\n\
         shear = {:?}\npulses = [{{ traction = {TRACTION:?}, centre = [0, 0], radius = 1e4, duration = {RISE:?} }}]\n\
         [[stages]]\nname = \"slip\"\nduration = {END:?}\nconditions = [{{ set = \"a.left\", x = 0 }}, {{ set = \"a.right\", x = 0 }}, \
         {{ set = \"b.left\", x = 0 }}, {{ set = \"b.right\", x = 0 }}, {{ set = \"a.bottom\", absorbing = true }}, \
         {{ set = \"b.top\", pressure = {{ table = [{}] }} }}]\n\
         [time]\nstepper = \"explicit\"\nviscosity = 0\n[output]\nsampling = {:?}\nstations.f = [[0, 0]]\n",
        MU * NORMAL,
        rows.join(", "),
        END / ROWS as f64
    )
}

/// Traction that drives slip beyond friction.
fn excess(t: f64) -> f64 {
    TRACTION * growth(t, RISE) - MU * pressure(t - ARRIVAL)
}

pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    let run = Waves::from_text(&scene())?;
    let table = run.files.table("stations/f_000")?;
    let times = table.column("t")?;
    let rate = |t: f64| 2.0 * excess(t).max(0.0);
    let off = times.iter().zip(table.column("slip_rate")?).map(|(t, v)| (10.0_f64.powf(v) - rate(*t)).abs());
    // (ω h/c)²/8, by which the impedance of a row of cells differs, at a period of half the rise, and for the pressure of half its period.
    let row = |period: f64, speed: f64| (TAU / period * CELL / speed).powi(2) / 8.0;
    let (shear_wave, pressed) = (row(0.5 * RISE, 1.0), row(0.5 * PERIOD, 3.0_f64.sqrt()) * PRESSURE);
    ledger
        .claim("slip rates of a fault that a compression wave stops and lets go, over the largest")
        .norm("largest difference through time")
        .value(off.fold(0.0, f64::max) / (2.0 * TRACTION))
        .at_most(shear_wave)
        .evidence(Evidence::Exact, "V = 2 (S(t) - μ σ(t - d/c_p)) where that is positive")
        .because("the impedance of a row of cells differs by (ω h/c)²/8, at a period of half the rise of the imposed traction, the shortest part of what drives slip")
        .covers(&[Capability::DynamicRupture, Capability::PlaneStrain, Capability::Loads])
        .cost(&run.cost)
        .record();
    let normal: Vec<f64> = table.column("normal_stress")?.iter().map(|v| 1e6 * v - NORMAL).collect();
    ledger
        .claim("normal traction of the clamped fault, change since the start")
        .norm("largest difference through time")
        .values(&normal)
        .equals_each(&times.iter().map(|t| pressure(t - ARRIVAL)).collect::<Vec<_>>())
        .absolute(pressed)
        .evidence(Evidence::Exact, "the pressure on the side a travel time earlier")
        .because("the impedance of a row of cells differs by (ω h/c)²/8, at half the period of the pressure")
        .covers(&[Capability::DynamicRupture, Capability::PlaneStrain, Capability::Outputs])
        .cost(&run.cost)
        .record();
    let shear: Vec<f64> = table.column("shear_stress")?.iter().map(|v| (1e6 * v).abs()).collect();
    let friction = |t: &f64| MU * NORMAL + (TRACTION * growth(*t, RISE)).min(MU * pressure(t - ARRIVAL));
    ledger
        .claim("shear traction of the clamped fault while it slides and while it is at rest")
        .norm("largest difference through time")
        .values(&shear)
        .equals_each(&times.iter().map(friction).collect::<Vec<_>>())
        .absolute(2.0 * shear_wave * TRACTION + MU * pressed)
        .evidence(Evidence::Exact, "friction, or the traction at the start and the imposed one where that is less")
        .because("as the slip rates, of which a traction of impedances of 1 is a half, and twice as much where the fault is at rest; and the normal traction")
        .covers(&[Capability::DynamicRupture, Capability::PlaneStrain, Capability::Outputs])
        .cost(&run.cost)
        .record();
    let n = 20_000;
    let slip =
        (0..n).map(|k| rate(END * (f64::from(k) + 0.5) / f64::from(n))).sum::<f64>() * END / f64::from(n);
    ledger
        .claim("slip of the clamped fault at the end")
        .unit("m")
        .value(last(&table.column("slip")?)?.abs())
        .equals(slip)
        .relative(shear_wave)
        .evidence(Evidence::Exact, "the integral of the slip rate")
        .because("as the slip rates")
        .why_not_tighter("errors of slip rates cancel in part")
        .covers(&[Capability::DynamicRupture, Capability::PlaneStrain, Capability::Outputs])
        .cost(&run.cost)
        .record();
    let curve: Vec<(f64, f64)> =
        times.iter().copied().zip(table.column("slip_rate")?).map(|(t, v)| (t, 10.0_f64.powf(v))).collect();
    let exact: Vec<(f64, f64)> = times.iter().map(|t| (*t, rate(*t))).collect();
    ledger.plot(
        Plot::xy("a fault that a compression wave stops", "time", "slip rate")
            .series(Series::line("run", &curve))
            .series(Series::points("closed form", &exact)),
    );
    Ok(())
}
