//! Numbers of events while slip turns, against the rows of stations at all points.

use super::scene;
use crate::cases::run_files::WrittenRun;
use crate::{Capability, CaseError, Evidence, Ledger};
use asperity_vary::SceneText;

/// Shear modulus \[Pa\] and area of the fault \[m²\].
const ROCK: f64 = 32e9;
const AREA: f64 = 1e6;
/// Slip rate at which events begin \[m/s\].
const ON: f64 = 1e-4;
/// Places of the points along y and z \[m\], and number of events.
const PLACES: [f64; 3] = [0.0, 500.0, 1000.0];
const EVENTS: usize = 2;
/// Angle of the load from the rake, along which slip begins \[degrees\].
const DRAWN: f64 = 60.0;

/// Slip rates of a station: times \[s\] and magnitudes of vectors \[m/s\].
struct Rates {
    time: Vec<f64>,
    size: Vec<f64>,
}

/// Claims largest slip rates of all points and the moment rate at the onset.
pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (sine, cosine) = DRAWN.to_radians().sin_cos();
    let at: Vec<String> =
        PLACES.iter().flat_map(|y| PLACES.map(|z| format!("[0.0, {y:?}, {z:?}]"))).collect();
    let text = SceneText::new(&scene([-sine, cosine], [0.0, 1.0], true, EVENTS)?)
        .with("time.log_rate_tolerance", "1e-10")
        .add("output", format!("{{ stations.main = [{}] }}", at.join(", ")));
    let done = WrittenRun::from_text(&text.text()?)?;
    let stations: Vec<Rates> = done
        .files
        .names("stations")?
        .iter()
        .map(|name| {
            let table = done.files.table(&format!("stations/{name}"))?;
            let [two, three] = ["slip_rate_2", "slip_rate_3"].map(|name| table.column(name));
            let size = two?.iter().zip(three?).map(|(a, b)| 10f64.powf(*a).hypot(10f64.powf(b))).collect();
            Ok(Rates { time: table.column("t")?, size })
        })
        .collect::<Result<_, CaseError>>()?;
    let events = done.files.table("events.csv")?;
    let (onsets, durations) = (events.column("onset")?, events.column("duration")?);
    let (mut peaks, mut onset) = (0.0_f64, 0.0_f64);
    for (number, (from, duration)) in onsets.iter().zip(&durations).enumerate() {
        let found = done.files.table(&format!("events/rupture_times_{number:03}.csv"))?;
        let found = found.column("largest slip_rate")?;
        if found.len() != stations.len() {
            return Err("not every point has a station".into());
        }
        for (found, Rates { time, size }) in found.iter().zip(&stations) {
            let within = time.iter().zip(size).filter(|(t, _)| (*from..=from + duration).contains(*t));
            peaks = peaks.max((found / within.map(|(_, v)| *v).fold(0.0, f64::max) - 1.0).abs());
        }
        let rates =
            done.files.table(&format!("events/moment_rate_{number:03}.csv"))?.column("moment_rate")?;
        let first = rates.first().ok_or("no row")?;
        onset = onset.max((first / (ROCK * AREA * ON) - 1.0).abs());
    }
    ledger
        .claim("largest slip rates of all points in two events while slip turns, largest relative error")
        .value(peaks)
        .at_most(5e-9)
        .evidence(Evidence::Exact, "largest magnitude of the vectors of slip rate in the rows of their stations")
        .because("the magnitude has a maximum within the event, which has a row: half of the ninth decimals of both log10 V is 2e-9 of V")
        .why_not_tighter("the last digits may be off by any part of a half")
        .covers(&[Capability::Events, Capability::Outputs])
        .cost(&done.cost)
        .record();
    ledger
        .claim("moment rate at the onset of two events while slip turns, largest relative error")
        .value(onset)
        .at_most(5e-3)
        .evidence(Evidence::Exact, "G times area times the slip rate that begins an event, as all points slip by the same vector")
        .because("the first row is linear between the ends of its step, which slip rates that grow by x miss by x^2/8: a fifth of themselves at most, with this tolerance")
        .why_not_tighter("where an onset falls in its step is chance")
        .covers(&[Capability::Events, Capability::Outputs])
        .cost(&done.cost)
        .record();
    Ok(())
}
