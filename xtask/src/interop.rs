//! Interoperability checks in a separate Python environment: outputs are read by common readers, and meshes as read
//! here are compared with those of other readers.

use crate::stage::{self, Failure, Stage};
use std::path::{Path, PathBuf};

/// Folder of the sample meshes.
const MESHES: &str = "crates/fem/tests/meshes";

/// Makes the environment, installs the pinned requirements and runs the checks on the sandwich's output, on catalogues of
/// events, on seismograms and on the sample meshes.
pub fn run(root: &Path) -> Result<(), Failure> {
    let python = ["python3", "python"].into_iter().find(|program| stage::exists(program));
    let Some(python) = python else {
        return Err(Failure::Missing {
            program: "python3",
            how: "your system's packages (nothing but this chore needs Python)",
        });
    };
    let output = root.join("out/sandwich");
    if !output.join("fields.pvd").exists() {
        return Err(Failure::Absent { path: output, how: "cargo run --release -- run scenes/sandwich.toml" });
    }
    let environment = root.join("target/interop-venv");
    let inside = python_of(&environment);
    if !inside.exists() {
        let folder = environment.display().to_string();
        Stage::new("environment", python).args(["-m", "venv", &folder]).run(root)?;
    }
    let install =
        ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "-r", "interop/requirements.txt"];
    Stage::new("requirements", &inside).args(install).run(root)?;
    Stage::new("interop", &inside).args(["interop/check_vtu.py", "out/sandwich"]).run(root)?;
    for name in ["strike_slip", "thrust"] {
        let (scene, out) = (format!("interop/{name}.toml"), format!("out/{name}"));
        let binary = ["run", "--release", "--quiet", "-p", "asperity-driver", "--", "run"];
        Stage::new("cycles", "cargo").args(binary).args([scene.as_str(), "--out", &out]).run(root)?;
        let check = ["interop/check_catalogue.py", out.as_str()];
        Stage::new("interop of catalogues", &inside).args(check).run(root)?;
    }
    let binary = ["run", "--release", "--quiet", "-p", "asperity-driver", "--", "run"];
    let scene = ["interop/rupture.toml", "--out", "out/rupture"];
    Stage::new("waves", "cargo").args(binary).args(scene).run(root)?;
    let check = ["interop/check_seismograms.py", "out/rupture/seismograms"];
    Stage::new("interop of seismograms", &inside).args(check).run(root)?;
    let summary = "target/meshes.json";
    let example = ["run", "--release", "--quiet", "-p", "asperity-driver", "--example", "mesh_summary", "--"];
    let files = meshes(root)?;
    Stage::new("meshes", "cargo")
        .args(example)
        .args([summary])
        .args(files.iter().map(String::as_str))
        .run(root)?;
    Stage::new("interop of meshes", &inside).args(["interop/check_meshes.py", summary, MESHES]).run(root)
}

/// Valid sample meshes, sorted by name.
fn meshes(root: &Path) -> Result<Vec<String>, Failure> {
    let mut names = Vec::new();
    for entry in walkdir::WalkDir::new(root.join(MESHES)).sort_by_file_name() {
        let name = entry?.file_name().to_string_lossy().into_owned();
        if (name.ends_with(".msh") || name.ends_with(".inp")) && !name.starts_with("bad_") {
            names.push(format!("{MESHES}/{name}"));
        }
    }
    Ok(names)
}

fn python_of(environment: &Path) -> PathBuf {
    environment.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" })
}
