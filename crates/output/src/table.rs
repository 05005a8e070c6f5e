//! CSV tables: profiles along an interface at one time, and histories at its probes.

use super::decimals::{shortest, shortest_scientific};
use super::view::{InterfaceFields, InterfaceMesh, PointValues};
use asperity_run::Energies;

/// A column of an interface table: its name with unit, and the function that reads it.
type Column = (&'static str, fn(&InterfaceFields, usize) -> f64);

/// Columns of a profile.
const PROFILE: [Column; 11] = [
    ("gap [m]", InterfaceFields::written_gap),
    ("normal_traction [Pa]", |f, i| f.normal_traction[i]),
    ("shear_traction [Pa]", |f, i| f.shear_traction[i]),
    ("relative_displacement [m]", |f, i| f.relative_displacement[i]),
    ("slip [m]", |f, i| f.slip[i]),
    ("slip_rate [m/s]", |f, i| f.slip_rate[i]),
    ("friction [-]", |f, i| f.friction[i]),
    ("mean_normal_traction [Pa]", |f, i| f.mean_normal_traction[i]),
    ("mean_shear_traction [Pa]", |f, i| f.mean_shear_traction[i]),
    ("status [0 open 1 stick 2 slip]", |f, i| f64::from(f.status[i])),
    ("paired [0 no 1 yes]", |f, i| f64::from(u8::from(f.paired(i)))),
];

/// Columns of each probe.
const PROBE: [Column; 6] = [
    ("relative_displacement [m]", |f, i| f.relative_displacement[i]),
    ("slip [m]", |f, i| f.slip[i]),
    ("slip_rate [m/s]", |f, i| f.slip_rate[i]),
    ("friction [-]", |f, i| f.friction[i]),
    ("normal_traction [Pa]", |f, i| f.normal_traction[i]),
    ("shear_traction [Pa]", |f, i| f.shear_traction[i]),
];

/// Additional columns of profiles and probes in space.
const SPACE: [Column; 6] = [
    ("slip_x [m]", |f, i| f.slip_vector[i][0]),
    ("slip_y [m]", |f, i| f.slip_vector[i][1]),
    ("slip_z [m]", |f, i| f.slip_vector[i][2]),
    ("shear_traction_x [Pa]", |f, i| f.shear_vector[i][0]),
    ("shear_traction_y [Pa]", |f, i| f.shear_vector[i][1]),
    ("shear_traction_z [Pa]", |f, i| f.shear_vector[i][2]),
];

/// Columns of a table with the additional columns in space.
fn columns(table: &'static [Column], mesh: &InterfaceMesh) -> impl Iterator<Item = &'static Column> + use<> {
    table.iter().chain(if mesh.in_space { &SPACE[..] } else { &[] })
}

/// The shortest decimal that reads back as the same number, with an exponent if that is easier to read.
pub(super) fn number(value: f64) -> String {
    // Outside this range positional notation is mostly zeros.
    if value == 0.0 {
        return "0".into();
    }
    if (1e-2..1e6).contains(&value.abs()) { shortest(value) } else { shortest_scientific(value) }
}

/// Names of the columns of the state variables of an interface's law.
fn states(mesh: &InterfaceMesh) -> impl Iterator<Item = String> {
    (1..=mesh.states).map(|k| format!("state_{k}"))
}

/// Profile with one row per slave node: time, position, tributary area and all fields.
pub(super) fn profile(time: f64, mesh: &InterfaceMesh, fields: &InterfaceFields) -> String {
    let mut rows = Rows::default();
    let head = ["time [s]", "node", "x [m]", "y [m]", "z [m]", "area [m2]"];
    rows.push(
        head.iter()
            .map(ToString::to_string)
            .chain(columns(&PROFILE, mesh).map(|(name, _)| (*name).to_string()))
            .chain(states(mesh)),
    );
    for (i, position) in mesh.positions.iter().enumerate() {
        let place = [number(time), i.to_string()].into_iter().chain(position.iter().map(|&x| number(x)));
        let area = number(fields.area[i]);
        let states = (0..mesh.states).map(|k| number(fields.state(k, i)));
        let values = columns(&PROFILE, mesh).map(|(_, read)| number(read(fields, i)));
        rows.push(place.chain([area]).chain(values).chain(states));
    }
    rows.text()
}

/// Header of a table of probes.
pub(super) fn probe_header(mesh: &InterfaceMesh) -> String {
    let mut rows = Rows::default();
    let labels = crate::plots::labels::position_labels(mesh.probes.iter().map(|&node| mesh.positions[node]));
    let names: Vec<String> =
        columns(&PROBE, mesh).map(|(name, _)| (*name).to_string()).chain(states(mesh)).collect();
    let columns = labels.iter().flat_map(|label| names.iter().map(move |name| format!("{name} at {label}")));
    rows.push(WHEN.iter().map(ToString::to_string).chain(columns));
    rows.text()
}

/// One row of a table of probes.
pub(super) fn probe_row(
    time: f64,
    stage: usize,
    step: usize,
    mesh: &InterfaceMesh,
    fields: &InterfaceFields,
) -> String {
    let values = mesh.probes.iter().flat_map(|&i| {
        let states = (0..mesh.states).map(move |k| fields.state(k, i));
        columns(&PROBE, mesh).map(move |(_, read)| read(fields, i)).chain(states)
    });
    history_row(time, stage, step, &values.collect::<Vec<f64>>())
}

/// Columns of a history at a point of a body.
pub(super) const POINT: [&str; 10] = [
    "displacement_x [m]",
    "displacement_y [m]",
    "displacement_z [m]",
    "stress_xx [Pa]",
    "stress_yy [Pa]",
    "stress_zz [Pa]",
    "stress_xy [Pa]",
    "stress_yz [Pa]",
    "stress_zx [Pa]",
    "mises [Pa]",
];

/// Header of a history at a point of a body.
pub(super) fn point_header() -> String {
    let mut rows = Rows::default();
    rows.push(WHEN.iter().chain(&POINT).map(ToString::to_string));
    rows.text()
}

/// Columns of a force in this unit.
pub(super) fn force_columns(unit: &str) -> impl Iterator<Item = String> {
    ["x", "y", "z"].into_iter().map(move |axis| format!("force_{axis} [{unit}]"))
}

/// Columns of a spring, with forces in this unit.
pub(super) fn spring_columns(unit: &str) -> [String; 4] {
    ["load_point [m]".into(), "displacement [m]".into(), format!("force [{unit}]"), "friction [-]".into()]
}

/// Header of a history of a force in this unit.
pub(super) fn force_header(unit: &str) -> String {
    let mut rows = Rows::default();
    rows.push(WHEN.iter().map(ToString::to_string).chain(force_columns(unit)));
    rows.text()
}

/// Energies in the order of the columns of files, in every kind of run.
pub const ENERGIES: [&str; 14] = [
    "kinetic",
    "elastic",
    "contact",
    "springs",
    "plastic",
    "viscous",
    "friction",
    "numerical",
    "absorbed",
    "handover",
    "start",
    "loads",
    "motions",
    "released",
];

/// Header of an energy budget in this unit.
#[must_use]
pub fn energy_header(unit: &str) -> String {
    let mut rows = Rows::default();
    let columns = ENERGIES.iter().chain(&["missing"]).map(|name| format!("{name} [{unit}]"));
    rows.push(WHEN.iter().map(ToString::to_string).chain(columns));
    rows.text()
}

/// Row of an energy budget.
#[must_use]
pub fn energy_row(time: f64, stage: usize, step: usize, energies: &Energies) -> String {
    let mut values = ENERGIES.map(|name| energies.part(name)).to_vec();
    values.push(energies.missing());
    history_row(time, stage, step, &values)
}

/// Header of the largest slip rates of interfaces.
pub(super) fn rates_header<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let mut rows = Rows::default();
    let columns = names.map(|name| format!("largest slip_rate of {name} [m/s]"));
    rows.push(WHEN.iter().map(ToString::to_string).chain(columns));
    rows.text()
}

/// Header of a history of a spring, with forces in this unit.
pub(super) fn spring_header(unit: &str) -> String {
    let mut rows = Rows::default();
    rows.push(WHEN.iter().map(ToString::to_string).chain(spring_columns(unit)));
    rows.text()
}

/// One row of a history: time, stage, step, values.
pub(super) fn history_row(time: f64, stage: usize, step: usize, values: &[f64]) -> String {
    let mut rows = Rows::default();
    let when = [number(time), stage.to_string(), step.to_string()];
    rows.push(when.into_iter().chain(values.iter().map(|&v| number(v))));
    rows.text()
}

/// Values of a point in the order of its columns.
pub(super) fn point_values(point: &PointValues) -> Vec<f64> {
    point.displacement.iter().chain(&point.stress).copied().chain([point.mises]).collect()
}

/// First columns of a history.
pub(super) const WHEN: [&str; 3] = ["time [s]", "stage", "step"];

/// CSV rows in memory.
struct Rows(csv::Writer<Vec<u8>>);

impl Default for Rows {
    fn default() -> Self {
        Self(csv::Writer::from_writer(Vec::new()))
    }
}

impl Rows {
    fn push(&mut self, row: impl Iterator<Item = String>) {
        self.0.write_record(row.map(String::into_bytes)).expect("writing to a Vec cannot fail");
    }

    fn text(self) -> String {
        let bytes = self.0.into_inner().expect("writing to a Vec cannot fail");
        String::from_utf8(bytes).expect("rows are made of text")
    }
}
