//! Stresses of bodies that the slip of each event causes, as VTU files.

use super::source_time::FOLDER;
use asperity_cycles::{FaultRun, OPENING};
use asperity_output::fields::vtu::{Array, Grid, Values};
use asperity_output::{OutputError, atomic};
use asperity_plan::faults::{Change, Plan};
use std::path::Path;

/// Writes `events/stress_000.vtu` and so on for the first events: stress of each cell that slip and opening in the event
/// cause, and its change on the planes.
///
/// # Errors
/// If a file cannot be written.
pub fn write(out: &Path, plan: &Plan, run: &FaultRun) -> Result<(), OutputError> {
    let (Some(stresses), Some(view)) = (&plan.stresses, &plan.bodies) else { return Ok(()) };
    let grid = Grid::new(&view.nodes, &view.cells);
    let folder = out.join(FOLDER);
    for (number, event) in run.events().iter().enumerate().take(plan.event_files) {
        let jumps = [event.details.slip.all(), event.details.change(&OPENING)].concat();
        let (stress, changes): (Vec<[f64; 6]>, Vec<Change>) = stresses.at(view, &jumps).into_iter().unzip();
        let part = |of: fn(&Change) -> f64| changes.iter().map(of).collect::<Vec<f64>>();
        let [shear, normal, coulomb] = [part(|c| c.shear), part(|c| c.normal), part(|c| c.coulomb)];
        // VTK's order of components is that of stresses here.
        let arrays = [
            Array::tensor("stress", &stress),
            Array::scalar("shear_change", Values::F64(&shear)),
            Array::scalar("normal_change", Values::F64(&normal)),
            Array::scalar("coulomb_change", Values::F64(&coulomb)),
        ];
        let bytes = grid.file(event.onset.seconds(), &[], &arrays);
        atomic::write(&folder.join(format!("stress_{number:03}.vtu")), &bytes)?;
    }
    Ok(())
}
