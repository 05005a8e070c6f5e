//! CSV tables: profiles along an interface at one time, and histories at its probes.

use super::view::{InterfaceFields, InterfaceMesh, PointValues};
use crate::tables::column::{self, Column, Sign};
use crate::tables::csv_rows::Rows;
use crate::tables::history::{history_row, number, when};

/// A column of an interface table, and the function that reads its values.
struct Field {
    column: fn() -> Column,
    read: fn(&InterfaceFields, usize) -> f64,
}

/// Columns of a profile.
const PROFILE: [Field; 11] = [
    Field {
        column: || Column::new("gap", "m", Sign::Apart, "normal gap, negative for penetration"),
        read: InterfaceFields::written_gap,
    },
    Field {
        column: || Column::new("normal_traction", "Pa", Sign::Compression, "normal traction"),
        read: |f, i| f.normal_traction[i],
    },
    SHEAR_TRACTION,
    RELATIVE_DISPLACEMENT,
    SLIP,
    SLIP_RATE,
    FRICTION,
    Field {
        column: || {
            Column::new(
                "mean_normal_traction",
                "Pa",
                Sign::Compression,
                "normal traction averaged around the node",
            )
        },
        read: |f, i| f.mean_normal_traction[i],
    },
    Field {
        column: || {
            Column::new("mean_shear_traction", "Pa", Sign::Slip, "shear traction averaged around the node")
        },
        read: |f, i| f.mean_shear_traction[i],
    },
    Field {
        column: || Column::new("status", "0 open 1 stick 2 slip", Sign::None, "state of contact"),
        read: |f, i| f64::from(f.status[i]),
    },
    Field {
        column: || Column::new("paired", "0 no 1 yes", Sign::None, "0 where the node has no partner"),
        read: |f, i| f64::from(u8::from(f.paired(i))),
    },
];

/// Columns of each probe.
const PROBE: [Field; 6] = [
    RELATIVE_DISPLACEMENT,
    SLIP,
    SLIP_RATE,
    FRICTION,
    Field {
        column: || Column::new("normal_traction", "Pa", Sign::Compression, "normal traction"),
        read: |f, i| f.normal_traction[i],
    },
    SHEAR_TRACTION,
];

const SHEAR_TRACTION: Field = Field {
    column: || Column::new("shear_traction", "Pa", Sign::Slip, "shear traction"),
    read: |f, i| f.shear_traction[i],
};
const RELATIVE_DISPLACEMENT: Field = Field {
    column: || Column::new("relative_displacement", "m", Sign::Slip, "motion of the slave past the master"),
    read: |f, i| f.relative_displacement[i],
};
const SLIP: Field = Field {
    column: || Column::new("slip", "m", Sign::Slip, "plastic part of the relative displacement"),
    read: |f, i| f.slip[i],
};
const SLIP_RATE: Field = Field {
    column: || Column::new("slip_rate", "m/s", Sign::Slip, "rate of slip"),
    read: |f, i| f.slip_rate[i],
};
const FRICTION: Field = Field {
    column: || Column::new("friction", "-", Sign::Size, "shear over normal traction"),
    read: |f, i| f.friction[i],
};

/// Columns of a table of an interface, with vectors in space, and states of its law.
fn columns(fields: &[Field], mesh: &InterfaceMesh) -> Vec<Column> {
    let mut columns: Vec<Column> = fields.iter().map(|field| (field.column)()).collect();
    if mesh.in_space {
        columns.extend(column::axes("slip", "m", Sign::Vector, "slip of the slave past the master"));
        columns.extend(column::axes(
            "shear_traction",
            "Pa",
            Sign::Vector,
            "shear traction of the slave side",
        ));
    }
    let state = |k| Column::new(format!("state_{k}"), "", Sign::None, "state variable of the law");
    columns.extend((1..=mesh.states).map(state));
    columns
}

/// Values of these columns at a node.
fn values(fields: &[Field], mesh: &InterfaceMesh, now: &InterfaceFields, node: usize) -> Vec<f64> {
    let mut values: Vec<f64> = fields.iter().map(|field| (field.read)(now, node)).collect();
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
    let area = Column::new("area", "m2", Sign::Size, "tributary area");
    let place = [column::time(), node].into_iter().chain(column::position()).chain([area]);
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
