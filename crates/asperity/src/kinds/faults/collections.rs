//! Files of a 3D run at its end: fields of events and of the last state, and the collections of all fields.

use super::fields::{self, Present};
use super::{coulomb_tables, event_tables, platform_files, receiver_tables, snapshots, surface_tables};
use asperity_cycles::FaultRun;
use asperity_output::fields::COLLECTION;
use asperity_output::fields::vtu::{PvdEntry, pvd};
use asperity_output::tables::rows;
use asperity_output::{OutputError, OutputFile, atomic};
use asperity_plan::faults::Plan;
use std::path::Path;

/// List of the fields of events.
pub(super) const EVENTS: OutputFile =
    OutputFile::new("events.pvd", "list of the fields on faults over each event, for ParaView");

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
    let present = Present { unknowns: run.unknowns.clone(), rate, pressed };
    let (mut taken, mut states, mut events) = (Vec::new(), Vec::new(), Vec::new());
    rows::each(&out.join(snapshots::LIST.path), &mut |row| taken.push(row[1]))?;
    for (part, fault) in plan.faults.iter().enumerate() {
        let entry = |file: String, time: f64| PvdEntry { time, part, name: fault.name.clone(), file };
        let during = fields::states(plan, fault);
        states.extend(taken.iter().enumerate().map(|(k, &time)| entry(during.file(k), time)));
        let ruptured = fields::events(plan, fault);
        for (k, event) in run.events().iter().enumerate() {
            let onset = event.onset.seconds();
            ruptured.write(out, k, onset, event)?;
            events.push(entry(ruptured.file(k), onset));
        }
        let (last, time) = (fields::last(plan, fault), run.at.seconds());
        last.write(out, 0, time, &present)?;
        states.push(entry(last.file(0), time));
    }
    atomic::write(&out.join(EVENTS.path), &pvd(&events))?;
    atomic::write(&out.join(COLLECTION.path), &pvd(&states))
}
