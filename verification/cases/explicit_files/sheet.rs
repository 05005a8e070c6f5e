//! A compression wave along a sheet between rollers that leaves through an absorbing side.
//!
//! In plane stress the modulus of such a wave is E/(1 - ν²), and c² = E/(ρ (1 - ν²)). The energy of the wave is ∫ s²/(ρ c) dt.

use super::last;
use crate::cases::run_files::Waves;
use crate::{Capability, CaseError, Evidence, Ledger};
use std::f64::consts::TAU;

const POISSON: f64 = 0.4;
const LENGTH: f64 = 2.0;
const HEIGHT: f64 = 0.5;
const CELLS: usize = 80;
/// Largest pressure, of a cosine of period 1.
const PRESSURE: f64 = 1e-3;
/// End of the run: the wave has left, and a reflection would not have returned to the driven end.
const END: f64 = 3.2;

/// Speed of compression waves; also the impedance, as the density is 1.
fn speed() -> f64 {
    (1.0 / (1.0 - POISSON * POISSON)).sqrt()
}

/// The sheet under the pressure at one end, whose other end absorbs.
fn loaded(pushed: &str, absorbing: &str) -> String {
    scene([pushed, absorbing], "pressure", |angle| 0.5 * PRESSURE * (1.0 - angle.cos()))
}

/// The sheet whose left end moves as that pressure moves it.
fn moved() -> String {
    let displacement = |angle: f64| 0.5 * PRESSURE / speed() * (angle - angle.sin()) / TAU;
    scene(["left", "right"], "x", displacement)
}

/// The sheet with a condition on one end that follows the phase of the pressure.
fn scene([pushed, absorbing]: [&str; 2], condition: &str, value: impl Fn(f64) -> f64) -> String {
    let at = |k: i32| {
        let share = f64::from(k) / 200.0;
        format!("[{share:?}, {:?}]", value(TAU * share))
    };
    let rows: Vec<String> = (0..=200).map(at).collect();
    format!(
        "schema = 1\ntitle = \"sheet\"\nkinematics = \"plane-stress\"\n[materials.sheet]\nyoung = 1\npoisson = {POISSON:?}\ndensity = 1\n\
         [bodies.bar]\nmaterial = \"sheet\"\n\
         mesh.block = {{ min = [0, 0], max = [{LENGTH:?}, {HEIGHT:?}], divisions = [{CELLS}, 1], element = \"quad4\" }}\n\
         [[stages]]\nname = \"push\"\nduration = {END:?}\nconditions = [{{ set = \"bar.{pushed}\", {condition} = {{ table = [{}] }} }}, \
         {{ set = \"bar.bottom\", y = 0 }}, {{ set = \"bar.top\", y = 0 }}, {{ set = \"bar.{absorbing}\", absorbing = true }}]\n\
         [time]\nstepper = \"explicit\"\nviscosity = 0\n[output]\nsampling = {:?}\n",
        rows.join(", "),
        END / 32.0
    )
}

pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    end(ledger, "left", "right", "")?;
    end(ledger, "right", "left", ", to the left")?;
    motion(ledger)
}

/// Bound of the relative errors of energies of the wave: (k h)²/8 at its period.
fn bound() -> f64 {
    let wavenumber = TAU / speed() * LENGTH / CELLS as f64;
    wavenumber * wavenumber / 8.0
}

/// Claims the work of the motion that makes the wave.
fn motion(ledger: &mut Ledger) -> Result<(), CaseError> {
    let run = Waves::from_text(&moved())?;
    let table = run.files.table("energy.csv")?;
    let of = |column: &str| -> Result<f64, CaseError> { last(&table.column(column)?) };
    ledger
        .claim("work of a motion of an end that makes that wave, and that of loads beside it: motions and loads in energy.csv")
        .unit("J/m")
        .values(&[of("motions")?, of("loads")?])
        .equals_each(&[HEIGHT * PRESSURE * PRESSURE * 3.0 / 8.0 / speed(), 0.0])
        .absolute(bound() * HEIGHT * PRESSURE * PRESSURE * 3.0 / 8.0 / speed())
        .evidence(Evidence::Exact, "∫ ρ c v² dt of an end that moves at v = s/(ρ c), c² = E/(ρ (1 - ν²))")
        .because("(k h)²/8 at the period of the wave, by which the impedance of a row of cells differs")
        .covers(&[Capability::Waves, Capability::PlaneStress, Capability::Outputs])
        .cost(&run.cost)
        .record();
    Ok(())
}

/// Claims about the wave that leaves through an end; `way` distinguishes their names.
fn end(ledger: &mut Ledger, pushed: &str, absorbing: &str, way: &str) -> Result<(), CaseError> {
    let run = Waves::from_text(&loaded(pushed, absorbing))?;
    let table = run.files.table("energy.csv")?;
    ledger
        .claim(format!("energy that an absorbing side takes from a compression wave in plane stress{way}"))
        .unit("J/m")
        .value(last(&table.column("absorbed")?)?)
        .equals(HEIGHT * PRESSURE * PRESSURE * 3.0 / 8.0 / speed())
        .relative(bound())
        .evidence(Evidence::Exact, "∫ s²/(ρ c) dt of a cosine, c² = E/(ρ (1 - ν²))")
        .because("(k h)²/8 at the period of the wave, by which the impedance of a row of cells differs")
        .covers(&[Capability::Waves, Capability::PlaneStress, Capability::Outputs])
        .cost(&run.cost)
        .record();
    let left = last(&table.column("kinetic")?)? + last(&table.column("elastic")?)?;
    ledger
        .claim(format!("energy left behind by that wave over the work of the load{way}"))
        .value(left / last(&table.column("loads")?)?)
        .at_most((8.0 * bound()).powi(2))
        .evidence(Evidence::Exact, "dashpots of ρ c reflect nothing at normal incidence")
        .because("a single node of cells of size h reflects less than (k h)² of the amplitude, and energy is its square")
        .why_not_tighter("the share of wavelengths shorter than the period of the pulse decides")
        .covers(&[Capability::Waves, Capability::PlaneStress, Capability::Outputs])
        .cost(&run.cost)
        .record();
    Ok(())
}
