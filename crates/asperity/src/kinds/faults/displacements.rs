//! Displacements of the bodies as VTU files.

use asperity_cycles::{FaultRun, Layout, OPENING};
use asperity_output::fields::vtu::{Array, Grid, PvdEntry, pvd};
use asperity_output::{OutputError, atomic};
use asperity_plan::faults::Plan;
use std::path::Path;

/// Writes displacements of the bodies as VTU files, if the scene requests them: the displacement that the slip of each event causes, and the
/// displacement from the start to the end of the run.
///
/// # Errors
/// If a file cannot be written.
pub fn write(out: &Path, plan: &Plan, run: &FaultRun) -> Result<(), OutputError> {
    let Some(view) = plan.bodies.as_ref().filter(|view| view.shown) else { return Ok(()) };
    let folder = out.join("fields");
    atomic::create_dir(&folder)?;
    let grid = Grid::new(&view.nodes, &view.cells);
    let mut entries = Vec::new();
    let mut put = |file: String, time: f64, displacement: &[[f64; 3]]| {
        let arrays = [Array::vector("displacement", displacement)];
        entries.push(PvdEntry { time, part: 0, name: "bodies".into(), file: format!("fields/{file}") });
        atomic::write(&folder.join(&file), &grid.file(time, &arrays, &[]))
    };
    for (k, event) in run.events().iter().enumerate() {
        // Loads are zero at time 0, so these displacements are caused by slip and opening alone.
        let displacement =
            view.bodies.vectors(&[event.details.slip.all(), event.details.change(&OPENING)].concat(), 0.0);
        put(format!("bodies_event_{k:03}.vtu"), event.onset.seconds(), &displacement)?;
    }
    let slip = &run.unknowns[Layout::of(&plan.problem.fault).slip()];
    let pressed = plan.problem.fault.pressed(run.at, &run.unknowns);
    let end = run.at.seconds();
    put(
        "bodies_end.vtu".into(),
        end,
        &view.bodies.vectors(&view.jumps([slip, pressed.of(&OPENING)], end), end),
    )?;
    atomic::write(&out.join("bodies.pvd"), &pvd(&entries))
}
