//! Comparison of the page "Signs in files" with the files of runs: a block is pushed each way, with an interface and
//! with a fault.
//!
//! Block A lies at x < 0 and block B at x > 0, pressed together along x. B is moved along the plane between them, or A the other way.

use crate::common::every_kind::{fault, interface};
use crate::common::written::{Column, arrays, described, files, fits, table};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The page, as it stands: another test may just have written it.
fn page() -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/src/signs.md")).unwrap()
}

/// Tractions and displacements below this share of the largest value of a column are rounding.
const ROUNDING: f64 = 1e-9;

/// A row of the page.
struct Rule {
    files: Vec<String>,
    columns: Vec<String>,
    sign: String,
}

/// Code in a cell, or the cell.
fn listed(cell: &str) -> Vec<String> {
    match cell.split('`').skip(1).step_by(2).map(str::to_owned).collect::<Vec<_>>() {
        none if none.is_empty() => vec![cell.trim().to_owned()],
        some => some,
    }
}

/// The rows of a section.
fn rules(section: &str) -> Vec<Rule> {
    let page = page();
    let rest = page.split_once(&format!("## {section}\n")).unwrap().1;
    let rows = rest.split("\n## ").next().unwrap().lines().filter(|line| line.starts_with("| `"));
    rows.map(|row| {
        let cells: Vec<&str> = row.trim_matches('|').split('|').collect();
        Rule { files: listed(cells[0]), columns: listed(cells[1]), sign: cells[2].trim().to_owned() }
    })
    .collect()
}

