//! Interoperability checks in a separate Python environment: outputs are read by common readers, and meshes as read
//! here are compared with those of other readers.

use crate::stage::{self, Failure, Stage};
use std::path::{Path, PathBuf};

/// Folder of the sample meshes.
const MESHES: &str = "crates/fem/tests/meshes";

/// Environment of most readers, below `target`, and its requirements.
const READERS: (&str, &str) = ("interop-venv", "interop/requirements.txt");
/// Environment of the reader of the citation, and its requirements.
const CITATION: (&str, &str) = ("interop-citation-venv", "interop/requirements-citation.txt");

/// Small runs whose outputs are read: faults through cycles, a dynamic rupture and a spring-slider.
const RUNS: [(&str, &str); 5] = [
    ("interop/strike_slip.toml", "out/strike_slip"),
    ("interop/thrust.toml", "out/thrust"),
    ("interop/dipping.toml", "out/dipping"),
    ("interop/rupture.toml", "out/rupture"),
    ("scenes/spring-slider.toml", "out/spring-slider"),
];

/// Modules of the readers, which must be importable.
const MODULES: &str = "import gmsh, jsonschema, meshio, numpy, obspy, pandas, PIL, pyvista, scipy, vtk";

/// As [`run`], but without readers prints so and succeeds: a machine may have no Python or no network.
pub fn run_if_possible(root: &Path) -> Result<(), Failure> {
    let readers = environment(root, READERS.0, READERS.1)
        .and_then(|inside| Stage::new("import", inside).args(["-c", MODULES]).run(root))
        .and_then(|()| environment(root, CITATION.0, CITATION.1));
    match readers {
        Ok(_) => run(root),
        Err(failure) => {
            println!("interop skipped, since its readers are not available: {failure}");
            Ok(())
        }
    }
}

/// Makes the environments, installs the pinned requirements and runs the checks on the outputs of the sandwich and of small
/// runs, on the schemas, on the sample meshes and on the citation.
pub fn run(root: &Path) -> Result<(), Failure> {
    let output = root.join("out/sandwich");
    if !output.join("fields.pvd").exists() {
        return Err(Failure::Absent { path: output, how: "cargo run --release -- run scenes/sandwich.toml" });
    }
    let inside = environment(root, READERS.0, READERS.1)?;
    let check =
        |name: &str, arguments: &[&str]| Stage::new(name, &inside).args(arguments.iter().copied()).run(root);
    check("interop of fields", &["interop/check_vtu.py", "out/sandwich"])?;
    for (scene, out) in RUNS {
        let binary = ["run", "--release", "--quiet", "-p", "asperity", "--", "run", scene, "--out", out];
        Stage::new(scene, "cargo").args(binary).args(["--force"]).run(root)?;
    }
    for out in ["out/strike_slip", "out/thrust"] {
        check("interop of catalogues", &["interop/check_catalogue.py", out])?;
    }
    check("interop of grids", &["interop/check_grids.py", "out/dipping"])?;
    check("interop of seismograms", &["interop/check_seismograms.py", "out/rupture/seismograms"])?;
    let outputs = ["out/sandwich"].into_iter().chain(RUNS.map(|run| run.1));
    let tables: Vec<&str> = ["interop/check_tables.py"].into_iter().chain(outputs.clone()).collect();
    check("interop of tables", &tables)?;
    let pages: Vec<&str> = ["interop/check_page.py"].into_iter().chain(outputs.clone()).collect();
    check("interop of pages", &pages)?;
    let program = root.join("target/release/asperity").display().to_string();
    let json: Vec<&str> = ["interop/check_json.py", &program, "scenes"].into_iter().chain(outputs).collect();
    check("interop of schemas", &json)?;
    check("interop of values", &["interop/check_fields.py", &program, "interop/fields.toml"])?;
    let summary = "target/meshes.json";
    let example = ["run", "--release", "--quiet", "-p", "asperity", "--example", "mesh_summary", "--"];
    let files = meshes(root)?;
    Stage::new("meshes", "cargo")
        .args(example)
        .args([summary])
        .args(files.iter().map(String::as_str))
        .run(root)?;
    check("interop of meshes", &["interop/check_meshes.py", summary, MESHES])?;
    let citing = environment(root, CITATION.0, CITATION.1)?;
    let citation = ["interop/check_citation.py", "CITATION.cff"];
    Stage::new("interop of the citation", &citing).args(citation).run(root)
}

/// Makes an environment below `target` with the requirements of a file, and returns its Python.
fn environment(root: &Path, name: &str, requirements: &str) -> Result<PathBuf, Failure> {
    let python = ["python3", "python"].into_iter().find(|program| stage::exists(program));
    let Some(python) = python else {
        return Err(Failure::Missing {
            program: "python3",
            how: "your system's packages (nothing but this chore needs Python)",
        });
    };
    let environment = root.join("target").join(name);
    let inside = python_of(&environment);
    if !inside.exists() {
        let folder = environment.display().to_string();
        Stage::new("environment", python).args(["-m", "venv", &folder]).run(root)?;
    }
    let install = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--retries", "1"];
    Stage::new("requirements", &inside).args(install).args(["-r", requirements]).run(root)?;
    Ok(inside)
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
