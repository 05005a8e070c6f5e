//! Meshes from files of Gmsh and Abaqus: a bar under tension, its weight, and pressures on numbered faces.

use super::run_files::Folder;
use super::texts;
use crate::cases::body_plots;
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger};
use asperity_vary::SceneText;
use std::path::PathBuf;

/// See the README.
pub const CASE: Case = Case {
    name: "mesh_files",
    readme: include_str!("README.md"),
    covers: &[Capability::Interop, Capability::Solid3d, Capability::PlaneStrain],
    quick: true,
    run,
};

/// Meshes of the unit square and cube written by Gmsh, from the folder of this case.
const MESHES: &str = "../../../crates/fem/tests/meshes";
/// Files, each in the format of Gmsh 4.1, 2.2 (binary) and Abaqus where it has them, with the dimension.
const FILES: [(&str, usize, &[&str]); 12] = [
    ("unit_tri3", 2, &[".msh", "_v22_binary.msh"]),
    ("unit_tri6", 2, &[".msh", "_v22_binary.msh"]),
    ("unit_quad4", 2, &[".msh", "_v22_binary.msh"]),
    ("unit_quad8", 2, &[".msh", "_v22_binary.msh"]),
    ("unit_quad9", 2, &[".msh", "_v22_binary.msh"]),
    ("unit_tet4", 3, &[".msh", "_v22_binary.msh", ".inp"]),
    ("unit_tet10", 3, &[".msh", "_v22_binary.msh", ".inp"]),
    ("unit_wedge6", 3, &[".msh", "_v22_binary.msh", ".inp"]),
    ("unit_wedge15", 3, &[".msh", "_v22_binary.msh", ".inp"]),
    ("unit_hex8", 3, &[".msh", "_v22_binary.msh", ".inp"]),
    ("unit_hex20", 3, &[".msh", "_v22_binary.msh", ".inp"]),
    ("unit_hex27", 3, &[".msh", "_v22_binary.msh", ".inp"]),
];
/// Displacement of the drawn side \[m\]; Young's modulus is 1000 Pa, and Poisson's ratio 0.
const DRAWN: f64 = 0.01;
const STRESS: f64 = 10.0;
/// Weight of the unit cube \[N\].
const WEIGHT: f64 = 2.0 * 3.0;
/// Points at which displacement and stress are compared.
const POINTS: [[f64; 3]; 3] = [[0.3, 0.4, 0.6], [0.9, 0.15, 0.35], [0.55, 0.8, 0.2]];

/// Bound on ratios: rounding, divided by strains of 0.01, times the condition of the meshes.
const ROUNDING: f64 = 1e-11;
/// Pressure on a face of a single cell \[Pa\].
const PRESSURE: f64 = 7.0;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (name, dimension, endings) in FILES {
        let mut found = FormatResults::default();
        for ending in endings {
            let file = format!("{name}{ending}");
            bar(&mut found, &file, dimension).map_err(|error| format!("{file}: {error}"))?;
        }
        claims(ledger, &format!("{name}, {} formats", endings.len()), &found);
        if let Some(svg) = found.picture.filter(|_| name == "unit_tet10") {
            ledger.picture("Drawn bar of tet10", svg, "Mises stress, uniform.");
        }
    }
    faces(ledger)
}

/// Values over the exact ones, in all formats of a mesh.
#[derive(Default)]
struct FormatResults {
    /// Displacements and stresses at points of the drawn bar.
    drawn: Vec<f64>,
    /// Forces that hold the bar against its weight.
    weights: Vec<f64>,
    /// Mises stress of the drawn bar.
    picture: Option<String>,
    cost: Cost,
}