/// Motion of B relative to A, the resulting slip, and the directions of the page.
#[derive(Clone, Copy)]
struct Motion {
    push: [f64; 3],
    /// Slip of the slave (plus) side relative to the other.
    slip: [f64; 3],
    /// Direction of positive slip; none where slip is a magnitude.
    positive: Option<[f64; 3]>,
    /// Directions 2 and 3 of stations.
    components: [[f64; 3]; 2],
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Mean over the rows or points of a column, component by component.
fn mean(column: &Column) -> Vec<f64> {
    let n = column.components;
    let part = |c: usize| {
        let values = column.values.iter().skip(c).step_by(n).filter(|v| v.is_finite());
        let (sum, count) = values.fold((0.0, 0.0), |(s, k), v| (s + v, k + 1.0));
        if count > 0.0 { sum / count } else { 0.0 }
    };
    (0..n).map(part).collect()
}

/// Agreement of a column with its sign on the page: positive if it agrees, negative if it is opposite, zero if it shows
/// neither.
fn said(sign: &str, column: &Column, motion: &Motion) -> f64 {
    let (name, mean) = (column.name.as_str(), mean(column));
    let least = column.values.iter().copied().filter(|v| v.is_finite()).fold(f64::INFINITY, f64::min);
    let size = if least < 0.0 { least } else { mean[0] };
    let axis = ["_x", "_y", "_z"].iter().position(|end| name.ends_with(end));
    match (sign, column.components) {
        ("slip", 1) => motion.positive.map_or(size, |direction| mean[0] * dot(motion.slip, direction)),
        ("along", 1) => mean[0] * dot(motion.slip, motion.positive.unwrap_or(motion.components[0])),
        ("component", 1) => mean[0] * dot(motion.slip, motion.components[usize::from(name.ends_with('3'))]),
        ("vector", 3) => dot([mean[0], mean[1], mean[2]], motion.slip),
        ("vector", 1) => mean[0] * motion.slip[axis.unwrap()],
        ("axis", 3) => dot([mean[0], mean[1], mean[2]], motion.push),
        // B is pressed against A.
        ("axis", 1) if axis == Some(0) => -mean[0],
        ("axis", 1) => mean[0] * motion.push[axis.unwrap()],
        ("tension", 6) => -mean[0],
        ("tension", 1) if name == "stress_xx" => -mean[0],
        // B is moved by its right side, whose outward normal is x.
        ("tension", 1) if name == "stress_xy" => mean[0] * motion.push[1],
        ("tension", 1) if name == "stress_zx" => mean[0] * motion.push[2],
        // Penalties let the sides penetrate.
        ("apart", 1) => -mean[0],
        ("size" | "compression" | "fall", 1) => size,
        ("tension" | "log" | "none", 1) => 0.0,
        _ => panic!("{sign} of `{name}` is no word of the page"),
    }
}

/// Displacements as the jump from A to B: sums over cells, since both have nodes in the middle.
fn jump(columns: &[Column]) -> Option<Column> {
    let of = |name: &str| columns.iter().find(|c| c.name == name).map(|c| c.values.as_slice());
    let (points, moved, nodes) = (of("Points")?, of("displacement")?, of("connectivity")?);
    let ends =
        points.chunks(3).fold([f64::INFINITY, f64::NEG_INFINITY], |e, x| [e[0].min(x[0]), e[1].max(x[0])]);
    let (mut jump, mut from) = (vec![0.0; 3], 0);
    for end in of("offsets")?.iter().map(|end| *end as usize) {
        let cell = || nodes[from..end].iter().map(|node| 3 * *node as usize);
        let side = cell().map(|k| points[k] - 0.5 * (ends[0] + ends[1])).sum::<f64>().signum();
        cell().for_each(|k| jump.iter_mut().zip(&moved[k..k + 3]).for_each(|(j, u)| *j += side * u));
        from = end;
    }
    Some(Column { name: "displacement".into(), components: 3, values: jump })
}

/// Agreement of the columns of all files, by file and column.
type SignAgreement = BTreeMap<(String, String), f64>;

fn read(out: &Path, section: &str, motion: &Motion) -> SignAgreement {
    let (rules, mut all, described) = (rules(section), SignAgreement::new(), described(out));
    for path in files(out) {
        let name = path.strip_prefix(out).unwrap().to_string_lossy().into_owned();
        let mut columns = if name.ends_with(".vtu") {
            arrays(&fs::read_to_string(&path).unwrap())
        } else if name.ends_with(".csv") || name.starts_with("stations/") {
            table(&fs::read_to_string(&path).unwrap())
        } else {
            continue;
        };
        if let Some(jump) = jump(&columns) {
            columns.retain(|c| c.name != "displacement");
            columns.push(jump);
        }
        let grid = ["TimeValue", "Points", "connectivity", "offsets", "types"];
        for column in columns.iter().filter(|c| !grid.contains(&c.name.as_str())) {
            let rule = rules.iter().find(|r| {
                r.files.iter().any(|form| fits(&name, form))
                    && r.columns.iter().any(|form| fits(&column.name, form))
            });
            let rule = rule.unwrap_or_else(|| panic!("no row of the page has `{}` of {name}", column.name));
            let own = described
                .iter()
                .find(|d| d.files.iter().any(|form| fits(&name, form)) && fits(&column.name, &d.column));
            let own = own.unwrap_or_else(|| panic!("`{}` of {name} is not described", column.name));
            assert_eq!(own.sign, rule.sign, "`{}` of {name}", column.name);
            let components = own.array.as_ref().map_or(1, |(components, _)| *components);
            assert_eq!(components, column.components, "`{}` of {name}", column.name);
            let said = said(&rule.sign, column, motion);
            let largest = column.values.iter().filter(|v| v.is_finite()).fold(0.0_f64, |m, v| m.max(v.abs()));
            assert!(
                said >= -ROUNDING * largest,
                "`{}` of {name} says {said:e}: not {}",
                column.name,
                rule.sign
            );
            let before = all.entry((name.clone(), column.name.clone())).or_insert(0.0);
            *before = said.max(*before);
        }
    }
    all
}

/// Runs a scene with the program. Returns the folder of its files.
fn run(folder: &Path, text: &str) -> PathBuf {
    fs::write(folder.join("scene.toml"), text).unwrap();
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_asperity"));
    let output = command.args(["run", "scene.toml"]).current_dir(folder).output().unwrap();
    assert!(output.status.success(), "{}\n{text}", String::from_utf8_lossy(&output.stderr));
    folder.join("out/scene")
}

/// Negative zeros, in any notation.
fn signed_zeros(text: &str) -> Vec<&str> {
    let numbers = text.split(|c: char| !(c.is_ascii_digit() || matches!(c, '-' | '+' | '.' | 'e' | 'E')));
    numbers.filter(|n| n.starts_with('-') && n.parse::<f64>().is_ok_and(|v| v == 0.0)).collect()
}

fn no_zero_has_a_sign(out: &Path) {
    for path in files(out) {
        if path.extension().is_some_and(|e| e == "vtu" || e == "png") || path.ends_with("checkpoint") {
            continue;
        }
        let text = fs::read_to_string(&path).unwrap();
        assert!(signed_zeros(&text).is_empty(), "{:?} in {}", &signed_zeros(&text)[..1], path.display());
    }
}

fn unit(axis: usize, size: f64) -> [f64; 3] {
    std::array::from_fn(|c| if c == axis { size } else { 0.0 })
}

/// The tangent (-n_y, n_x) for a normal along x.
const TANGENT: [f64; 3] = [0.0, 1.0, 0.0];

/// Asserts that these columns showed the sense of motion.
fn told(all: &SignAgreement, form: &str, columns: &[&str]) {
    for column in columns {
        let told = all.iter().any(|((file, name), said)| fits(file, form) && name == column && *said > 0.0);
        assert!(told, "`{column}` of {form} does not tell");
    }
}

#[test]
fn interfaces_have_the_signs_of_the_page() {
    let probes = ["slip", "relative_displacement", "slip_rate", "shear_traction", "normal_traction"];
    let all = [&probes[..], &["mean_shear_traction", "mean_normal_traction", "gap"]].concat();
    for (kinematics, axis) in
        [("plane-strain", 1), ("plane-stress", 1), ("axisymmetric", 1), ("3d", 1), ("3d", 2)]
    {
        for (push, turned) in [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)] {
            let folder = tempfile::tempdir().unwrap();
            let out = run(folder.path(), &interface(kinematics, axis, 1e-3 * push, turned > 0.0));
            // If A is the slave, the normal of the master turns with the sides.
            let positive = (kinematics != "3d").then_some(TANGENT.map(|t| t * turned));
            let motion = Motion {
                push: unit(axis, push),
                slip: unit(axis, push * turned),
                positive,
                components: [[0.0; 3]; 2],
            };
            let found = read(&out, "Bodies and interfaces", &motion);
            told(&found, "probes/*.csv", &probes);
            told(&found, "profiles/*.csv", &all);
            told(&found, "fields/joint_*.vtu", &all);
            told(&found, "fields/bodies_*.vtu", &["displacement", "stress"]);
            let name = ["x", "y", "z"][axis];
            told(&found, "points/*.csv", &[&format!("displacement_{name}"), "stress_xx"]);
            told(&found, "forces/*.csv", &["force_x", &format!("force_{name}")]);
            if positive.is_none() {
                told(&found, "fields/joint_*.vtu", &["slip_vector", "shear_traction_vector"]);
                told(&found, "profiles/*.csv", &[&format!("slip_{name}"), &format!("shear_traction_{name}")]);
            }
            reported(&out, &motion);
            no_zero_has_a_sign(&out);
        }
    }
}

