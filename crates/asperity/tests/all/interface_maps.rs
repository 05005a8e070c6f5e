//! Interfaces in space as figures and fields show them, and means over what is closed.

use crate::common::{close, planned, simulate, varied};
use asperity::kinds;
use asperity_output::bodies::{FieldSchedule, Files, Recorder};
use asperity_output::figures;
use asperity_vary::Change::{With, Without};
use std::path::Path;

/// A block of 20 mm that stands with a half on a plate in space.
const OVERHANG: &str = r#"
schema = 1
title = "a block that overhangs"
kinematics = "3d"
[materials.steel]
young = "200 GPa"
poisson = 0.0
[bodies.plate]
material = "steel"
mesh.block = { min = [0, "-10 mm", 0], max = ["30 mm", 0, "10 mm"], divisions = [3, 1, 1], element = "hex8" }
[bodies.block]
material = "steel"
mesh.block = { min = ["20 mm", 0, 0], max = ["40 mm", "10 mm", "10 mm"], divisions = [4, 2, 2], element = "hex8" }
[interfaces.joint]
slave = "block.bottom"
master = "plate.top"
measure = "node-to-point"
sliding = "small"
enforcement = { kind = "penalty", normal = "100 E/h", tangential = "100 E/h" }
law = { kind = "coulomb", mu = 0.4 }
[[stages]]
name = "press"
duration = "1 s"
steps = 1
conditions = [
    { set = "plate.bottom", x = 0, y = 0, z = 0 },
    { set = "block.top", x = 0, z = 0, y = { to = "-1 um" } },
]
[time]
stepper = "implicit"
[output]
forces.top = { set = "block.top" }
"#;

#[test]
fn mean_tractions_are_those_of_the_area_that_is_closed() {
    let (report, record) = simulate(OVERHANG);
    let result = &report.results[0];
    // Six points of a column each are open beyond the edge, those at x = 35 and 40 mm, and three columns are closed.
    assert_eq!(result.status[0], 6);
    close(result.closed_area, 2.5 * 5e-3 * 10e-3, 1e-12);
    close(result.mean_normal_traction * result.closed_area, -report.forces[0].value[1], 1e-9);
    let end = &record.stage_ends()[0].interfaces[0];
    let shear: f64 = end.shear_traction.iter().zip(&end.area).map(|(t, a)| t * a).sum();
    close(result.mean_shear_traction * result.closed_area, shear, 1e-12);
}

fn written(scene: &str, out: &Path) -> (Recorder, Vec<String>) {
    let mut files = Files::create(out, FieldSchedule::default()).unwrap();
    kinds::bodies::run(&planned(scene), &mut files).unwrap();
    let mut record = Recorder::new();
    kinds::bodies::run(&planned(scene), &mut record).unwrap();
    let names = files.collection().iter().map(|entry| entry.file.clone()).collect();
    (record, names)
}

#[test]
fn interfaces_in_space_have_maps_and_both_sides() {
    let folder = tempfile::tempdir().unwrap();
    let (record, files) = written(OVERHANG, folder.path());
    let names = figures::sheet(&record).names(folder.path());
    assert!(names.contains(&"joint_map_1_press".to_string()), "{names:?}");
    assert!(!names.iter().any(|name| name.ends_with("_tractions")), "{names:?}");
    assert_eq!(files, ["fields/bodies_00001.vtu", "fields/joint_00001.vtu", "fields/master_joint_00001.vtu"]);
    let points = |file: &str| {
        let text = String::from_utf8_lossy(&std::fs::read(folder.path().join(file)).unwrap()).into_owned();
        let count = text.split("NumberOfPoints=\"").nth(1).unwrap();
        count[..count.find('"').unwrap()].parse::<usize>().unwrap()
    };
    assert_eq!([points(&files[1]), points(&files[2])], [5 * 3, 4 * 2]);
}

#[test]
fn interfaces_in_the_plane_have_lines_of_tractions() {
    let plane = [
        With("kinematics", "plane-strain"),
        With("bodies.plate.mesh.block.min", r#"[0, "-10 mm"]"#),
        With("bodies.plate.mesh.block.max", r#"["30 mm", 0]"#),
        With("bodies.plate.mesh.block.divisions", "[3, 1]"),
        With("bodies.plate.mesh.block.element", "quad4"),
        With("bodies.block.mesh.block.min", r#"["20 mm", 0]"#),
        With("bodies.block.mesh.block.max", r#"["40 mm", "10 mm"]"#),
        With("bodies.block.mesh.block.divisions", "[4, 2]"),
        With("bodies.block.mesh.block.element", "quad4"),
        Without("stages[0].conditions[0].z"),
        Without("stages[0].conditions[1].z"),
    ];
    let folder = tempfile::tempdir().unwrap();
    let (record, _) = written(&varied(OVERHANG, &plane), folder.path());
    let names = figures::sheet(&record).names(folder.path());
    assert!(names.contains(&"joint_tractions".to_string()), "{names:?}");
    assert!(!names.iter().any(|name| name.contains("_map_")), "{names:?}");
}
