//! Fields of bodies and faults as VTU files at equal intervals.

use super::moment::Moment;
use asperity_mechanics::dynamics::FaultState;
use asperity_output::fields::vtu::{Array, Grid, PvdEntry, Values, face_type, pvd};
use asperity_output::{OutputError, atomic};
use asperity_plan::dynamics::Plan;
use asperity_plan::faults::FaultView;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// Fields written so far.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Taken {
    /// Times \[s\].
    pub times: Vec<f64>,
    /// Magnitude of the velocity of each node at each of them \[m/s\]; empty if nothing is drawn.
    pub speeds: Vec<Vec<f64>>,
}

/// Writes `fields/bodies_00000.vtu`, in space also `fields/FAULT_00000.vtu`, and so on.
pub(super) struct Fields {
    folder: PathBuf,
    bodies: Grid,
    faults: Vec<Grid>,
    pub taken: Taken,
    drawn: bool,
}

/// Vectors in space of all nodes.
fn vectors(values: &[f64], axes: &[usize]) -> Vec<[f64; 3]> {
    let one = |own: &[f64]| {
        let mut vector = [0.0; 3];
        axes.iter().zip(own).for_each(|(&axis, v)| vector[axis] = *v);
        vector
    };
    values.chunks_exact(axes.len()).map(one).collect()
}

fn grid<const D: usize>(plan: &Plan<D>, fault: &FaultView) -> Grid {
    let places: Vec<[f64; 3]> = plan.points[fault.points.clone()].iter().map(|p| p.at).collect();
    let cells: Vec<(u8, Vec<usize>)> = fault.faces.iter().map(|f| (face_type(f.len()), f.clone())).collect();
    Grid::new(&places, &cells)
}

impl Fields {
    /// Fields of a run in `out`, after those already taken.
    ///
    /// # Errors
    /// If the folder cannot be created.
    pub fn new<const D: usize>(
        out: &Path,
        plan: &Plan<D>,
        taken: Taken,
        drawn: bool,
    ) -> Result<Self, OutputError> {
        let folder = out.join("fields");
        atomic::create_dir(&folder)?;
        let faults = if D == 3 { plan.faults.iter().map(|f| grid(plan, f)).collect() } else { Vec::new() };
        Ok(Self { folder, bodies: Grid::new(&plan.mesh.nodes, &plan.mesh.cells), faults, taken, drawn })
    }

    /// Writes the fields if they are due.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn step<const D: usize>(&mut self, plan: &Plan<D>, now: &Moment<'_>) -> Result<(), OutputError> {
        let Some([velocity, displacement]) = &now.fields else { return Ok(()) };
        let (number, velocity) = (self.taken.times.len(), vectors(velocity, &plan.axes));
        let displacement = vectors(displacement, &plan.axes);
        let arrays = [Array::vector("velocity", &velocity), Array::vector("displacement", &displacement)];
        let bytes = self.bodies.file(now.time, &arrays, &[]);
        atomic::write(&self.folder.join(name("bodies", number)), &bytes)?;
        for (fault, grid) in plan.faults.iter().zip(&self.faults) {
            let bytes = on_fault(plan, fault, grid, now);
            atomic::write(&self.folder.join(name(&fault.name, number)), &bytes)?;
        }
        self.taken.times.push(now.time);
        if self.drawn {
            let speed = |v: &[f64; 3]| v[0].hypot(v[1]).hypot(v[2]);
            self.taken.speeds.push(velocity.iter().map(speed).collect());
        }
        Ok(())
    }

    /// Writes `fields.pvd`, the collection of all fields.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn collect<const D: usize>(&self, out: &Path, plan: &Plan<D>) -> Result<(), OutputError> {
        let names: Vec<&str> =
            if D == 3 { plan.faults.iter().map(|f| f.name.as_str()).collect() } else { Vec::new() };
        let mut entries = Vec::new();
        for (number, &time) in self.taken.times.iter().enumerate() {
            for (part, stem) in std::iter::once("bodies").chain(names.iter().copied()).enumerate() {
                let file = format!("fields/{}", name(stem, number));
                entries.push(PvdEntry { time, part, name: stem.to_string(), file });
            }
        }
        atomic::write(&out.join("fields.pvd"), &pvd(&entries))
    }
}

fn name(stem: &str, number: usize) -> String {
    format!("{stem}_{number:05}.vtu")
}

/// Slip, slip rate and tractions on a fault in space.
fn on_fault<const D: usize>(plan: &Plan<D>, fault: &FaultView, grid: &Grid, now: &Moment<'_>) -> Vec<u8> {
    let FaultState { slip, rate, shear, normal, .. } = &*now.fault;
    let vectors = [slip, rate, shear].map(|values| in_space(plan, fault, values));
    let names = ["slip", "slip_rate", "shear_traction"];
    let mut arrays: Vec<Array<'_>> = names.iter().zip(&vectors).map(|(n, v)| Array::vector(n, v)).collect();
    arrays.push(Array::scalar("normal_traction", Values::F64(&normal[fault.points.clone()])));
    grid.file(now.time, &arrays, &[])
}

fn in_space<const D: usize>(plan: &Plan<D>, fault: &FaultView, values: &[f64]) -> Vec<[f64; 3]> {
    let points = plan.points.len();
    let one = |p: usize| {
        let view = &plan.points[p];
        let second = view.across.map_or([0.0; 3], |e| e.map(|e| e * values[points + p]));
        std::array::from_fn(|c| view.slides[c] * values[p] + second[c])
    };
    fault.points.clone().map(one).collect()
}