fn claims(ledger: &mut Ledger, name: &str, found: &FormatResults) {
    let whole = |values: &[f64]| vec![1.0; values.len()];
    ledger
        .claim(format!("{name}: displacement and stress of a drawn bar over the exact ones"))
        .norm("values at three points")
        .values(&found.drawn)
        .equals_each(&whole(&found.drawn))
        .absolute(ROUNDING)
        .evidence(Evidence::Exact, "uniform strain")
        .because("a uniform strain lies in the space of every element whose nodes are where its order says: rounding")
        .why_not_tighter("rounding of a few dozen unknowns, larger for crooked cells")
        .cost(&found.cost)
        .record();
    ledger
        .claim(format!("{name}: force that holds the bar against its weight, over its weight"))
        .values(&found.weights)
        .equals_each(&whole(&found.weights))
        .absolute(ROUNDING)
        .evidence(Evidence::Exact, "density, gravity and the volume of the unit square or cube")
        .because("the cells fill the volume: rounding")
        .why_not_tighter("rounding of sums over the cells")
        .record();
}

/// A bar from a file, drawn along x; and hanging from its low side by its weight.
fn bar(found: &mut FormatResults, file: &str, dimension: usize) -> Result<(), CaseError> {
    let format = if file.ends_with(".inp") { ("abaqus", "elsets") } else { ("gmsh", "groups") };
    let still = if dimension == 3 { ", z = 0" } else { "" };
    let low = format!("{{ set = \"bar.low\", x = 0, y = 0{still} }}");
    let high = format!("{{ set = \"bar.high\", x = {{ to = {DRAWN:?} }}, y = 0{still} }}");
    let base = body(file, format, dimension);
    let point =
        |(k, at): (usize, &[f64; 3])| format!("p{k} = {{ body = \"bar\", at = {:?} }}", &at[..dimension]);
    let points: Vec<String> = POINTS.iter().enumerate().map(point).collect();
    let drawn = base
        .clone()
        .add("stages[0].conditions", format!("[{low}, {high}]"))
        .add("output.points", format!("{{ {} }}", points.join(", ")));
    let done = texts::simulate_in(&drawn.text()?, &folder())?;
    found.picture = Some(body_plots::recorded(&done.record, "")?);
    let values = &done.record.samples().last().ok_or("no step was taken")?.points;
    for (at, point) in POINTS.iter().zip(values) {
        found.drawn.extend([point.displacement[0] / (DRAWN * at[0]), point.stress[0] / STRESS]);
    }
    let gravity = if dimension == 3 { "[-3, 0, 0]" } else { "[-3, 0]" };
    let hung = base.add("stages[0].conditions", format!("[{low}]")).add("bodies.bar.gravity", gravity);
    let hung = texts::simulate_in(&hung.text()?, &folder())?;
    let force = hung.force("low")?.last().copied().ok_or("no step was taken")?;
    found.weights.push(force[0] / WEIGHT);
    found.cost = done.cost;
    Ok(())
}

fn body(file: &str, (format, of): (&str, &str), dimension: usize) -> SceneText {
    let kinematics = if dimension == 3 { "3d" } else { "plane-strain" };
    SceneText::new(&format!(
        r#"
schema = 1
title = "a bar from a file"
kinematics = "{kinematics}"
[materials.rock]
young = 1000
poisson = 0
density = 2
[bodies.bar]
mesh.{format} = {{ file = "{file}", unit = "m", {of} = ["body"] }}
material = "rock"
[[stages]]
name = "load"
duration = 1
steps = 1
[time]
stepper = "implicit"
[output]
forces.low = {{ set = "bar.low" }}
"#
    ))
}

fn folder() -> String {
    PathBuf::from("mesh_files").join(MESHES).to_string_lossy().into_owned()
}

/// A single cell in the numbering of Abaqus: its type, nodes, and for each face its outward normal times its area.
struct Cell {
    kind: &'static str,
    nodes: &'static [[f64; 3]],
    faces: &'static [[f64; 3]],
}

