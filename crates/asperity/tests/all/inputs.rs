//! Files that scenes name are kept in output directories, from which the scene is run again with the same bits.
#![allow(clippy::disallowed_methods)]
#![cfg(unix)]

use crate::common::{told, varied};
use crate::messages::base;
use crate::resume::files;
use asperity::cli::inputs::Inputs;
use asperity_vary::Change::{Push, With};
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn asperity(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_asperity")).current_dir(folder).args(arguments).output().unwrap()
}

const MESH: &str = r#"schema = 1
title = "a mesh"
kinematics = "plane-strain"
[materials.m]
young = 1e9
poisson = 0.2
[bodies.B]
mesh.gmsh = { file = 'data/two_layers.msh' }
material = "m"
[[stages]]
name = "load"
duration = 1
steps = 1
conditions = [{ set = "B.bottom", x = 0, y = 0 }, { set = "B.top", pressure = 1e6 }]
[time]
stepper = "implicit"
"#;

/// Scenes with files of each kind in the folder `data`, and the names of the copies.
fn scenes() -> Vec<(String, Vec<&'static str>)> {
    let tables = varied(
        &base("body"),
        &[
            With("stages[0].duration", "2 s"),
            With(
                "stages[0].conditions[2].x",
                r#"{ table = { file = "data/history.csv", column = "stroke" } }"#,
            ),
            Push(
                "stages[0].conditions",
                r#"{ set = "A.top", pressure = { table = { file = "data/other/history.csv", column = "pressure" } } }"#,
            ),
        ],
    );
    let fields = varied(&base("fields"), &[With("faults.main.fields.a.file", r#""data/friction.csv""#)]);
    let trace = varied(&fields, &[With("faults.main.line.trace", r#"{ file = "./data/trace.csv" }"#)]);
    let of_law = varied(
        &base("fields-of-interfaces"),
        &[With("interfaces.base.fields.mu.file", r#""data/coefficient.csv""#)],
    );
    let triangles =
        varied(&base("triangles"), &[With("faults.main.triangles.stl.file", r#""data/fault.stl""#)]);
    let sliders = varied(
        &base("sliders"),
        &[
            With("load.rate", r#"{ table = { file = "data/other/rate.csv", column = "rate" } }"#),
            With("time.end", "\"40 s\""),
        ],
    );
    vec![
        (tables, vec!["history-2.csv", "history.csv"]),
        (MESH.into(), vec!["two_layers.msh"]),
        (fields, vec!["friction.csv"]),
        (of_law, vec!["coefficient.csv"]),
        (trace, vec!["friction.csv", "trace.csv"]),
        (triangles, vec!["fault.stl"]),
        (sliders, vec!["rate.csv"]),
    ]
}

/// Puts the files of the scenes into a folder.
fn put(data: &Path) {
    let meshes = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/meshes");
    fs::create_dir_all(data.join("other")).unwrap();
    for name in ["two_layers.msh", "friction.csv", "coefficient.csv", "fault.stl", "history.csv"] {
        fs::copy(meshes.join(name), data.join(name)).unwrap();
    }
    fs::write(data.join("other/history.csv"), "time [s],pressure [MPa]\n0,0\n2,3\n").unwrap();
    fs::write(data.join("other/rate.csv"), "time [s],rate [um/s]\n0,1\n10,1\n10,4\n40,4\n").unwrap();
    fs::write(data.join("trace.csv"), "x [km],y [km]\n0,0\n0,-40\n").unwrap();
}

#[test]
fn a_result_that_was_moved_is_computed_again_with_the_same_bits() {
    for (scene, copies) in scenes() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        put(&folder.join("data"));
        fs::write(folder.join("s.toml"), &scene).unwrap();
        let output = asperity(folder, &["run", "s.toml", "--out", "result"]);
        assert!(output.status.success(), "{}", told(&output));
        let said = String::from_utf8_lossy(&output.stdout);
        assert!(said.contains("copied to inputs/"), "{said}");
        fs::create_dir(folder.join("elsewhere")).unwrap();
        fs::rename(folder.join("result"), folder.join("elsewhere/archive")).unwrap();
        fs::remove_dir_all(folder.join("data")).unwrap();
        let output = asperity(folder, &["run", "elsewhere/archive/scene.toml", "--out", "again"]);
        assert!(output.status.success(), "{}", told(&output));
        let [archive, again] = ["elsewhere/archive", "again"].map(|out| files(&folder.join(out)));
        // Notes on the page name files as the scene does.
        let results = archive.iter().filter(|(path, _)| !path.ends_with("report.html"));
        for (path, bytes) in results {
            assert!(again.get(path) == Some(bytes), "{} differs", path.display());
        }
        assert_eq!(archive.len(), again.len());
        let mut kept: Vec<String> = fs::read_dir(folder.join("again/inputs"))
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        kept.sort();
        assert_eq!(kept, copies);
    }
}

#[test]
fn a_scene_in_the_output_directory_resumes_there_and_does_not_begin_there() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    put(&folder.join("data"));
    let (scene, _) = scenes().remove(0);
    fs::write(folder.join("s.toml"), &scene).unwrap();
    let output = asperity(folder, &["run", "s.toml", "--out", "part", "--wall-time", "0 s"]);
    assert_eq!(output.status.code(), Some(3), "{}", told(&output));
    let here = ["run", "part/scene.toml", "--out", "part"];
    let refused = asperity(folder, &[&here[..], &["--force"]].concat());
    assert_eq!(refused.status.code(), Some(1));
    assert!(told(&refused).contains("the scene lies in the output directory part"), "{}", told(&refused));
    fs::remove_dir_all(folder.join("data")).unwrap();
    let resumed = asperity(folder, &[&here[..], &["--resume"]].concat());
    assert!(resumed.status.success(), "{}", told(&resumed));
    assert!(String::from_utf8_lossy(&resumed.stdout).contains("resumed at"));
}

#[test]
fn a_file_that_somebody_put_beside_the_copies_is_not_touched() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    put(&folder.join("data"));
    let (scene, _) = scenes().remove(0);
    fs::write(folder.join("s.toml"), &scene).unwrap();
    assert!(asperity(folder, &["run", "s.toml", "--out", "out"]).status.success());
    assert!(asperity(folder, &["run", "s.toml", "--out", "out"]).status.success());
    fs::write(folder.join("out/inputs/mine.csv"), "mine").unwrap();
    for arguments in [&["run", "s.toml", "--out", "out"][..], &["run", "s.toml", "--out", "out", "--force"]] {
        let refused = asperity(folder, arguments);
        assert_eq!(refused.status.code(), Some(1));
        assert!(told(&refused).contains("mine.csv is not of a run"), "{}", told(&refused));
    }
}

#[test]
fn copies_keep_their_names_when_a_scene_names_copies() {
    let text = "a = 'x/m.msh'\nb = \"y/m.msh\"\nc = \"x/m.msh\"\nd = \"m-2.msh\"\n";
    let named = |text: &'static str| {
        let at = |name: &'static str, from: usize| {
            let start = from + text[from..].find(name).unwrap() - 1;
            (start..start + name.len() + 2, name)
        };
        (text, at)
    };
    let (_, at) = named(text);
    let names = [at("x/m.msh", 0), at("y/m.msh", 0), at("x/m.msh", 20), at("m-2.msh", 0)];
    let kept = Inputs::from_scene(text, Path::new(""), &names).unwrap();
    let expected =
        "a = \"inputs/m.msh\"\nb = \"inputs/m-2.msh\"\nc = \"inputs/m.msh\"\nd = \"inputs/m-2-2.msh\"\n";
    assert_eq!(kept.text, expected);
    let (_, at) = named(
        "a = \"inputs/m.msh\"\nb = \"inputs/m-2.msh\"\nc = \"inputs/m.msh\"\nd = \"inputs/m-2-2.msh\"\n",
    );
    let names =
        [at("inputs/m.msh", 0), at("inputs/m-2.msh", 0), at("inputs/m.msh", 30), at("inputs/m-2-2.msh", 0)];
    assert_eq!(Inputs::from_scene(expected, Path::new(""), &names).unwrap().text, expected);
    // A position that holds something else.
    assert!(Inputs::from_scene(text, Path::new(""), &[(0..3, "x/m.msh")]).is_err());
}
