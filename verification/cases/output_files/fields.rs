//! Nodes and stresses of bodies in field files, in VTK's order.

use super::vtu::Fields;
use crate::cases::run_files::{self, Folder};
use crate::{Capability, CaseError, Cost, Evidence, Ledger};
use nalgebra::Vector3;
use serde_json::Value;

/// Elements with their number of space dimensions.
const ELEMENTS: [(&str, usize); 12] = [
    ("tri3", 2),
    ("quad4", 2),
    ("tri6", 2),
    ("quad8", 2),
    ("quad9", 2),
    ("tet4", 3),
    ("hex8", 3),
    ("wedge6", 3),
    ("tet10", 3),
    ("hex20", 3),
    ("hex27", 3),
    ("wedge15", 3),
];
/// Sizes of the block \[m\].
const SIZES: [f64; 3] = [2.0, 3.0, 5.0];
/// Stress of the block, by VTK's component names \[MPa\].
const STRESS: [(&str, f64); 6] =
    [("XX", -11.0), ("YY", -17.0), ("ZZ", -23.0), ("XY", 3.0), ("YZ", 5.0), ("XZ", 7.0)];
/// Order and parametric coordinates of nodes, as VTK reports them.
const VTK: &str = include_str!("../../independent/vtk_cells.json");
/// Source of [`VTK`].
const SOURCE: &str =
    "vtk_cells.py: parametric coordinates of nodes and principal values of tensors, of VTK 9.7.2";

/// A block held on all sides under a uniform initial stress.
fn scene(element: &str, space: usize) -> String {
    let list = |values: &[f64]| values.iter().map(|v| format!("{v:?}")).collect::<Vec<_>>().join(", ");
    let stress: Vec<String> = if space == 2 {
        [0, 1, 3].iter().map(|&k| format!("\"{:?} MPa\"", STRESS[k].1)).collect()
    } else {
        STRESS.iter().map(|(_, value)| format!("\"{value:?} MPa\"")).collect()
    };
    let (kinematics, sides, held) = if space == 2 {
        ("plane-strain", &["left", "right", "bottom", "top"][..], "x = 0, y = 0")
    } else {
        ("3d", &["left", "right", "bottom", "top", "back", "front"][..], "x = 0, y = 0, z = 0")
    };
    let conditions: String =
        sides.iter().map(|side| format!("{{ set = \"block.{side}\", {held} }}, ")).collect();
    format!(
        "schema = 1\ntitle = \"a block under stress\"\nkinematics = \"{kinematics}\"\n\
         [materials.rock]\nyoung = \"50 GPa\"\npoisson = 0.25\n\
         [bodies.block]\nmaterial = \"rock\"\ninitial_stress = [{}]\n\
         mesh.block = {{ min = [{}], max = [{}], divisions = {:?}, element = \"{element}\" }}\n\
         [[stages]]\nname = \"still\"\nduration = \"1 s\"\nsteps = 1\nconditions = [{conditions}]\n\
         [time]\nstepper = \"implicit\"\n\
         [output]\npoints.middle = {{ body = \"block\", at = [{}] }}\n",
        stress.join(", "),
        list(&[0.0; 3][..space]),
        list(&SIZES[..space]),
        vec![2; space],
        list(&SIZES.map(|s| 0.3 * s)[..space]),
    )
}

/// Largest distance of a node from the position that its parametric coordinates give between the corners \[m\].
fn strays(fields: &Fields, vtk: &Value) -> Result<f64, CaseError> {
    let points: Vec<Vector3<f64>> =
        fields.array("Points")?.values.chunks_exact(3).map(Vector3::from_column_slice).collect();
    let (nodes, ends) = (fields.indices("connectivity")?, fields.indices("offsets")?);
    let (mut from, mut worst) = (0, 0.0_f64);
    for (kind, end) in fields.indices("types")?.iter().zip(ends) {
        let cell: Vec<Vector3<f64>> = nodes[from..end].iter().map(|n| points[*n]).collect();
        from = end;
        let places: Vec<[f64; 3]> = serde_json::from_value(vtk["nodes"][kind.to_string()].clone())?;
        if places.len() != cell.len() {
            return Err(format!("a cell of type {kind} has {} nodes in VTK", places.len()).into());
        }
        let corner = |k: usize| {
            let unit: [f64; 3] = std::array::from_fn(|c| f64::from(u8::from(c == k)));
            places.iter().position(|p| *p == unit).map_or(Vector3::zeros(), |n| cell[n] - cell[0])
        };
        let axes = [0, 1, 2].map(corner);
        for (place, found) in places.iter().zip(&cell) {
            let expected = cell[0] + axes[0] * place[0] + axes[1] * place[1] + axes[2] * place[2];
            worst = worst.max((expected - found).norm());
        }
    }
    Ok(worst)
}

