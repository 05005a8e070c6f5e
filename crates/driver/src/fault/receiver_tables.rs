//! Tables of the displacements of receivers over each event.

use super::plan::Plan;
use super::source_time::FOLDER;
use asperity_cycles::{Event, FaultRun, Rupture};
use asperity_output::decimals::{scientific, shortest};
use asperity_output::{OutputError, atomic};
use nalgebra::Vector3;
use std::path::Path;

/// Header of the displacements over an event.
const HEAD: &str = "name,x [m],y [m],z [m],displacement_x [m],displacement_y [m],displacement_z [m]";
/// Further columns where the scene has a place on Earth.
const PLACED: &str = ",longitude [deg],latitude [deg],depth [m],east [m],north [m],up [m]";

/// Writes `events/displacements_000.csv` and so on for the first events: displacements of all receivers that slip in the event
/// causes.
///
/// # Errors
/// If a file cannot be written.
pub(super) fn write(out: &Path, plan: &Plan, run: &FaultRun) -> Result<(), OutputError> {
    if plan.receivers.all.is_empty() {
        return Ok(());
    }
    for (number, event) in run.events().iter().enumerate().take(plan.event_files) {
        let path = out.join(FOLDER).join(format!("displacements_{number:03}.csv"));
        atomic::write(&path, table(plan, event).as_bytes())?;
    }
    Ok(())
}

fn table(plan: &Plan, event: &Event<Rupture>) -> String {
    let mut text = format!("{HEAD}{}\n", if plan.frame.is_some() { PLACED } else { "" });
    for receiver in &plan.receivers.all {
        let moved = receiver.caused(event.details.slip.all().iter().copied());
        let mut row = vec![receiver.name.clone()];
        row.extend(receiver.at.map(shortest));
        row.extend(moved.map(|u| scientific(u, 9)));
        if let Some(frame) = &plan.frame {
            let spot = frame.spot(&receiver.at);
            row.extend([spot.longitude, spot.latitude, spot.depth].map(shortest));
            let east_north_up: [f64; 3] = (frame.axes * Vector3::from(moved)).into();
            row.extend(east_north_up.map(|u| scientific(u, 9)));
        }
        text.push_str(&row.join(","));
        text.push('\n');
    }
    text
}
