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

const ROWS: [Row; 2] = [
    Row {
        folder: "crates/plan/src/",
        module: "scene",
        readers: &[
            "bodies/",
            "doubts/",
            "dynamics/planner/",
            "faults/planner/",
            "kinds.rs",
            "reading/",
            "shared/",
            "sliders/planner/",
        ],
        reason: "planners read the scene, and plans are values",
    },
    Row {
        folder: "crates/asperity/src/",
        module: "scene",
        readers: &["cli/"],
        reason: "plans are made from the scene, and runs work on plans",
    },
];

/// Modules of the crate of scenes that everyone may name: defaults, and lengths as text.
const OPEN: [&str; 2] = ["defaults", "lengths"];

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
        [first, second, ..] if first.strip_prefix("asperity_") == Some(module) => {
            !OPEN.contains(&second.as_str())
        }
        [first, rest @ ..] => {
            let ours = first == "crate" || first.starts_with("asperity_");
            let named = if rest.first().is_some_and(|s| s == "reading") { &rest[1..] } else { rest };
            first.strip_prefix("asperity_") == Some(module)
                || ours && named.first().is_some_and(|s| s == module)
        }
        [] => false,
    }
}

#[cfg(test)]
mod tests {
    use super::check;
    use crate::tidy::tree::File;

    fn broken(path: &str, text: &str) -> bool {
        let file = File { path: format!("crates/{path}"), text: text.to_owned() };
        !check(&[file]).is_empty()
    }

    #[test]
    fn a_scene_below_the_plan_is_caught() {
        for text in [
            "use crate::reading::scene::model::Scene;\n",
            "use asperity_plan::reading::scene;\n",
            "use crate::reading::{scene, columns};\n",
            "use asperity_scene::Scene;\n",
            "fn f() { asperity_scene::read(\"\") }\n",
        ] {
            assert!(broken("asperity/src/kinds/bodies.rs", text), "{text}");
            assert!(broken("asperity/src/keep/mod.rs", text), "{text}");
            assert!(broken("plan/src/faults/plan.rs", text), "{text}");
            assert!(!broken("plan/src/faults/planner/place.rs", text), "{text}");
            assert!(!broken("asperity/src/cli/read.rs", text), "{text}");
        }
        assert!(!broken(
            "asperity/src/keep/mod.rs",
            "//! [`asperity_scene`]\nuse asperity_scene::lengths;\n#[cfg(test)]\nmod tests { use asperity_scene::read; }\n"
        ));
    }
}
