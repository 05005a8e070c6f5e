//! Friction that follows the normal traction with a delay, under a compression wave that crosses a sliding fault.
//!
//! Friction is so low that the slip rate V hardly changes. With r = (V + V*)/L the normal traction that friction feels is
//! σ̂ = σ₀ + ∫ σ'(s) (1 - e^(-r (t - s))) ds.

use crate::cases::run_files::Waves;
use crate::{Capability, CaseError, Evidence, Ledger};
use std::f64::consts::PI;

/// Coefficient of friction, normal traction at the start, and increase by the wave.
const MU: f64 = 1e-4;
const NORMAL: f64 = 100.0;
const INCREASE: f64 = 50.0;
/// Shear traction at the start, over the strength: both sides have the impedance 1, so that V is twice the difference.
const SHEAR: f64 = 0.3;
/// Duration of the increase.
const RISE: f64 = 0.4;
/// V* and L.
const RATE: f64 = 0.4;
const LENGTH: f64 = 0.25;
/// Distance of the driven side over the speed of compression waves.
const ARRIVAL: f64 = 0.577_350_269_189_625_8;
/// Time after which waves from the ends of the fault arrive at its middle.
const END: f64 = 1.6;
const COURANT: f64 = 0.1;
const CELL: f64 = 0.05;
const ROWS: usize = 80;

fn scene() -> String {
    let rise = |k: i32| {
        let t = f64::from(k) / 40.0;
        format!("[{:?}, {:?}]", RISE * t, 0.5 * INCREASE * (1.0 - (PI * t).cos()))
    };
    let rows: Vec<String> = (0..=40).map(rise).collect();
    format!(
        "schema = 1\ntitle = \"delayed\"\nkinematics = \"plane-strain\"\n[materials.rock]\nyoung = 2.5\npoisson = 0.25\ndensity = 1\n\
         [bodies.a]\nmaterial = \"rock\"\nmesh.block = {{ min = [-3, -1], max = [3, 0], size = {CELL:?}, element = \"quad4\" }}\n\
         [bodies.b]\nmaterial = \"rock\"\nmesh.block = {{ min = [-3, 0], max = [3, 1], size = {CELL:?}, element = \"quad4\" }}\n\
         [faults.f]\nminus = \"a.top\"\nplus = \"b.bottom\"\nlaw = {{ kind = \"coulomb\", mu = {MU:?} }}\nnormal = {NORMAL:?}\n\
         shear = {SHEAR:?}\nnormal_delay = {{ length = {LENGTH:?}, rate = {RATE:?} }}\n\
         [[stages]]\nname = \"slip\"\nduration = {END:?}\nconditions = [{{ set = \"a.left\", x = 0 }}, {{ set = \"a.right\", x = 0 }}, \
         {{ set = \"b.left\", x = 0 }}, {{ set = \"b.right\", x = 0 }}, {{ set = \"a.bottom\", absorbing = true }}, \
         {{ set = \"b.top\", pressure = {{ table = [{}] }} }}]\n\
         [time]\nstepper = \"explicit\"\ncourant = {COURANT:?}\n[output]\nsampling = {:?}\nstations.f = [[0, 0]]\n",
        rows.join(", "),
        END / ROWS as f64
    )
}

/// Increase of the normal traction that friction feels.
fn felt(t: f64, decay: f64) -> f64 {
    let n = 2000;
    let step = t.clamp(0.0, RISE) / f64::from(n);
    let at = |k: i32| {
        let s = (f64::from(k) + 0.5) * step;
        0.5 * INCREASE * PI / RISE * (PI * s / RISE).sin() * (1.0 - (-decay * (t - s)).exp())
    };
    (0..n).map(at).sum::<f64>() * step
}

pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    let run = Waves::from_text(&scene())?;
    let table = run.files.table("stations/f_000")?;
    let decay = (2.0 * (SHEAR - MU * NORMAL) + RATE) / LENGTH;
    let rows: Vec<(f64, f64)> = table
        .column("t")?
        .into_iter()
        .zip(table.column("shear_stress")?)
        .filter(|(t, _)| *t > ARRIVAL)
        .collect();
    let found: Vec<f64> =
        rows.iter().map(|(_, shear)| (shear.abs() * 1e6 - MU * NORMAL) / (MU * INCREASE)).collect();
    let exact: Vec<f64> = rows.iter().map(|(t, _)| felt(t - ARRIVAL, decay) / INCREASE).collect();
    // The slip rate falls by twice the increase of friction.
    let slower = 2.0 * MU * INCREASE / (decay * LENGTH);
    let lag = 0.5 * decay * run.report.step;
    ledger
        .claim("friction that follows a normal traction with a delay, over its change")
        .norm("largest difference through time")
        .values(&found)
        .equals_each(&exact)
        .absolute(slower + lag)
        .evidence(Evidence::Exact, "dσ̂/dt = -(|V| + V*)/L (σ̂ - σ) with a constant slip rate")
        .because("the slip rate falls by a hundredth with friction, and tractions are felt as they were relaxed within a step, r dt/2 late")
        .covers(&[Capability::DynamicRupture, Capability::PlaneStrain])
        .cost(&run.cost)
        .record();
    Ok(())
}
