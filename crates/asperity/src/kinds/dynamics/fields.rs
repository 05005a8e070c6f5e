//! Fields of bodies and faults as VTU files at equal intervals.

use super::moment::Moment;
use asperity_friction::points::Components;
use asperity_mechanics::dynamics::FaultState;
use asperity_output::fields::vtu::{Cell, Grid, PvdEntry, face_type, pvd};
use asperity_output::fields::{COLLECTION, Data, FILES, Field, FieldTimes, Series};
use asperity_output::tables::Sign;
use asperity_output::tables::describe::FileParts;
use asperity_output::{OutputError, atomic};
use asperity_plan::dynamics::Plan;
use asperity_plan::faults::FaultView;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// Fields written so far.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct WrittenFields {
    /// Times \[s\].
    pub times: Vec<f64>,
    /// Magnitude of the velocity of each node at each of them \[m/s\]; empty if nothing is drawn.
    pub speeds: Vec<Vec<f64>>,
}

/// Velocity \[m/s\] and displacement \[m\] of all nodes.
type Motion = [Vec<[f64; 3]>; 2];

/// Writes `fields/bodies_00000.vtu`, in space also `fields/FAULT_00000.vtu`, and so on.
pub(super) struct Fields<'a> {
    out: PathBuf,
    bodies: Series<'a, Motion>,
    faults: Vec<Series<'a, FaultState>>,
    pub taken: WrittenFields,
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
    let cells: Vec<Cell> = fault.faces.iter().map(|f| Cell::new(face_type(f.len()), f.clone())).collect();
    Grid::new(&places, &cells)
}

/// Fields of the bodies.
fn body_fields<const D: usize>(plan: &Plan<D>) -> Series<'_, Motion> {
    let grid = || Grid::new(&plan.mesh.nodes, &plan.mesh.cells);
    Series::new(FILES.named("bodies_*"), FieldTimes::Intervals, grid)
        .with(Field::vector("velocity", "m/s", Sign::Axis, "velocity"), |[velocity, _]: &Motion| {
            Data::from(velocity)
        })
        .with(Field::vector("displacement", "m", Sign::Axis, "displacement"), |[_, displacement]| {
            Data::from(displacement)
        })
}

/// Values of a state of the fault.
type Values = fn(&FaultState) -> &Components<Vec<f64>>;

/// Slip, slip rate and tractions on a fault in space.
fn fault_fields<'a, const D: usize>(plan: &'a Plan<D>, fault: &'a FaultView) -> Series<'a, FaultState> {
    let mut series =
        Series::new(FILES.named(&format!("{}_*", fault.name)), FieldTimes::Intervals, || grid(plan, fault));
    let vectors: [(Field, Values); 3] = [
        (Field::vector("slip", "m", Sign::Vector, "slip"), |now| &now.slip),
        (Field::vector("slip_rate", "m/s", Sign::Vector, "slip rate"), |now| &now.rate),
        (Field::vector("shear_traction", "Pa", Sign::Vector, "shear traction"), |now| &now.shear),
    ];
    for (field, values) in vectors {
        series = series.with(field, move |now| in_space(plan, fault, values(now)).into());
    }
    let normal = Field::scalar("normal_traction", "Pa", Sign::Compression, "normal traction");
    series.with(normal, |now: &FaultState| Data::from(now.normal[fault.points.clone()].to_vec()))
}

impl<'a> Fields<'a> {
    /// Fields of a run in `out`, after those already taken.
    ///
    /// # Errors
    /// If the folder cannot be created.
    pub fn new<const D: usize>(
        out: &Path,
        plan: &'a Plan<D>,
        taken: WrittenFields,
        drawn: bool,
    ) -> Result<Self, OutputError> {
        atomic::create_dir(&out.join("fields"))?;
        let faults = plan.faults.iter().filter(|_| D == 3).map(|fault| fault_fields(plan, fault)).collect();
        Ok(Self { out: out.to_path_buf(), bodies: body_fields(plan), faults, taken, drawn })
    }

    /// Fields by the paths of their files.
    pub fn all(&self) -> Vec<FileParts<Field>> {
        std::iter::once(self.bodies.fields()).chain(self.faults.iter().map(Series::fields)).collect()
    }

    /// Writes the fields if they are due.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn step<const D: usize>(&mut self, plan: &Plan<D>, now: &Moment<'_>) -> Result<(), OutputError> {
        let Some(fields) = &now.fields else { return Ok(()) };
        let (number, motion) = (self.taken.times.len(), fields.each_ref().map(|v| vectors(v, &plan.axes)));
        self.bodies.write(&self.out, number, now.time, &motion)?;
        for fault in &self.faults {
            fault.write(&self.out, number, now.time, &now.fault)?;
        }
        self.taken.times.push(now.time);
        if self.drawn {
            let speed = |v: &[f64; 3]| v[0].hypot(v[1]).hypot(v[2]);
            self.taken.speeds.push(motion[0].iter().map(speed).collect());
        }
        Ok(())
    }

    /// Writes `fields.pvd`, the collection of all fields.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn collect<const D: usize>(&self, plan: &Plan<D>) -> Result<(), OutputError> {
        let mut entries = Vec::new();
        for (number, &time) in self.taken.times.iter().enumerate() {
            let mut entry = |part, name: &str, file| {
                entries.push(PvdEntry { time, part, name: name.to_string(), file });
            };
            entry(0, "bodies", self.bodies.file(number));
            for (k, (fault, series)) in plan.faults.iter().zip(&self.faults).enumerate() {
                entry(k + 1, &fault.name, series.file(number));
            }
        }
        atomic::write(&self.out.join(COLLECTION.path), &pvd(&entries))
    }
}

fn in_space<const D: usize>(
    plan: &Plan<D>,
    fault: &FaultView,
    values: &Components<Vec<f64>>,
) -> Vec<[f64; 3]> {
    let one = |p: usize| {
        let view = &plan.points[p];
        let second = view.across.map_or([0.0; 3], |e| e.map(|e| e * values.component(1)[p]));
        std::array::from_fn(|c| view.slides[c] * values.component(0)[p] + second[c])
    };
    fault.points.clone().map(one).collect()
}
