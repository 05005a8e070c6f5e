//! Stresses of bodies that the slip of each event causes, as VTU files.

use asperity_cycles::{FaultRun, OPENING};
use asperity_output::fields::vtu::Grid;
use asperity_output::fields::{Field, FieldTimes, Series};
use asperity_output::tables::Sign;
use asperity_output::{OutputError, OutputFile};
use asperity_plan::faults::{BodiesView, Change, Plan};
use std::path::Path;

/// Stresses of events.
pub(super) const FILE: OutputFile =
    OutputFile::new("events/stress_*.vtu", "stress of bodies that each event causes");

/// Stress of a cell, and its change on the planes.
type CellStress = ([f64; 6], Change);

/// A part of a change.
type Part = fn(&Change) -> f64;

/// Stresses of the cells of bodies.
pub(super) fn series(view: &BodiesView) -> Series<'_, Vec<CellStress>> {
    // VTK's order of components is that of stresses here.
    let stress = Field::tensor("stress", "Pa", Sign::Tension, "stress that the event causes").in_cells();
    let mut series = Series::new(FILE.path, FieldTimes::Events, || Grid::new(&view.nodes, &view.cells))
        .with(stress, |all: &Vec<CellStress>| {
            all.iter().map(|(stress, _)| *stress).collect::<Vec<_>>().into()
        });
    let change = |name, sign, meaning| Field::scalar(name, "Pa", sign, meaning).in_cells();
    let parts: [(Field, Part); 3] = [
        (change("shear_change", Sign::Driving, "change of the shear traction along the rake"), |c| c.shear),
        (change("normal_change", Sign::Compression, "change of the normal traction"), |c| c.normal),
        (change("coulomb_change", Sign::Driving, "change of Coulomb stress"), |c| c.coulomb),
    ];
    for (field, part) in parts {
        series = series.with(field, move |all| all.iter().map(|(_, c)| part(c)).collect::<Vec<_>>().into());
    }
    series
}

/// Writes `events/stress_000.vtu` and so on for the first events: stress of each cell that slip and opening in the event
/// cause, and its change on the planes.
///
/// # Errors
/// If a file cannot be written.
pub fn write(out: &Path, plan: &Plan, run: &FaultRun) -> Result<(), OutputError> {
    let (Some(stresses), Some(view)) = (&plan.stresses, &plan.bodies) else { return Ok(()) };
    let series = series(view);
    for (number, event) in run.events().iter().enumerate().take(plan.event_files) {
        let jumps = [event.details.slip.all(), event.details.change(&OPENING)].concat();
        series.write(out, number, event.onset.seconds(), &stresses.at(view, &jumps))?;
    }
    Ok(())
}
