//! Libraries that `cargo run` and `cargo test` would build twice, since tests, benches or chores enable features that
//! the program does not.

use super::problem::Problem;
use crate::stage::Failure;
use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

/// Packages with programs that are run beside the tests of the workspace.
const PROGRAMS: [&str; 3] = ["asperity", "asperity-verification", "xtask"];

/// Compares the features of each program's libraries with those in the tests of the whole workspace.
pub fn check(root: &Path) -> Result<Vec<Problem>, Failure> {
    let tests = tree(root, &["--workspace", "--edges", "normal,build,dev"])?;
    let mut found = Vec::new();
    for program in PROGRAMS {
        let run = tree(root, &["--package", program, "--edges", "normal,build"])?;
        found.extend(twice(program, &run, &tests));
    }
    Ok(found)
}

fn twice(program: &str, run: &BTreeSet<String>, tests: &BTreeSet<String>) -> Vec<Problem> {
    let message = |built: &String| {
        format!(
            "{program} builds {built}, and the tests of the workspace build it with other features, so that it is built twice; turn those on here too"
        )
    };
    run.difference(tests).map(|built| Problem::new("Cargo.toml", 0, message(built))).collect()
}

/// Packages with their features, as in "either v1.15.0 \[use_std\]".
fn tree(root: &Path, selection: &[&str]) -> Result<BTreeSet<String>, Failure> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo)
        .args(["tree", "--no-dedupe", "--prefix", "none", "--format", "{p} [{f}]"])
        .args(selection)
        .current_dir(root)
        .output()
        .map_err(|source| Failure::Start { program: "cargo tree".into(), source })?;
    if !output.status.success() {
        return Err(Failure::Stage { stage: "cargo tree".into(), code: output.status.code() });
    }
    // "(*)" and "(proc-macro)" are notes, and workspace packages are followed by their path.
    let text = String::from_utf8_lossy(&output.stdout);
    let plain =
        |line: &str| line.split_whitespace().filter(|w| !w.starts_with('(')).collect::<Vec<_>>().join(" ");
    Ok(text.lines().map(plain).filter(|line| !line.is_empty()).collect())
}

#[cfg(test)]
mod tests {
    use super::twice;

    #[test]
    fn a_library_with_other_features_in_the_tests_is_caught() {
        let set = |lines: &[&str]| lines.iter().map(ToString::to_string).collect();
        let tests = set(&["either v1 [use_std]", "faer v0 [std]"]);
        assert_eq!(twice("driver", &set(&["either v1 []", "faer v0 [std]"]), &tests).len(), 1);
        assert!(twice("driver", &set(&["faer v0 [std]"]), &tests).is_empty());
    }
}