/// The report has the signs of the page.
fn reported(out: &Path, motion: &Motion) {
    let report: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(out.join("report.json")).unwrap()).unwrap();
    let result = report["results"].as_array().unwrap().last().unwrap();
    for rule in rules("Bodies and interfaces").iter().filter(|r| r.files == ["report.json"]) {
        for name in &rule.columns {
            let value = &result[name];
            let values =
                value.as_array().map_or(vec![value.as_f64()], |v| v.iter().map(|v| v.as_f64()).collect());
            let values = values.into_iter().map(Option::unwrap).collect();
            let column = Column { name: name.clone(), components: 1, values };
            assert!(said(&rule.sign, &column, motion) > 0.0, "`{name}` of the report: {:?}", column.values);
        }
    }
}

#[test]
fn faults_have_the_signs_of_the_page() {
    let oblique = [0.0, 0.5, 0.5];
    let rakes = |axis: usize| [Some((unit(axis, 1.0), "along-rake")), Some((oblique, "free"))];
    let space = [1, 2].into_iter().flat_map(|axis| rakes(axis).map(|rake| ("3d", axis, rake)));
    for (kinematics, axis, rake) in
        [("antiplane", 2, None), ("plane-strain", 1, None)].into_iter().chain(space)
    {
        for push in [1.0, -1.0] {
            let folder = tempfile::tempdir().unwrap();
            let out = run(folder.path(), &fault(kinematics, axis, push, rake));
            let free = rake.is_some_and(|(_, slip)| slip == "free");
            let [_, y, z] = rake.map_or([0.0; 3], |(rake, _)| rake);
            let motion = Motion {
                push: unit(axis, push),
                slip: unit(axis, push),
                positive: (!free).then_some(unit(axis, 1.0)),
                // The normal is along x.
                components: [[0.0, y, z], [0.0, -z, y]],
            };
            let found = read(&out, "Faults through earthquake cycles", &motion);
            told(&found, "largest_rate.csv", &["mean shear_traction", "mean slip"]);
            told(&found, "events.csv", &["largest_slip", "moment", "stress_drop"]);
            told(&found, "fields/bodies_*.vtu", &["displacement"]);
            match (kinematics, free) {
                (_, true) => {
                    let two = ["slip_2", "slip_3", "shear_stress_2", "shear_stress_3", "normal_stress"];
                    told(&found, "stations/*", &two);
                    told(&found, "events.csv", &[["direction_y", "direction_z"][axis - 1]]);
                }
                _ => told(&found, "stations/*", &["slip", "shear_stress", "normal_stress"]),
            }
            if kinematics == "3d" {
                let all =
                    ["slip", "slip_vector", "slip_rate_vector", "shear_traction", "shear_traction_vector"];
                told(&found, "fields/main_*.vtu", &all);
                told(&found, "fields/main_event_*.vtu", &["stress_drop", "stress_drop_vector"]);
            } else {
                told(&found, "slip_profiles.csv", &["each point"]);
            }
            no_zero_has_a_sign(&out);
        }
    }
}

