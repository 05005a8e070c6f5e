//! Points of bodies and forces on sets end to end, against closed forms.

use crate::common::{close, planned, simulate, varied};
use asperity::kinds;
use asperity_output::bodies::view::{PointValues, Samples};
use asperity_output::bodies::{FieldSchedule, Files, Multi, Recorder, Writer};
use asperity_vary::Change::With;

const YOUNG: f64 = 10e9;

fn scene(kinematics: &str, material: &str, body: &str, conditions: &str, output: &str) -> String {
    format!(
        r#"
schema = 1
title = "samples"
kinematics = "{kinematics}"
[materials.m]
young = "10 GPa"
poisson = 0.25
density = 2500
{material}
[bodies.B]
{body}
material = "m"
[[stages]]
name = "load"
duration = 1
steps = 2
conditions = [{conditions}]
[time]
stepper = "implicit"
[output]
{output}
"#
    )
}

fn last(record: &Recorder) -> &Samples {
    record.samples().last().unwrap()
}

fn at(record: &Recorder, name: &str) -> PointValues {
    let k = record.setup().points.iter().position(|p| p.name == name).unwrap();
    last(record).points[k].clone()
}

fn force(record: &Recorder, name: &str) -> [f64; 3] {
    let k = record.setup().forces.iter().position(|f| f.name == name).unwrap();
    last(record).forces[k]
}

/// Materials that stay elastic here, linear and nonlinear, with further lines of their bodies.
const MATERIALS: [(&str, &str); 3] = [
    ("", ""),
    ("plasticity = { yield = \"1 GPa\", hardening = \"perfect\" }", ""),
    ("", "formulation = \"b-bar\""),
];

const ALL_SIDES: &str = "forces.left = { set = \"B.left\" }\nforces.right = { set = \"B.right\" }\n\
    forces.bottom = { set = \"B.bottom\" }\nforces.top = { set = \"B.top\" }";

#[test]
fn a_stretched_block_has_the_exact_displacement_and_stress_at_any_place() {
    let conditions = r#"{ set = "B.left", symmetry = true }, { set = "B.bottom", symmetry = true },
        { set = "B.right", traction = [{ to = "5 MPa" }, 0] }"#;
    let output = "points.inside = { body = \"B\", at = [0.31, 0.83] }\npoints.corner = { body = \"B\", at = [2, 1] }\n\
        points.side = { body = \"B\", at = [\"1 m\", \"25 cm\"] }";
    let strain = 5e6 * (1.0 - 0.25 * 0.25) / YOUNG;
    for (material, more) in MATERIALS {
        for element in ["quad4", "quad8", "quad9", "tri3", "tri6"] {
            if element == "tri3" && !more.is_empty() {
                continue;
            }
            let mesh = format!(
                "mesh.quadrilateral = {{ corners = [[0, 0], [2, 0], [2, 1], [0, 1]], divisions = [3, 2], grading = [2, 0.5], \
                 element = \"{element}\" }}\n{more}"
            );
            let text = scene("plane-strain", material, &mesh, conditions, output);
            let (report, record) = simulate(&text);
            for (name, x) in [("inside", [0.31, 0.83]), ("corner", [2.0, 1.0]), ("side", [1.0, 0.25])] {
                let values = at(&record, name);
                close(values.displacement[0], strain * x[0], 1e-10);
                close(values.displacement[1], -0.25 / 0.75 * strain * x[1], 1e-10);
                close(values.stress[0], 5e6, 1e-9);
                close(values.stress[2], 0.25 * 5e6, 1e-9);
                let mises = 5e6 * (1.0 - 0.25 + 0.25_f64 * 0.25).sqrt();
                close(values.mises, mises, 1e-9);
            }
            assert_eq!(report.points.len(), 3);
            assert_eq!(report.points[2].values, at(&record, "side"));
            // Two steps: half the load at half the time.
            close(record.samples()[0].points[0].displacement[0], 0.5 * strain * 2.0, 1e-10);
        }
    }
}

