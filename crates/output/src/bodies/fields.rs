//! Fields of bodies and interfaces.

use super::quantity;
use super::view::{BodyFields, InterfaceFields, InterfaceMesh, MeshView};
use crate::error::{OutputError, expect_length};
use crate::fields::vtu::{Cell, Grid};
use crate::fields::{Data, FILES, Field, FieldTimes, Series};
use crate::tables::Sign;

/// Fields of the bodies, of which some may be plastic.
pub(super) fn body_series(mesh: &MeshView, plastic: bool) -> Series<'static, BodyFields> {
    let grid = Grid::new(&mesh.nodes, &mesh.cells);
    let body: Vec<i64> = mesh.cell_body.iter().map(|&body| body as i64).collect();
    let mises = || Field::scalar("mises", "Pa", Sign::Size, "equivalent stress of von Mises");
    let series = Series::new(FILES.named("bodies_*"), FieldTimes::Intervals, || grid)
        .with(displacement(), |f: &BodyFields| Data::from(&f.displacement))
        .with(mises(), |f| Data::from(&f.node_mises))
        .with(Field::tensor("stress", "Pa", Sign::Tension, "stress").in_cells(), |f| {
            Data::from(&f.cell_stress)
        })
        .with(mises().in_cells(), |f| Data::from(&f.cell_mises))
        .with(Field::scalar("body", "", Sign::None, "number of the body, from 0").in_cells(), move |_| {
            Data::from(body.clone())
        });
    if !plastic {
        return series;
    }
    let strain = Field::scalar("plastic_strain", "-", Sign::Size, "equivalent plastic strain");
    series.with(strain.in_cells(), |f| Data::from(&f.cell_plastic_strain))
}

/// The slave side of an interface in a state.
pub(super) struct SlaveSide {
    pub fields: InterfaceFields,
    /// Displacement of its nodes \[m\].
    pub displacement: Vec<[f64; 3]>,
}

/// Fields of the slave side of an interface of this stem, between bodies of this dimension.
pub(super) fn interface_series(
    stem: &str,
    mesh: &InterfaceMesh,
    dimension: usize,
) -> Series<'static, SlaveSide> {
    let grid = grid(&mesh.positions, &mesh.faces, dimension);
    let mut series = Series::new(FILES.named(&format!("{stem}_*")), FieldTimes::Intervals, || grid)
        .with(displacement(), |side: &SlaveSide| Data::from(&side.displacement));
    for quantity in [
        &quantity::GAP,
        &quantity::PAIRED,
        &quantity::SLIP,
        &quantity::RELATIVE_DISPLACEMENT,
        &quantity::SLIP_RATE,
        &quantity::NORMAL_TRACTION,
        &quantity::SHEAR_TRACTION,
        &quantity::MEAN_NORMAL_TRACTION,
        &quantity::MEAN_SHEAR_TRACTION,
        &quantity::FRICTION,
        &quantity::FRICTION_WORK,
        &quantity::STATUS,
        &quantity::AREA,
    ] {
        series = series.with(quantity.field(), |side| quantity.data(&side.fields));
    }
    if mesh.in_space {
        series = series
            .with(
                Field::vector("slip_vector", "m", Sign::Vector, "slip of the slave past the master"),
                |side| Data::from(&side.fields.slip_vector),
            )
            .with(
                Field::vector(
                    "shear_traction_vector",
                    "Pa",
                    Sign::Vector,
                    "shear traction of the slave side",
                ),
                |side| Data::from(&side.fields.shear_vector),
            );
    }
    for k in 0..mesh.states {
        let field = Field::scalar(format!("state_{}", k + 1), "", Sign::None, quantity::STATE);
        series = series.with(field, move |side| {
            let f = &side.fields;
            Data::from(f.nodes().map(|i| f.state(k, i)).collect::<Vec<_>>())
        });
    }
    series
}

/// Displacement of the master side of an interface, as files beside those of the slave side.
pub(super) fn master_series(
    stem: &str,
    mesh: &InterfaceMesh,
    (dimension, nodes): (usize, &[[f64; 3]]),
) -> Series<'static, Vec<[f64; 3]>> {
    let places: Vec<[f64; 3]> = mesh.master_nodes.iter().filter_map(|&n| nodes.get(n).copied()).collect();
    let grid = grid(&places, &mesh.master_faces, dimension);
    Series::new(FILES.named(&format!("{stem}_*")), FieldTimes::Intervals, || grid)
        .with(displacement(), |moved: &Vec<[f64; 3]>| Data::from(moved))
}

fn displacement() -> Field {
    Field::vector("displacement", "m", Sign::Axis, "displacement")
}

/// Faces of a surface as VTK cells; vertices if it has none.
fn grid(places: &[[f64; 3]], faces: &[Vec<usize>], dimension: usize) -> Grid {
    // VTK cell types: 1 vertex, 3 line, 21 line with its middle; triangles 5 and 22 with middles, quadrilaterals 9, 23 and 28.
    let kind = |nodes: usize| match (dimension, nodes) {
        (_, 1) => 1,
        (_, 2) => 3,
        (2, _) => 21,
        (_, 3) => 5,
        (_, 4) => 9,
        (_, 6) => 22,
        (_, 8) => 23,
        _ => 28,
    };
    let cells: Vec<Cell> = if faces.is_empty() {
        (0..places.len()).map(|node| Cell::new(1, vec![node])).collect()
    } else {
        faces.iter().map(|face| Cell::new(kind(face.len()), face.clone())).collect()
    };
    Grid::new(places, &cells)
}

/// Checks that fields have a value for each node or cell.
pub(super) fn check(mesh: &MeshView, fields: &BodyFields) -> Result<(), OutputError> {
    let (nodes, cells) = (mesh.nodes.len(), mesh.cells.len());
    expect_length("body of each cell", cells, mesh.cell_body.len())?;
    expect_length("displacement of the nodes", nodes, fields.displacement.len())?;
    expect_length("Mises stress of the nodes", nodes, fields.node_mises.len())?;
    expect_length("stress of the cells", cells, fields.cell_stress.len())?;
    expect_length("Mises stress of the cells", cells, fields.cell_mises.len())?;
    match fields.cell_plastic_strain.len() {
        0 => Ok(()),
        found => expect_length("plastic strain of the cells", cells, found),
    }
}
