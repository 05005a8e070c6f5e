//! Layers within crates: which files may name a module. The files below it work on values.

use super::circles::{paths, without_tests};
use super::problem::Problem;
use super::source::is_test_file;
use super::tree::File;

/// A rule about the sources of a crate.
struct Row {
    /// Folder of the crate's sources, with a slash at the end.
    folder: &'static str,
    /// Subject of the rule: the module of this name, or the crate `asperity_` with this name.
    module: &'static str,
    /// Files, and folders with a slash at the end, that may name it, relative to `folder`.
    readers: &'static [&'static str],
    /// Message for a file that breaks the rule.
    reason: &'static str,
}

const ROWS: [Row; 1] = [Row {
    folder: "crates/driver/src/",
    module: "scene",
    readers: &[
        "benchmark/submission.rs",
        "checks/of_model.rs",
        "cite/",
        "cli/",
        "diagnostic/",
        "doubts/",
        "dynamic/planner/",
        "fault/planner/",
        "field/",
        "loading/",
        "model/",
        "plan/",
        "slider_planner/",
        "amounts.rs",
        "columns.rs",
        "columns/",
        "handover.rs",
        "idealisation.rs",
        "impedance.rs",
        "initial_stress.rs",
        "kinds.rs",
        "lengths.rs",
        "lib.rs",
        "loading.rs",
        "missing.rs",
        "place/",
        "refused.rs",
        "resolution/",
        "scene.rs",
        "slider_planner.rs",
        "thresholds.rs",
    ],
    reason: "plans are made from the scene, and what lies below them works on values",
}];

/// Finds files that refer to modules outside their layer.
pub fn check(files: &[File]) -> Vec<Problem> {
    ROWS.iter().flat_map(|row| files.iter().filter_map(move |file| broken(row, file))).collect()
}

fn broken(row: &Row, file: &File) -> Option<Problem> {
    let name = file.path.strip_prefix(row.folder).filter(|name| name.ends_with(".rs"))?;
    let covers = |entry: &&str| if entry.ends_with('/') { name.starts_with(*entry) } else { name == *entry };
    if is_test_file(&file.path) || row.readers.iter().any(covers) {
        return None;
    }
    let names = paths::names(&without_tests(&file.text));
    let imports = names.bindings.iter().map(|binding| &binding.path);
    imports
        .chain(&names.paths)
        .any(|path| leads_to(path, row.module))
        .then(|| Problem::new(&file.path, 0, format!("names the {}: {}", row.module, row.reason)))
}

fn leads_to(path: &[String], module: &str) -> bool {
    match path {
        [first, second, ..] if first == "crate" => second == module,
        [first, ..] => first.strip_prefix("asperity_") == Some(module),
        [] => false,
    }
}

#[cfg(test)]
mod tests {
    use super::check;
    use crate::tidy::tree::File;

    fn broken(path: &str, text: &str) -> bool {
        let file = File { path: format!("crates/driver/src/{path}"), text: text.to_owned() };
        !check(&[file]).is_empty()
    }

    #[test]
    fn a_scene_below_the_plan_is_caught() {
        for text in [
            "use crate::scene::model::Scene;\n",
            "use crate::{scene, run};\n",
            "use asperity_scene::Scene;\n",
            "fn f() { crate::scene::read(\"\") }\n",
        ] {
            assert!(broken("run.rs", text), "{text}");
            assert!(broken("step/mod.rs", text), "{text}");
            assert!(broken("fault/plan.rs", text), "{text}");
            assert!(!broken("plan/path.rs", text), "{text}");
        }
        assert!(!broken(
            "run.rs",
            "//! [`crate::scene`]\nuse crate::plan::Plan;\n#[cfg(test)]\nmod tests { use crate::scene; }\n"
        ));
    }
}
