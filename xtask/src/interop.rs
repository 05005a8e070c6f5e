//! Checks of our outputs by their real readers, in a Python environment of its own.

use crate::stage::{self, Failure, Stage};
use std::path::{Path, PathBuf};

/// Makes the environment, installs the pinned requirements and runs the checks on the sandwich's output.
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
    Stage::new("interop", &inside).args(["interop/check_vtu.py", "out/sandwich"]).run(root)
}

fn python_of(environment: &Path) -> PathBuf {
    environment.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" })
}