/// Mean of a column of a file.
fn mean_of(out: &Path, file: &str, name: &str) -> f64 {
    let columns = table(&fs::read_to_string(out.join(file)).unwrap());
    mean(columns.iter().find(|c| c.name == name).unwrap())[0]
}

#[test]
fn an_interface_and_a_fault_have_one_sign_for_one_motion() {
    let folder = tempfile::tempdir().unwrap();
    for push in [1.0, -1.0] {
        let out = run(folder.path(), &interface("plane-strain", 1, 1e-3 * push, true));
        let last = files(&out.join("profiles")).pop().unwrap();
        let profile = last.strip_prefix(&out).unwrap().to_string_lossy().into_owned();
        let interface = ["slip", "shear_traction"].map(|name| mean_of(&out, &profile, name).signum());
        fs::remove_dir_all(&out).unwrap();
        let out = run(folder.path(), &fault("plane-strain", 1, push, None));
        let station = files(&out.join("stations")).pop().unwrap();
        let station = station.strip_prefix(&out).unwrap().to_string_lossy().into_owned();
        let fault = ["slip", "shear_stress"].map(|name| mean_of(&out, &station, name).signum());
        fs::remove_dir_all(&out).unwrap();
        // The normal is along x, the tangent along y.
        assert_eq!((interface, fault), ([push; 2], [push; 2]));
    }
}
