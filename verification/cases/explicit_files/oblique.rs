//! Vector slip of a column in space without friction: along y by an imposed traction, along z by a wave from its end.
//!
//! All nodes are held along x, so that both parts are plane shear waves. V_y = 2 A G(t), and V_z is twice the velocity of the
//! wave, which the end sends out a travel time earlier.

use super::growth;
use crate::cases::written::Waves;
use crate::{Capability, CaseError, Evidence, Ledger};
use std::f64::consts::TAU;
use std::fmt::Write as _;

/// Length of a column in travel times of shear waves.
const LENGTH: f64 = 2.0;
/// Cells along a column.
const CELLS: usize = 80;
/// Imposed traction, and largest velocity of the wave.
const TRACTION: f64 = 0.1;
const WAVE: f64 = 0.1;
/// End of the run: waves return from the ends of the column later.
const END: f64 = 3.6;
/// Intervals between rows.
const ROWS: usize = 72;

/// Displacement of the end that sends out the wave, whose velocity is a period of a cosine.
fn motion(t: f64) -> f64 {
    let t = t.min(1.0);
    0.5 * WAVE * (t - (TAU * t).sin() / TAU)
}

/// Its velocity.
fn velocity(t: f64) -> f64 {
    if (0.0..1.0).contains(&t) { 0.5 * WAVE * (1.0 - (TAU * t).cos()) } else { 0.0 }
}

fn scene() -> Result<String, CaseError> {
    let rows: Vec<String> = (0..=200)
        .map(|k| format!("[{:?}, {:?}]", f64::from(k) / 200.0, motion(f64::from(k) / 200.0)))
        .collect();
    let mut conditions = String::new();
    for (body, set) in ["a", "b"].into_iter().flat_map(|b| ["bottom", "top", "back", "front"].map(|s| (b, s)))
    {
        write!(conditions, "{{ set = \"{body}.{set}\", x = 0 }}, ")?;
    }
    Ok(format!(
        "schema = 1\ntitle = \"oblique\"\nkinematics = \"3d\"\n[materials.rock]\nyoung = 2.5\npoisson = 0.25\ndensity = 1\n\
         [bodies.a]\nmaterial = \"rock\"\n\
         mesh.block = {{ min = [-{LENGTH:?}, 0, 0], max = [0, 1, 2], divisions = [{CELLS}, 1, 1], element = \"hex8\" }}\n\
         [bodies.b]\nmaterial = \"rock\"\n\
         mesh.block = {{ min = [0, 0, 0], max = [{LENGTH:?}, 1, 2], divisions = [{CELLS}, 1, 1], element = \"hex8\" }}\n\
         [faults.f]\nminus = \"a.right\"\nplus = \"b.left\"\nslip = \"free\"\nrake = [0, 1, 0]\nlaw = {{ kind = \"coulomb\", mu = 1e-9 }}\n\
         normal = 1\nshear = 0\npulses = [{{ traction = {TRACTION:?}, centre = [0, 0.5, 1], radius = 1e4, duration = 1 }}]\n\
         [[stages]]\nname = \"slip\"\nduration = {END:?}\nconditions = [{conditions}{{ set = \"a.left\", absorbing = true }}, \
         {{ set = \"b.right\", z = {{ table = [{}] }} }}]\n\
         [time]\nstepper = \"explicit\"\nviscosity = 0\n[output]\nsampling = {:?}\nprofiles = {ROWS}\n",
        rows.join(", "),
        END / ROWS as f64
    ))
}

pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    let run = Waves::of(&scene()?)?;
    let table = run.files.table("moment_rate.csv")?;
    let times = table.column("time")?;
    // The modulus is 1, and the area 2.
    let exact = |t: &f64| 2.0 * (2.0 * TRACTION * growth(*t, 1.0)).hypot(2.0 * velocity(t - LENGTH));
    let rates: Vec<f64> = times.iter().map(exact).collect();
    // k³h²/24 is the shift of phase per length.
    let lag = TAU.powi(3) * (LENGTH / CELLS as f64).powi(2) / 24.0 * LENGTH;
    let largest = rates.iter().copied().fold(0.0, f64::max);
    ledger
        .claim("moment rate of slip that a wave turns out of its direction")
        .unit("N m/s")
        .norm("largest difference")
        .values(&table.column("moment_rate of f")?)
        .equals_each(&rates)
        .absolute(lag * largest)
        .evidence(Evidence::Exact, "G A |V| with V_y = 2 A G(t) and V_z twice the velocity of the wave")
        .because("the shift of phase k³h²/24 of the wave on its way, at steps without length")
        .covers(&[Capability::DynamicRupture, Capability::Outputs])
        .cost(&run.cost)
        .record();
    let n = 4000;
    let middle = |k: i32| END * (f64::from(k) + 0.5) / f64::from(n);
    let along: f64 = (0..n).map(|k| 2.0 * TRACTION * growth(middle(k), 1.0) * END / f64::from(n)).sum();
    let moment = 2.0 * along.hypot(2.0 * motion(END));
    ledger
        .claim("moment of that slip in the report")
        .unit("N m")
        .value(run.report.ruptures.first().map_or(f64::NAN, |r| r.moment))
        .equals(moment)
        .relative(lag)
        .evidence(Evidence::Exact, "G A |slip|, the integrals of both slip rates")
        .because("as for the rate")
        .why_not_tighter("a lag of phase changes an integral over a whole pulse by less")
        .covers(&[Capability::DynamicRupture, Capability::Outputs])
        .cost(&run.cost)
        .record();
    Ok(())
}
