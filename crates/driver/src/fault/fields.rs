//! Fields on faults in space as VTU: the state at the end of a run, and slip and fall of traction of each event.

use super::equations::Layout;
use super::plan::{FaultView, Plan};
use super::run::Run;
use crate::observe::vtu::{Array, Grid, PvdEntry, Values, pvd};
use crate::observe::{ObserveError, atomic};
use std::path::Path;

/// Writes `fields/FAULT_event_000.vtu` of each event, `fields/FAULT_end.vtu` and a collection of all, at the times of their onsets.
/// Faults in the plane have profiles instead.
///
/// # Errors
/// When a file cannot be written.
pub fn write(out: &Path, plan: &Plan, run: &Run) -> Result<(), ObserveError> {
    if !plan.in_space {
        return Ok(());
    }
    let folder = out.join("fields");
    atomic::create_dir(&folder)?;
    let mut entries = Vec::new();
    for (part, fault) in plan.faults.iter().enumerate() {
        let grid = grid(plan, fault);
        let of = |values: &[f64]| values[fault.points.clone()].to_vec();
        let mut put = |file: String, time: f64, fields: &[(&str, Vec<f64>)]| {
            let arrays: Vec<Array<'_>> =
                fields.iter().map(|(name, v)| Array::scalar(name, Values::F64(v))).collect();
            entries.push(PvdEntry { time, part, name: fault.name.clone(), file: format!("fields/{file}") });
            atomic::write(&folder.join(&file), &grid.file(time, &arrays, &[]))
        };
        for (k, event) in run.catalogue.events().iter().enumerate() {
            let fields = [("slip", of(&event.slip)), ("stress_drop", of(&event.drop))];
            put(format!("{}_event_{k:03}.vtu", fault.name), event.onset.seconds(), &fields)?;
        }
        put(format!("{}_end.vtu", fault.name), run.at.seconds(), &at_end(plan, fault, run))?;
    }
    atomic::write(&out.join("fields.pvd"), &pvd(&entries))
}

/// Slip \[m\], log10 of the slip rate \[m/s\], friction and normal traction \[Pa\].
fn at_end(plan: &Plan, fault: &FaultView, run: &Run) -> Vec<(&'static str, Vec<f64>)> {
    let layout = Layout::of(&plan.fault);
    let (law, y) = (&plan.fault.law, &run.unknowns);
    let mut rate = vec![0.0; law.points()];
    law.slip_rates(0, &y[layout.m()], &y[layout.states()], &mut rate);
    let each = |value: &dyn Fn(usize) -> f64| fault.points.clone().map(value).collect::<Vec<f64>>();
    let normal = |p: usize| layout.normal_of(&plan.fault, run.at, y, p);
    vec![
        ("slip", each(&|p| y[layout.slip().start + p])),
        ("log10_slip_rate", each(&|p| rate[p].abs().log10())),
        ("shear_traction", each(&|p| normal(p) * law.scale(p) * y[p])),
        ("normal_traction", each(&normal)),
    ]
}

/// VTK's type of a face with so many nodes; their order is the elements' own.
fn face_type(nodes: usize) -> u8 {
    match nodes {
        3 => 5,
        4 => 9,
        _ => 28,
    }
}

fn grid(plan: &Plan, fault: &FaultView) -> Grid {
    let places: Vec<[f64; 3]> = plan.points[fault.points.clone()].iter().map(|p| p.at).collect();
    let cells: Vec<(u8, Vec<usize>)> = fault.faces.iter().map(|f| (face_type(f.len()), f.clone())).collect();
    Grid::new(&places, &cells)
}
