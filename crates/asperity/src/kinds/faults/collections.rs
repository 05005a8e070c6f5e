//! Files of a 3D run at its end: fields of events and of the last state, and the collections of all fields.

use super::event_tables::{self, reached, turned};
use super::fields::{Field, Surface, along, state};
use super::{coulomb_tables, platform_files, receiver_tables, snapshots, surface_tables};
use asperity_cycles::{FaultRun, OPENING, Rupture};
use asperity_output::fields::vtu::{PvdEntry, pvd};
use asperity_output::tables::rows;
use asperity_output::{OutputError, atomic};
use asperity_plan::faults::{FaultView, Plan};
use asperity_run::Event;
use std::path::Path;

/// Writes the tables of events and, in 3D, `fields/FAULT_event_000.vtu` for each event, `fields/FAULT_end.vtu`, and the collections `fields.pvd` of the states during the run and
/// `events.pvd` of the events at their onset times. Faults in 2D have profiles instead.
///
/// # Errors
/// If a file cannot be read or written.
pub fn write(out: &Path, plan: &Plan, run: &FaultRun) -> Result<(), OutputError> {
    event_tables::write(out, plan, run)?;
    receiver_tables::write(out, plan, run)?;
    surface_tables::write(out, plan, run)?;
    coulomb_tables::write(out, plan, run)?;
    platform_files::write(out, plan, run)?;
    if !plan.in_space {
        return Ok(());
    }
    let (rate, pressed) = run.present(&plan.problem.fault);
    let (mut taken, mut states, mut events) = (Vec::new(), Vec::new(), Vec::new());
    rows::each(&out.join(snapshots::LIST), &mut |row| taken.push(row[1]))?;
    for (part, fault) in plan.faults.iter().enumerate() {
        let surface = Surface::of(plan, fault);
        let folder = out.join("fields");
        let entry = |file: &str, time: f64| PvdEntry {
            time,
            part,
            name: fault.name.clone(),
            file: format!("fields/{file}"),
        };
        states
            .extend(taken.iter().enumerate().map(|(k, &time)| entry(&snapshots::name(&fault.name, k), time)));
        for (k, event) in run.events().iter().enumerate() {
            let mut fields = Vec::from(along(plan, fault, "slip", &event.details.slip));
            fields.extend(along(plan, fault, "stress_drop", &event.details.drop));
            fields.extend(ruptured(fault, event));
            if fault.normal.opens {
                fields.push(Field::Scalar(
                    "opening".into(),
                    event.details.change(&OPENING)[fault.points.clone()].to_vec(),
                ));
            }
            let (file, onset) = (format!("{}_event_{k:03}.vtu", fault.name), event.onset.seconds());
            surface.put(&folder.join(&file), onset, &fields)?;
            events.push(entry(&file, onset));
        }
        let (file, time) = (format!("{}_end.vtu", fault.name), run.at.seconds());
        surface.put(&folder.join(&file), time, &state(plan, fault, &run.unknowns, (&rate, &pressed)))?;
        states.push(entry(&file, time));
    }
    atomic::write(&out.join("events.pvd"), &pvd(&events))?;
    atomic::write(&out.join("fields.pvd"), &pvd(&states))
}

/// Rupture times \[s\], largest slip rates \[m/s\] and, if slip may turn, its angles from the rake \[degrees\].
fn ruptured(fault: &FaultView, event: &Event<Rupture>) -> Vec<Field> {
    let points = || fault.points.clone();
    let times = points().map(|p| reached(event, p)).collect();
    let mut fields = vec![Field::Scalar("rupture_time".into(), times)];
    if let Some(peaks) = event.details.front.peaks.get(points()) {
        fields.push(Field::Scalar("largest_slip_rate".into(), peaks.to_vec()));
    }
    let angles: Vec<f64> = points().filter_map(|p| turned(event, p)).collect();
    if !angles.is_empty() {
        fields.push(Field::Scalar("turned".into(), angles));
    }
    fields
}