/// Faces S1, S2, .. as the manual numbers them: by their nodes, from which the normals follow.
const CELLS: [Cell; 3] = [
    Cell {
        kind: "C3D8",
        nodes: &[
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 0.0, 1.0],
            [1.0, 0.0, 1.0],
            [1.0, 1.0, 1.0],
            [0.0, 1.0, 1.0],
        ],
        // 1-2-3-4, 5-8-7-6, 1-5-6-2, 2-6-7-3, 3-7-8-4, 4-8-5-1.
        faces: &[
            [0.0, 0.0, -1.0],
            [0.0, 0.0, 1.0],
            [0.0, -1.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [-1.0, 0.0, 0.0],
        ],
    },
    Cell {
        kind: "C3D4",
        nodes: &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        // 1-2-3, 1-4-2, 2-4-3, 3-4-1.
        faces: &[[0.0, 0.0, -0.5], [0.0, -0.5, 0.0], [0.5, 0.5, 0.5], [-0.5, 0.0, 0.0]],
    },
    Cell {
        kind: "C3D6",
        nodes: &[
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 0.0, 1.0],
            [1.0, 0.0, 1.0],
            [0.0, 1.0, 1.0],
        ],
        // 1-2-3, 4-6-5, 1-4-5-2, 2-5-6-3, 3-6-4-1.
        faces: &[[0.0, 0.0, -0.5], [0.0, 0.0, 0.5], [0.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 0.0, 0.0]],
    },
];

impl Cell {
    /// The cell as a file, with a surface for each face and one, `other`, that is held.
    fn file(&self, held: usize) -> String {
        let mut text = "*NODE\n".to_owned();
        for (k, [x, y, z]) in self.nodes.iter().enumerate() {
            text += &format!("{}, {x:?}, {y:?}, {z:?}\n", k + 1);
        }
        let nodes: Vec<String> = (1..=self.nodes.len()).map(|k| k.to_string()).collect();
        text += &format!("*ELEMENT, TYPE={}, ELSET=body\n1, {}\n", self.kind, nodes.join(", "));
        for k in 1..=self.faces.len() {
            text += &format!("*SURFACE, NAME=face{k}, TYPE=ELEMENT\n1, S{k}\n");
        }
        text + &format!("*SURFACE, NAME=low, TYPE=ELEMENT\n1, S{}\n", held + 1)
    }
}

/// Pressure on each face in turn, held by another one: the force on that one is opposite to the pressure.
fn faces(ledger: &mut Ledger) -> Result<(), CaseError> {
    let folder = Folder::new()?;
    for cell in &CELLS {
        let (mut found, mut expected, mut cost) = (Vec::new(), Vec::new(), Cost::default());
        for (k, normal) in cell.faces.iter().enumerate() {
            let held = if k == 0 { 1 } else { 0 };
            std::fs::write(folder.path().join("cell.inp"), cell.file(held))?;
            let scene = body("cell.inp", ("abaqus", "elsets"), 3).add(
                "stages[0].conditions",
                format!(
                    "[{{ set = \"bar.low\", x = 0, y = 0, z = 0 }}, {{ set = \"bar.face{}\", pressure = {PRESSURE:?} }}]",
                    k + 1
                ),
            );
            let done = texts::simulate_in(&scene.text()?, &folder.path().to_string_lossy())?;
            let force = done.force("low")?.last().copied().ok_or("no step was taken")?;
            found.extend(force.map(|f| f / PRESSURE));
            expected.extend(normal);
            cost = done.cost;
        }
        ledger
            .claim(format!(
                "{}: forces that hold a cell against pressure on each of its faces, over the pressure",
                cell.kind
            ))
            .norm("all components, faces numbered as by Abaqus")
            .values(&found)
            .equals_each(&expected)
            .absolute(1e-13)
            .evidence(Evidence::Exact, "outward normals of the faces times their areas")
            .because("sums of a dozen forces of order one: rounding")
            .why_not_tighter("rounding")
            .cost(&cost)
            .record();
    }
    Ok(())
}