#[test]
fn stresses_are_carried_linearly_to_the_boundary() {
    // Weight and pressure: stress is linear in y, and so is that of second-order elements.
    let conditions = r#"{ set = "B.left", symmetry = true }, { set = "B.right", symmetry = true },
        { set = "B.bottom", symmetry = true }, { set = "B.top", pressure = "1 MPa" }"#;
    let output =
        "points.foot = { body = \"B\", at = [0.7, 0] }\npoints.head = { body = \"B\", at = [0.7, 2] }";
    for (material, _) in &MATERIALS[..2] {
        for element in ["quad8", "quad9", "tri6"] {
            let mesh = format!(
                "mesh.block = {{ min = [0, 0], max = [1, 2], divisions = [2, 3], element = \"{element}\" }}\ngravity = [0, -9.81]"
            );
            let (_, record) = simulate(&scene("plane-strain", material, &mesh, conditions, output));
            close(at(&record, "head").stress[1], -1e6, 1e-9);
            close(at(&record, "foot").stress[1], -1e6 - 2500.0 * 9.81 * 2.0, 1e-9);
        }
    }
}

#[test]
fn forces_are_those_of_the_supports_and_of_the_loads_on_the_set() {
    // An inclined block with weight, initial stress and a pressure: all forces are known from the balance.
    let conditions = r#"{ set = "B.bottom", x = 0, y = 0 }, { set = "B.top", pressure = { to = "2 MPa" }, traction = ["1 MPa", 0] },
        { set = "B.right", pressure = "3 MPa" }"#;
    let weight = 2500.0 * 9.81 * 2.0;
    for (material, more) in MATERIALS {
        for element in ["quad4", "quad9"] {
            let mesh = format!(
                "mesh.block = {{ min = [0, 0], max = [2, 1], divisions = [3, 2], element = \"{element}\" }}\n{more}\n\
                 gravity = [0, -9.81]\ninitial_stress = [\"-1 MPa\", \"-2 MPa\", \"0.5 MPa\"]"
            );
            let text = scene("plane-strain", material, &mesh, conditions, ALL_SIDES);
            let (report, record) = simulate(&text);
            let [top, bottom] = ["top", "bottom"].map(|name| force(&record, name));
            close(top[0], 2e6, 1e-9);
            close(top[1], -4e6, 1e-9);
            // The right side pushes with 3 MPa over 1 m, its lower corner is held.
            close(bottom[0], -2e6 + 3e6, 1e-9);
            close(bottom[1], 4e6 + weight, 1e-9);
            assert!(report.forces.iter().all(|f| f.unit == "N/m" && f.stage == "load"));
        }
    }
}

#[test]
fn forces_balance_under_large_deformation_and_about_an_axis() {
    let bar = "mesh.block = { min = [0, 0], max = [1, 2], divisions = [2, 3], element = \"quad4\" }\n";
    let conditions =
        r#"{ set = "B.bottom", x = 0, y = 0 }, { set = "B.top", x = { to = 0.3 }, y = { to = 0.2 } }"#;
    let text = scene("plane-strain", "", &format!("{bar}strain = \"finite\""), conditions, ALL_SIDES);
    let (_, record) = simulate(&varied(&text, &[With("stages[0].steps", "20")]));
    let [top, bottom] = ["top", "bottom"].map(|name| force(&record, name));
    assert!(top[0] > 1e8 && top[1] > 1e8, "{top:?}");
    (0..2).for_each(|c| close(bottom[c], -top[c], 1e-9));
    let conditions = r#"{ set = "B.bottom", symmetry = true }, { set = "B.top", traction = [0, "2 MPa"] }"#;
    let (report, record) = simulate(&scene("axisymmetric", "", bar, conditions, ALL_SIDES));
    let end = std::f64::consts::PI * 2e6;
    close(force(&record, "top")[1], end, 1e-10);
    close(force(&record, "bottom")[1], -end, 1e-10);
    assert!(report.forces.iter().all(|f| f.unit == "N"));
}

