//! Numbers of an event whose slip turns from the rake: in the catalogue, and in the fields of the fault.

use super::receivers::{PLATES, PLATES_RAKE, RAKE, direction};
use crate::cases::output_files::vtu::Fields;
use crate::cases::run_files::WrittenRun;
use crate::{CaseError, Evidence, Ledger};

/// Slip rate at the start \[m/s\], as the scene gives it.
const RATE: f64 = 1.1e-9;

/// Claims the direction of the slip, which has turned by this angle in the table of the points \[degrees\], and the coupling at the start.
pub(super) fn claims(ledger: &mut Ledger, done: &WrittenRun, turned: f64) -> Result<(), CaseError> {
    let events = done.files.table("events.csv")?;
    let fields = Fields::read(&done.files.text("fields/main_event_000.vtu")?)?;
    let single =
        |name: &str| -> Result<f64, CaseError> { Ok(*fields.array(name)?.values.first().ok_or("no value")?) };
    ledger
        .claim("event whose slip turns from the rake: turned in the catalogue and in the fields")
        .unit("deg")
        .values(&[events.only("turned")?, single("turned")?])
        .equals_each(&[turned; 2])
        .absolute(1e-5)
        .evidence(
            Evidence::Exact,
            "the only point of the fault, whose angle displacements of the surface confirm",
        )
        .because("the table of points has seven digits")
        .why_not_tighter("the last digit may be off by any part of a half")
        .cost(&done.cost)
        .record();
    let way = direction(RAKE + turned);
    let mut found = Vec::new();
    for axis in ["x", "y", "z"] {
        found.push(events.only(&format!("direction_{axis}"))?);
    }
    let slip = single("slip")?;
    found.extend(fields.array("slip_vector")?.values.iter().map(|part| part / slip));
    ledger
        .claim("event whose slip turns from the rake: direction_x, direction_y and direction_z of the catalogue, and slip_vector in the fields over slip")
        .values(&found)
        .equals_each(&[way, way].concat())
        .absolute(2e-7)
        .evidence(Evidence::Exact, "the unit vector at the rake and that angle on a plane of the dip of the scene")
        .because("the angle has seven digits, half of 1e-5 degrees")
        .why_not_tighter("the last digit may be off by any part of a half")
        .cost(&done.cost)
        .record();
    let start = Fields::read(&done.files.text("fields/main_00000.vtu")?)?;
    ledger
        .claim(
            "coupling in the fields at the start of a fault that slides obliquely to its plates and faster",
        )
        .values(&start.array("coupling")?.values)
        .equals_each(&[1.0 - RATE / PLATES * (PLATES_RAKE - RAKE).to_radians().cos()])
        .absolute(1e-10)
        .evidence(Evidence::Exact, "1 - V.Vp/Vp^2")
        .because("all digits are written: rounding of logarithms")
        .why_not_tighter("rounding depends on the machine")
        .cost(&done.cost)
        .record();
    Ok(())
}
