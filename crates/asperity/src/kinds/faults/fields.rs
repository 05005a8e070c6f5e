//! Fields on faults in 3D as VTU files: states during a run and at its end, and slip and traction drop of each event.

use super::states::has_theta;
use super::{locking, pore};
use asperity_cycles::heat::TEMPERATURE;
use asperity_cycles::{Components, Layout, OPENING, Pressed};
use asperity_output::fields::vtu::{Array, Grid, Values, face_type};
use asperity_output::{OutputError, atomic};
use asperity_plan::faults::cadence::log_rate;
use asperity_plan::faults::{FaultView, Outline, Plan};
use rayon::prelude::*;
use std::path::Path;

/// Points and cells of a fault in a file.
#[derive(Debug)]
pub(super) struct Surface {
    grid: Grid,
    /// True if each cell has a value, and not each point.
    by_cell: bool,
}

impl Surface {
    /// Surface of a fault: its triangles, or else faces between its points.
    pub fn of(plan: &Plan, fault: &FaultView) -> Self {
        let points = &plan.points[fault.points.clone()];
        if let Some(Outline { nodes, corners }) = &fault.outline {
            let cells: Vec<(u8, Vec<usize>)> = corners.iter().map(|c| (face_type(3), c.to_vec())).collect();
            return Self { grid: Grid::new(nodes, &cells), by_cell: true };
        }
        let places: Vec<[f64; 3]> = points.iter().map(|p| p.at).collect();
        let cells: Vec<(u8, Vec<usize>)> =
            fault.faces.iter().map(|f| (face_type(f.len()), f.clone())).collect();
        Self { grid: Grid::new(&places, &cells), by_cell: false }
    }

    /// Writes fields. Returns the size of the file \[bytes\].
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn put(&self, path: &Path, time: f64, fields: &[Field]) -> Result<u64, OutputError> {
        let arrays: Vec<Array<'_>> = fields.par_iter().map(Field::array).collect();
        let (points, cells) = if self.by_cell { (&[][..], &arrays[..]) } else { (&arrays[..], &[][..]) };
        let bytes = self.grid.file(time, points, cells);
        atomic::write(path, &bytes)?;
        Ok(bytes.len() as u64)
    }
}

/// A field on a fault.
pub(super) enum Field {
    Scalar(String, Vec<f64>),
    Vector(String, Vec<[f64; 3]>),
}

impl Field {
    fn array(&self) -> Array<'_> {
        match self {
            Self::Scalar(name, values) => Array::scalar(name, Values::F64(values)),
            Self::Vector(name, values) => Array::vector(name, values),
        }
    }
}

/// Values along `rake`, or magnitudes for vector slip; and the vectors in space as `NAME_vector`.
pub(super) fn along(
    plan: &Plan,
    fault: &FaultView,
    name: &'static str,
    values: &Components<impl AsRef<[f64]>>,
) -> [Field; 2] {
    let points = || fault.points.clone();
    let scalars = if values.components() == 1 {
        values.all()[points()].to_vec()
    } else {
        points().map(|p| values.size(p)).collect()
    };
    let vectors = points().map(|p| plan.vector(values, p)).collect();
    [Field::Scalar(name.into(), scalars), Field::Vector(format!("{name}_vector"), vectors)]
}

/// Slip \[m\], log10 of the slip rate \[m/s\], friction and normal traction \[Pa\], temperature and
/// pore pressure where friction heats the fault, coupling where plates load it, and the state variables of the law, with log10 of
/// θ \[s\] where it has one. `now` holds slip rates and normal tractions.
pub(super) fn state(plan: &Plan, fault: &FaultView, y: &[f64], now: (&[f64], &Pressed)) -> Vec<Field> {
    let layout = Layout::of(&plan.problem.fault);
    let (law, n) = (&plan.problem.fault.law, plan.points.len());
    let (rate, pressed) = now;
    let normal = |p: usize| pressed.normal[p];
    let shear: Vec<f64> = layout.m().map(|i| normal(i % n) * law.scale(i % n) * y[i]).collect();
    let (rate, shear) = (Components::new(rate, n), Components::new(shear, n));
    let speeds = fault.points.clone().map(|p| log_rate(rate.size(p))).collect();
    let vectors = fault.points.clone().map(|p| plan.vector(&rate, p)).collect();
    let mut fields = Vec::from(along(plan, fault, "slip", &layout.slip_of(y)));
    fields.push(Field::Scalar("log10_slip_rate".into(), speeds));
    fields.push(Field::Vector("slip_rate_vector".into(), vectors));
    fields.extend(along(plan, fault, "shear_traction", &shear));
    fields.push(Field::Scalar("normal_traction".into(), fault.points.clone().map(normal).collect()));
    let of = |quantity| pressed.of(quantity)[fault.points.clone()].to_vec();
    if fault.normal.opens {
        fields.push(Field::Scalar("opening".into(), of(&OPENING)));
    }
    if fault.heat.is_some() {
        fields.push(Field::Scalar("temperature".into(), of(&TEMPERATURE)));
    }
    if pore::changes(plan, fault.points.start) {
        let values = fault.points.clone().map(|p| pore::at(pressed, p)).collect();
        fields.push(Field::Scalar("pore_pressure".into(), values));
    }
    if locking::loaded(plan, fault) {
        let values = fault.points.clone().map(|p| locking::coupling(plan, &rate, p)).collect();
        fields.push(Field::Scalar("coupling".into(), values));
    }
    let states = layout.states_of(y);
    if has_theta(plan, fault) {
        let log = |p: usize| plan.points[p].theta.map_or(f64::NAN, |theta| theta.log10(states.at(p)[0]));
        fields.push(Field::Scalar("log10_theta".into(), fault.points.clone().map(log).collect()));
    }
    for k in 0..law.states() {
        let values = fault.points.clone().map(|p| states.at(p)[k]).collect();
        fields.push(Field::Scalar(format!("state_{}", k + 1), values));
    }
    fields
}
