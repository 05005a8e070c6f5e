//! Displacements of the bodies as VTU files.

use asperity_cycles::{FaultRun, Layout, OPENING};
use asperity_output::fields::vtu::{Grid, PvdEntry, pvd};
use asperity_output::fields::{Data, FILES, Field, FieldTimes, Series};
use asperity_output::tables::Sign;
use asperity_output::{OutputError, OutputFile, atomic};
use asperity_plan::faults::{BodiesView, Plan};
use std::path::Path;

/// List of the displacements.
pub(super) const COLLECTION: OutputFile = OutputFile::new(
    "bodies.pvd",
    "list of the displacements of bodies over each event and at the end, for ParaView",
);

/// Displacements over each event, and at the end.
pub(super) fn series(view: &BodiesView) -> [Series<'_, Vec<[f64; 3]>>; 2] {
    let moved = |path: &str, times, meaning| {
        let series = Series::new(FILES.named(path), times, || Grid::new(&view.nodes, &view.cells));
        series.with(Field::vector("displacement", "m", Sign::Axis, meaning), |moved| Data::from(moved))
    };
    [
        moved("bodies_event_*", FieldTimes::Events, "displacement that the event causes"),
        moved("bodies_end", FieldTimes::End, "displacement since the start"),
    ]
}

/// Writes displacements of the bodies as VTU files, if the scene requests them: the displacement that the slip of each event causes, and the
/// displacement from the start to the end of the run.
///
/// # Errors
/// If a file cannot be written.
pub fn write(out: &Path, plan: &Plan, run: &FaultRun) -> Result<(), OutputError> {
    let Some(view) = plan.bodies.as_ref().filter(|view| view.shown) else { return Ok(()) };
    atomic::create_dir(&out.join("fields"))?;
    let mut entries = Vec::new();
    let mut put = |series: &Series<'_, Vec<[f64; 3]>>, number: usize, time: f64, moved: Vec<[f64; 3]>| {
        entries.push(PvdEntry { time, part: 0, name: "bodies".into(), file: series.file(number) });
        series.write(out, number, time, &moved)
    };
    let [of_events, last] = series(view);
    for (k, event) in run.events().iter().enumerate() {
        // Loads are zero at time 0, so these displacements are caused by slip and opening alone.
        let displacement =
            view.bodies.vectors(&[event.details.slip.all(), event.details.change(&OPENING)].concat(), 0.0);
        put(&of_events, k, event.onset.seconds(), displacement)?;
    }
    let slip = &run.unknowns[Layout::from_fault(&plan.problem.fault).slip()];
    let pressed = plan.problem.fault.pressed(run.at, &run.unknowns);
    let end = run.at.seconds();
    put(&last, 0, end, view.bodies.vectors(&view.jumps([slip, pressed.values(&OPENING)], end), end))?;
    atomic::write(&out.join(COLLECTION.path), &pvd(&entries))
}