/// Largest error of a stress component in the cells \[Pa\], taking components by VTK's order and by their names in the file.
fn stresses(fields: &Fields, vtk: &Value, space: usize) -> Result<f64, CaseError> {
    let order: Vec<String> = serde_json::from_value(vtk["symmetric_tensor"].clone())?;
    let array = fields.array("stress")?;
    if array.components.len() != order.len() {
        return Err("the components of stress have no names".into());
    }
    let of = |name: &String| STRESS.iter().find(|s| s.0 == name).map_or(f64::NAN, |s| 1e6 * s.1);
    let mut worst = 0.0_f64;
    for tuple in array.values.chunks_exact(order.len()) {
        for ((value, by_place), by_name) in tuple.iter().zip(&order).zip(&array.components) {
            // The plane scene sets only three components; the others have no reference here.
            if space == 3 || matches!(by_place.as_str(), "XX" | "YY" | "XY") {
                worst = worst.max((value - of(by_place)).abs()).max((value - of(by_name)).abs());
            }
        }
    }
    Ok(worst)
}

/// Largest error of the stress of a point in its table \[Pa\].
fn point(files: &Folder, space: usize) -> Result<f64, CaseError> {
    let table = files.table("points/middle.csv")?;
    let names = ["stress_xx", "stress_yy", "stress_zz", "stress_xy", "stress_yz", "stress_zx"];
    let mut worst = 0.0_f64;
    for (name, (_, expected)) in names.iter().zip(STRESS) {
        if space == 3 || matches!(*name, "stress_xx" | "stress_yy" | "stress_xy") {
            worst = worst.max((table.only(name)? - 1e6 * expected).abs());
        }
    }
    Ok(worst)
}

/// Claims about the field files of all elements.
pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    let vtk: Value = serde_json::from_str(VTK)?;
    let mut worst = [0.0_f64; 3];
    let (done, cost) = Cost::measure(|| -> Result<(), CaseError> {
        for (element, space) in ELEMENTS {
            let (files, _) = run_files::bodies(&scene(element, space))?;
            let last = files.names("fields")?.pop().ok_or("no field file")?;
            let fields = Fields::read(&files.text(&format!("fields/{last}"))?)?;
            let found = [strays(&fields, &vtk)?, stresses(&fields, &vtk, space)?, point(&files, space)?];
            worst = std::array::from_fn(|k| worst[k].max(found[k]));
        }
        Ok(())
    });
    done?;
    for (what, unit, value, bound, kind, source, because) in [
        (
            "nodes of cells in field files, twelve elements: largest distance from where VTK's coordinates put them between corners",
            "m",
            worst[0],
            1e-14,
            Evidence::OtherCode,
            SOURCE,
            "rounding of 5 m in sums of four places",
        ),
        (
            "stress in field files, twelve elements: largest error of a component by VTK's order and by the name in the file",
            "Pa",
            worst[1],
            1e-6,
            Evidence::OtherCode,
            SOURCE,
            "rounding of 23 MPa in a solution that does not move",
        ),
        (
            "stress in tables of points, twelve elements: largest error of a component",
            "Pa",
            worst[2],
            1e-6,
            Evidence::Exact,
            "a uniform initial stress is in balance",
            "rounding of 23 MPa in a solution that does not move",
        ),
    ] {
        ledger
            .claim(what)
            .unit(unit)
            .value(value)
            .at_most(bound)
            .evidence(kind, source)
            .because(because)
            .why_not_tighter("rounding depends on the element; nodes or components that are exchanged differ by parts of a cell and by MPa")
            .covers(&[
                Capability::Outputs,
                Capability::Triangles,
                Capability::Quadrilaterals,
                Capability::Serendipity,
                Capability::Solids,
                Capability::QuadraticSolids,
                Capability::Wedges,
            ])
            .cost(&cost)
            .record();
    }
    Ok(())
}
