//! CSV tables: profiles along an interface at one time, and histories at its probes.

use super::quantity::{self, Quantity};
use super::view::{InterfaceFields, InterfaceMesh, PointValues};
use crate::OutputFile;
use crate::tables::column::{self, Column, Sign};
use crate::tables::csv_rows::Rows;
use crate::tables::history::{history_row, number, when};

/// Profiles of interfaces.
pub(super) const PROFILES: OutputFile =
    OutputFile::new("profiles/*.csv", "whole surfaces at output times (CSV)");
/// Probes of interfaces.
pub(super) const PROBES: OutputFile =
    OutputFile::new("probes/*.csv", "positions on surfaces, at every step (CSV)");
/// Largest slip rates.
pub(super) const RATES: OutputFile =
    OutputFile::new("largest_rates.csv", "largest slip rate of each interface with events, at every step");

/// Columns of a profile.
const PROFILE: [&Quantity; 12] = [
    &quantity::GAP,
    &quantity::NORMAL_TRACTION,
    &quantity::SHEAR_TRACTION,
    &quantity::RELATIVE_DISPLACEMENT,
    &quantity::SLIP,
    &quantity::SLIP_RATE,
    &quantity::FRICTION,
    &quantity::MEAN_NORMAL_TRACTION,
    &quantity::MEAN_SHEAR_TRACTION,
    &quantity::FRICTION_WORK,
    &quantity::STATUS,
    &quantity::PAIRED,
];

/// Columns of each probe.
const PROBE: [&Quantity; 6] = [
    &quantity::RELATIVE_DISPLACEMENT,
    &quantity::SLIP,
    &quantity::SLIP_RATE,
    &quantity::FRICTION,
    &quantity::NORMAL_TRACTION,
    &quantity::SHEAR_TRACTION,
];

/// Columns of a table of an interface, with vectors in space, and states of its law.
fn columns(quantities: &[&Quantity], mesh: &InterfaceMesh) -> Vec<Column> {
    let mut columns: Vec<Column> = quantities.iter().map(|quantity| quantity.column()).collect();
    if mesh.in_space {
        columns.extend(column::axes("slip", "m", Sign::Vector, "slip of the slave past the master"));
        columns.extend(column::axes(
            "shear_traction",
            "Pa",
            Sign::Vector,
            "shear traction of the slave side",
        ));
    }
    columns.extend(
        (1..=mesh.states).map(|k| Column::new(format!("state_{k}"), "", Sign::None, quantity::STATE)),
    );
    columns
}

/// Values of these columns at a node.
fn values(quantities: &[&Quantity], mesh: &InterfaceMesh, now: &InterfaceFields, node: usize) -> Vec<f64> {
    let mut values: Vec<f64> = quantities.iter().map(|quantity| (quantity.read)(now, node)).collect();
    if mesh.in_space {
        values.extend(now.slip_vector[node]);
        values.extend(now.shear_vector[node]);
    }
    values.extend((0..mesh.states).map(|k| now.state(k, node)));
    values
}

/// Columns of a profile.
pub(super) fn profile_columns(mesh: &InterfaceMesh) -> Vec<Column> {
    let node = Column::new("node", "", Sign::None, "number of the slave node");
    let place = [column::time(), node].into_iter().chain(column::position()).chain([quantity::AREA.column()]);
    place.chain(columns(&PROFILE, mesh)).collect()
}

/// Profile with one row per slave node: time, position, tributary area and all fields.
pub(super) fn profile(time: f64, mesh: &InterfaceMesh, fields: &InterfaceFields) -> String {
    let mut text = column::header(&profile_columns(mesh));
    let mut rows = Rows::default();
    for (i, position) in mesh.positions.iter().enumerate() {
        let place = [number(time), i.to_string()].into_iter().chain(position.iter().map(|&x| number(x)));
        let all = [fields.area[i]].into_iter().chain(values(&PROFILE, mesh, fields, i));
        rows.push(place.chain(all.map(number)));
    }
    text.push_str(&rows.text());
    text
}

/// Columns of a table of probes.
pub(super) fn probe_columns(mesh: &InterfaceMesh) -> Vec<Column> {
    let labels = crate::labels::position_labels(mesh.probes.iter().map(|&node| mesh.positions[node]));
    let mut all = Vec::from(when());
    for label in &labels {
        all.extend(columns(&PROBE, mesh).into_iter().map(|column| column.at(label)));
    }
    all
}

/// One row of a table of probes.
pub(super) fn probe_row(
    time: f64,
    stage: usize,
    step: usize,
    mesh: &InterfaceMesh,
    fields: &InterfaceFields,
) -> String {
    let all = mesh.probes.iter().flat_map(|&node| values(&PROBE, mesh, fields, node));
    history_row(time, stage, step, &all.collect::<Vec<f64>>())
}

/// Columns of a history at a point of a body.
pub(super) fn point_columns() -> Vec<Column> {
    let moved = column::axes("displacement", "m", Sign::Axis, "displacement");
    let mises = Column::new("mises", "Pa", Sign::Size, "equivalent stress of von Mises");
    when().into_iter().chain(moved).chain(column::stress()).chain([mises]).collect()
}

/// Columns of a history of a force in this unit.
pub(super) fn force_columns(unit: &'static str) -> Vec<Column> {
    let force = column::axes("force", unit, Sign::Axis, "force on the body through the set");
    when().into_iter().chain(force).collect()
}

/// Columns of a history of a spring, with forces in this unit.
pub(super) fn spring_columns(unit: &'static str) -> Vec<Column> {
    let own = [
        Column::new(
            "load_point",
            "m",
            Sign::Axis,
            "displacement of the load point since the spring was attached",
        ),
        Column::new("displacement", "m", Sign::Axis, "displacement of the set since the spring was attached"),
        Column::new("force", unit, Sign::Axis, "force of the spring on the set"),
        Column::new("friction", "-", Sign::Size, "force over the sum of the normal forces on all interfaces"),
    ];
    when().into_iter().chain(own).collect()
}

/// Columns of the largest slip rates of interfaces.
pub(super) fn rate_columns<'a>(names: impl Iterator<Item = &'a str>) -> Vec<Column> {
    let rate = |name: &str| {
        Column::new("largest slip_rate", "m/s", Sign::Size, "largest slip rate of its points").for_part(name)
    };
    when().into_iter().chain(names.map(rate)).collect()
}

/// Values of a point in the order of its columns.
pub(super) fn point_values(point: &PointValues) -> Vec<f64> {
    point.displacement.iter().chain(&point.stress).copied().chain([point.mises]).collect()
}
