//! Who may name a module of a crate: what is above it. The files below work on values.

use super::circles::{paths, without_tests};
use super::problem::Problem;
use super::source::is_test_file;
use super::tree::File;

/// A rule on the sources of a crate.
struct Row {
    /// Folder of the crate's sources, or one in it; ends with a slash.
    folder: &'static str,
    /// Modules of the crate that the rule is about.
    modules: Modules,
    /// Files, and folders with a slash at the end, to which the rule does not apply, from `folder`.
    except: &'static [&'static str],
    /// What a file that breaks the rule is told.
    reason: &'static str,
}

/// Modules at the root of a crate.
enum Modules {
    /// These.
    These(&'static [&'static str]),
    /// All but these.
    AllBut(&'static [&'static str]),
}

const ROWS: [Row; 2] = [
    Row {
        folder: "crates/driver/src/",
        modules: Modules::These(&["scene"]),
        except: &[
            "cli/",
            "diagnostic/",
            "fault/",
            "loading/",
            "model/",
            "plan/",
            "scene/",
            "slider/",
            "amounts.rs",
            "forecast.rs",
            "initial_stress.rs",
            "laws.rs",
            "lengths.rs",
            "lib.rs",
            "loading.rs",
        ],
        reason: "plans are made from the scene, and what lies below them works on values",
    },
    Row {
        folder: "crates/driver/src/mechanics/",
        modules: Modules::AllBut(&["mechanics"]),
        except: &[],
        reason: "mechanics knows values and the crates below the driver only",
    },
];

/// Finds files that name what they must not.
pub fn check(files: &[File]) -> Vec<Problem> {
    ROWS.iter().flat_map(|row| files.iter().filter_map(move |file| broken(row, file))).collect()
}

fn broken(row: &Row, file: &File) -> Option<Problem> {
    let name = file.path.strip_prefix(row.folder).filter(|name| name.ends_with(".rs"))?;
    let covers = |entry: &&str| if entry.ends_with('/') { name.starts_with(*entry) } else { name == *entry };
    if is_test_file(&file.path) || row.except.iter().any(covers) {
        return None;
    }
    let names = paths::names(&without_tests(&file.text));
    let imports = names.bindings.iter().map(|binding| &binding.path);
    let found = imports.chain(&names.paths).find_map(|path| refused(row, path))?;
    Some(Problem::new(&file.path, 0, format!("names `crate::{found}`: {}", row.reason)))
}

/// The module at the root of the crate that a path leads to, where the rule refuses it.
fn refused<'a>(row: &Row, path: &'a [String]) -> Option<&'a str> {
    let (first, rest) = path.split_first()?;
    // A crate of this name is passed on by the root.
    let module =
        first.strip_prefix("asperity_").or_else(|| (first == "crate").then_some(rest.first()?.as_str()))?;
    let refused = match row.modules {
        Modules::These(modules) => modules.contains(&module),
        Modules::AllBut(modules) => first == "crate" && !modules.contains(&module),
    };
    refused.then_some(module)
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
            assert!(broken("mechanics/system/mod.rs", text), "{text}");
            assert!(!broken("plan/path.rs", text), "{text}");
        }
        assert!(!broken(
            "run.rs",
            "//! [`crate::scene`]\nuse crate::plan::Plan;\n#[cfg(test)]\nmod tests { use crate::scene; }\n"
        ));
    }

    #[test]
    fn mechanics_that_knows_the_driver_is_caught() {
        assert!(broken("mechanics/model.rs", "use crate::plan::Plan;\n"));
        assert!(!broken(
            "mechanics/model.rs",
            "use crate::mechanics::Stage;\nuse asperity_fem::mesh::Mesh;\n"
        ));
    }
}
