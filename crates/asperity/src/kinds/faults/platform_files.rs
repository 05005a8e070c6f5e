//! Results in the files in which the SEAS community collects them: positions on and beside the fault, the whole fault through time, and
//! rupture times of the first event. They are made at the end of a run from its own files.

use super::fields::reached;
use super::{largest_slip_rate, receiver_rows};
use super::{moments, stations};
use asperity_cycles::{FaultRun, Rupture};
use asperity_output::decimals::scientific;
use asperity_output::formats::platform::{global, signed, table};
use asperity_output::{OutputError, atomic};
use asperity_plan::faults::{Plan, Platform, PointView};
use asperity_run::Event;
use std::fs;
use std::path::Path;

/// Folder of the files.
const FOLDER: &str = "platform";
/// Rupture time where nothing ruptured \[s\].
const NEVER: f64 = 1e9;
/// Logarithm of the slip rate across a fixed direction of slip.
const NO_RATE: &str = "-20.000000000";
/// Slip and traction across a fixed direction of slip.
const NONE: &str = "0.000000000e0";

/// Writes the files.
///
/// # Errors
/// If a file cannot be read or written.
pub(super) fn write(out: &Path, plan: &Plan, run: &FaultRun) -> Result<(), OutputError> {
    let Some(platform) = &plan.platform else { return Ok(()) };
    let folder = out.join(FOLDER);
    atomic::create_dir(&folder)?;
    let put = |name: &str, head: String, rows: String| {
        atomic::write(&folder.join(name), format!("{head}{rows}").as_bytes())
    };
    for ((name, location), (own, ..)) in platform.stations.iter().zip(stations::all(plan)) {
        let text = read(&out.join("stations").join(own))?;
        let rows = table(&text, ' ').filter_map(|row| on_fault(platform, &row)).collect();
        put(&format!("{name}.txt"), platform.submission.on_fault(location), rows)?;
    }
    for ((name, location), receiver) in platform.receivers.iter().zip(&plan.receivers.all) {
        let text = read(&out.join(receiver_rows::FILE.named(&receiver.name)))?;
        let rows = table(&text, ',').filter_map(|row| off_fault(platform, &row)).collect();
        put(&format!("{name}.txt"), platform.submission.off_fault(location), rows)?;
    }
    let (largest, rates) =
        (read(&out.join(largest_slip_rate::FILE.path))?, read(&out.join(moments::FILE.path))?);
    put("global.dat", platform.submission.global(), global(&largest, &rates))?;
    match run.events().first() {
        Some(event) => put("rupture.dat", platform.submission.rupture(), ruptured(platform, plan, event)),
        None => Ok(()),
    }
}

fn read(path: &Path) -> Result<String, OutputError> {
    fs::read_to_string(path).map_err(|source| OutputError::Read { path: path.to_path_buf(), source })
}

/// Row of a position on the fault from one of the station file.
fn on_fault(platform: &Platform, row: &[&str]) -> Option<String> {
    let [two, three] = platform.signs;
    let cells = match *row {
        [t, s2, s3, r2, r3, t2, t3, state, ..] if platform.turns => {
            let [s2, t2] = [s2, t2].map(|cell| signed(cell, two));
            let [s3, t3] = [s3, t3].map(|cell| signed(cell, three));
            [t.into(), s2, s3, r2.into(), r3.into(), t2, t3, state.into()]
        }
        [t, slip, rate, shear, state, ..] if !platform.turns => {
            let [slip, shear] = [slip, shear].map(|cell| signed(cell, two));
            [t.into(), slip, NONE.into(), rate.into(), NO_RATE.into(), shear, NONE.into(), state.into()]
        }
        _ => return None,
    };
    Some(format!("{}\n", cells.join(" ")))
}

/// Row of a position beside the fault from one of a receiver: time, velocity and displacement.
fn off_fault(platform: &Platform, row: &[&str]) -> Option<String> {
    let [time, vector @ ..] = row else { return None };
    let values: Vec<f64> = vector.iter().map(|v| v.parse().ok()).collect::<Option<_>>()?;
    let [vx, vy, vz, ux, uy, uz] = values[..] else { return None };
    let along = |v: [f64; 3]| {
        platform.axes.map(|axis| scientific(axis.iter().zip(v).map(|(e, v)| e * v).sum(), 9)).join(" ")
    };
    Some(format!("{time} {} {}\n", along([ux, uy, uz]), along([vx, vy, vz])))
}

/// Rows of positions and rupture times of an event, counted from the start of the run.
fn ruptured(platform: &Platform, plan: &Plan, event: &Event<Rupture>) -> String {
    let row = |(p, point): (usize, &PointView)| {
        let on = |axis: &[f64; 3]| point.at.iter().zip(axis).map(|(x, e)| x * e).sum::<f64>();
        let since = reached(event, p);
        let time = if since.is_nan() { NEVER } else { event.onset.seconds() + since };
        let [x2, x3] = [on(&platform.axes[1]), on(&platform.axes[2])].map(|x| scientific(x, 9));
        format!("{x2} {x3} {}\n", scientific(time, 13))
    };
    plan.points.iter().enumerate().map(row).collect()
}
