//! Stress at nodes between cells of different kinds, which are blocks of their own.

use super::vtu::Fields;
use super::{Capability, CaseError, Evidence, Folder, Ledger};
use crate::cases::run_files;

/// A quadrangle from x = 0 to 1 m and two triangles from there to x = 2 m, in the format 2.2 of Gmsh.
const MESH: &str = r#"$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
5
1 1 "low"
1 2 "middle"
1 3 "high"
1 4 "rim"
2 5 "bar"
$EndPhysicalNames
$Nodes
6
1 0 0 0
2 1 0 0
3 2 0 0
4 0 1 0
5 1 1 0
6 2 1 0
$EndNodes
$Elements
10
1 1 2 1 1 1 4
2 1 2 2 2 2 5
3 1 2 3 3 3 6
4 1 2 4 4 1 2
5 1 2 4 4 2 3
6 1 2 4 4 4 5
7 1 2 4 4 5 6
8 3 2 5 5 1 2 5 4
9 2 2 5 5 2 3 6
10 2 2 5 5 2 6 5
$EndElements
"#;

/// Stretch of the quadrangle; that of the triangles is twice as large. Young's modulus \[Pa\], with a Poisson's ratio of 0.
const STRETCH: f64 = 1e-3;
const YOUNG: f64 = 1e9;

fn scene() -> String {
    format!(
        "schema = 1\ntitle = \"two kinds of cells\"\nkinematics = \"plane-strain\"\n[materials.rock]\nyoung = {YOUNG:?}\npoisson = 0\n\
         [bodies.bar]\nmaterial = \"rock\"\nmesh.gmsh = {{ file = \"bar.msh\", groups = [\"bar\"] }}\n\
         [[stages]]\nname = \"draw\"\nduration = 1\nsteps = 1\nconditions = [{{ set = \"bar.low\", x = 0, y = 0 }}, \
         {{ set = \"bar.middle\", x = {{ to = {STRETCH:?} }}, y = 0 }}, {{ set = \"bar.high\", x = {{ to = {:?} }}, y = 0 }}]\n\
         [time]\nstepper = \"implicit\"\n",
        3.0 * STRETCH
    )
}

/// See the module.
pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    let beside = Folder::new()?;
    std::fs::write(beside.path().join("bar.msh"), MESH)?;
    let (files, cost) = run_files::bodies_beside(&scene(), beside.path())?;
    let name = files.names("fields")?.into_iter().rfind(|n| n.starts_with("bodies")).ok_or("no fields")?;
    let fields = Fields::read(&files.text(&format!("fields/{name}"))?)?;
    let places: Vec<f64> = fields.array("Points")?.values.chunks_exact(3).map(|p| p[0]).collect();
    let exact: Vec<f64> = places.iter().map(|x| YOUNG * STRETCH * (1.0 + 0.5 * x)).collect();
    // Of two arrays of this name that at the nodes comes first.
    ledger
        .claim("Mises stress at the nodes of a quadrangle and two triangles that are drawn by unlike amounts, in field files")
        .unit("Pa")
        .values(&fields.array("mises")?.values)
        .equals_each(&exact)
        .absolute(1e-3)
        .evidence(Evidence::Exact, "uniaxial stress E times the stretch, and the mean of both kinds of cells between them")
        .because("rounding of 2 MPa, and of displacements of millimetres")
        .why_not_tighter("the stress of triangles is a difference of displacements")
        .covers(&[Capability::Outputs, Capability::Triangles, Capability::Quadrilaterals])
        .cost(&cost)
        .record();
    Ok(())
}