/// Two blocks, one pressed on the other and sheared.
const CONTACT: &str = r#"
schema = 1
title = "samples of bodies in contact"
kinematics = "plane-strain"
[materials.rock]
young = "10 GPa"
poisson = 0.25
[bodies.A]
mesh.block = { min = [0, 0], max = [2, 1], divisions = [4, 2], element = "quad4" }
material = "rock"
[bodies.B]
mesh.block = { min = [0, 1], max = [2, 2], divisions = [5, 2], element = "quad4" }
material = "rock"
[interfaces.joint]
slave = "B.bottom"
master = "A.top"
measure = "node-to-point"
sliding = "small"
enforcement = { kind = "penalty", normal = "100 E/h", tangential = "100 E/h" }
law = { kind = "coulomb", mu = 0.3 }
[[stages]]
name = "press"
duration = "1 s"
steps = 2
conditions = [{ set = "A.bottom", x = 0, y = 0 }, { set = "B.top", x = { to = "1 mm" }, y = { to = "-1 mm" } }]
[time]
stepper = "implicit"
path = "condensed"
[output]
points.middle = { body = "B", at = [0.9, 1.4] }
forces.above = { set = "B.top" }
forces.joint = { set = "B.bottom" }
forces.below = { set = "A.bottom" }
"#;

#[test]
fn both_paths_give_the_same_points_and_the_force_of_the_contact() {
    let (report, condensed) = simulate(CONTACT);
    let (_, full) = simulate(&varied(CONTACT, &[With("time.path", "full")]));
    let (a, b) = (at(&condensed, "middle"), at(&full, "middle"));
    (0..2).for_each(|c| close(a.displacement[c], b.displacement[c], 1e-8));
    [0, 1, 3].iter().for_each(|&c| close(a.stress[c], b.stress[c], 1e-7));
    let slave = &report.balance[0].slave_force;
    for (c, contact) in slave.iter().enumerate() {
        let [above, joint, below] = ["above", "joint", "below"].map(|name| force(&condensed, name)[c]);
        close(joint, *contact, 1e-8);
        close(above, -joint, 1e-8);
        close(below, joint, 1e-8);
        close(above, force(&full, "above")[c], 1e-8);
    }
}

#[test]
fn histories_are_written_as_tables_and_into_the_report() {
    let folder = std::env::temp_dir().join(format!("asperity-samples-{}", std::process::id()));
    let plan = planned(CONTACT);
    let mut files = Files::create(&folder, FieldSchedule { fields: 0, profiles: 0 }).unwrap();
    let mut record = Recorder::new();
    let report =
        kinds::bodies::run(&plan, &mut Multi::new(vec![&mut files as &mut dyn Writer, &mut record])).unwrap();
    let rows = |file: &str| -> Vec<Vec<String>> {
        let text = std::fs::read_to_string(folder.join(file)).unwrap();
        text.lines().map(|l| l.split(',').map(str::to_string).collect()).collect()
    };
    let (point, force) = (rows("points/middle.csv"), rows("forces/above.csv"));
    assert_eq!(point[0][..4], ["time [s]", "stage", "step", "displacement_x [m]"]);
    assert_eq!(force[0][3..], ["force_x [N/m]", "force_y [N/m]", "force_z [N/m]"]);
    assert_eq!((point.len(), force.len()), (3, 3));
    for (k, samples) in record.samples().iter().enumerate() {
        assert_eq!(point[k + 1][3].parse::<f64>().unwrap(), samples.points[0].displacement[0]);
        assert_eq!(point[k + 1][12].parse::<f64>().unwrap(), samples.points[0].mises);
        assert_eq!(force[k + 1][4].parse::<f64>().unwrap(), samples.forces[0][1]);
    }
    let json = serde_json::to_value(&report).unwrap();
    assert_eq!(json["points"][0]["name"], "middle");
    assert_eq!(json["points"][0]["mises"], record.samples()[1].points[0].mises);
    assert_eq!(json["forces"][2]["set"], "B.bottom");
    std::fs::remove_dir_all(&folder).unwrap();
}
