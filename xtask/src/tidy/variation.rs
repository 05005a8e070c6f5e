//! Scenes of the suite, the benches and the tests are varied by key path, not by replacing text.

use super::problem::Problem;
use super::source::{mask, regions};
use super::tree::File;

/// What replaces text without noticing that there is nothing to replace.
const CALLS: [&str; 2] = [".replace(", ".replacen("];

const WHY: &str = "text replaced where it may be absent: vary scenes by key path (asperity_vary::SceneText)";

/// Files whose replaced texts are no scenes, and what they are.
const NO_SCENES: [(&str, &str); 7] = [
    ("verification/src/readme.rs", "pages of the book, in its tests"),
    ("verification/src/report/html.rs", "names of counts, as words"),
    ("verification/src/report/svg.rs", "digits at the ticks of an axis"),
    ("verification/tests/harness.rs", "a page of the report"),
    ("verification/cases/slider_cycles/mod.rs", "a name, as a title"),
    ("crates/fem/tests/all/abaqus.rs", "mesh files of Abaqus"),
    ("crates/fem/tests/all/gmsh.rs", "mesh files of Gmsh"),
];

/// Tests that still replace text in scenes, and how often. What is converted leaves the list.
const LEFT: [(&str, usize); 24] = [
    ("crates/driver/tests/all/antiplane.rs", 4),
    ("crates/driver/tests/all/bodies.rs", 9),
    ("crates/driver/tests/all/command.rs", 6),
    ("crates/driver/tests/all/directories.rs", 10),
    ("crates/driver/tests/all/documents.rs", 3),
    ("crates/driver/tests/all/doubtful_scenes.rs", 14),
    ("crates/driver/tests/all/enforcement.rs", 1),
    ("crates/driver/tests/all/fault.rs", 7),
    ("crates/driver/tests/all/fault_geometry.rs", 7),
    ("crates/driver/tests/all/fault_normal.rs", 3),
    ("crates/driver/tests/all/fault_opening.rs", 9),
    ("crates/driver/tests/all/fault_outputs.rs", 6),
    ("crates/driver/tests/all/instability.rs", 9),
    ("crates/driver/tests/all/laws.rs", 2),
    ("crates/driver/tests/all/loads.rs", 5),
    ("crates/driver/tests/all/located.rs", 3),
    ("crates/driver/tests/all/mesh_files.rs", 2),
    ("crates/driver/tests/all/meshes.rs", 4),
    ("crates/driver/tests/all/resume.rs", 19),
    ("crates/driver/tests/all/samples.rs", 2),
    ("crates/driver/tests/all/slider.rs", 9),
    ("crates/driver/tests/all/slider_outputs.rs", 13),
    ("crates/driver/tests/all/snapshot.rs", 1),
    ("crates/driver/tests/all/solvers.rs", 2),
];

/// Checks the sources of the suite, the benches and the tests.
pub fn check(files: &[File]) -> Vec<Problem> {
    check_against(files, &LEFT)
}

fn check_against(files: &[File], left: &[(&str, usize)]) -> Vec<Problem> {
    let mut found = Vec::new();
    for file in files.iter().filter(|file| varies_scenes(&file.path)) {
        if NO_SCENES.iter().any(|(path, _)| *path == file.path) {
            continue;
        }
        let code = mask::code(&file.text);
        let places: Vec<usize> = CALLS.iter().flat_map(|call| regions::occurrences(&code, call)).collect();
        let allowed = left.iter().find(|(path, _)| *path == file.path).map_or(0, |(_, n)| *n);
        if places.len() < allowed {
            let message =
                format!("{} of {allowed} replacements are left: say so in tidy/variation.rs", places.len());
            found.push(Problem::new(&file.path, 0, message));
        }
        if places.len() > allowed {
            found.extend(places.iter().map(|&at| Problem::new(&file.path, regions::line_of(&code, at), WHY)));
        }
    }
    found
}

fn varies_scenes(path: &str) -> bool {
    let of_tests = path.strip_prefix("crates/").and_then(|rest| rest.split_once('/'));
    path.ends_with(".rs")
        && (path.starts_with("verification/")
            || path.starts_with("benches/")
            || of_tests.is_some_and(|(_, rest)| rest.starts_with("tests/")))
}

#[cfg(test)]
mod tests {
    use super::{File, NO_SCENES, check, check_against};

    fn file(path: &str, text: &str) -> File {
        File { path: path.to_owned(), text: text.to_owned() }
    }

    fn lines(path: &str, text: &str) -> Vec<usize> {
        check(&[file(path, text)]).iter().map(|problem| problem.line).collect()
    }

    #[test]
    fn replaced_text_is_caught_in_the_suite_the_benches_and_the_tests() {
        let text = "fn f() {\n    SCENE.replace(\"8000 km\", \"4000 km\");\n    SCENE\n        .replacen(a, b, 1);\n}\n";
        for path in ["verification/cases/a/mod.rs", "benches/benches/a.rs", "crates/ode/tests/all/a.rs"] {
            assert_eq!(lines(path, text), [2, 4], "{path}");
        }
        for path in ["crates/driver/src/a.rs", "xtask/src/a.rs", "benches/compare/a.py"] {
            assert_eq!(lines(path, text), [0usize; 0], "{path}");
        }
    }

    #[test]
    fn words_other_calls_and_files_without_scenes_pass() {
        let other = "// text.replace(a, b)\nfn f() { std::mem::replace(a, b); \".replace(\"; }\n";
        assert_eq!(lines("verification/cases/a/mod.rs", other), [0usize; 0]);
        assert_eq!(lines(NO_SCENES[0].0, "fn f() { page.replace(a, b); }\n"), [0usize; 0]);
    }

    #[test]
    fn what_is_left_to_convert_shrinks_only() {
        let (path, text) = ("crates/a/tests/b.rs", "fn f() { a.replace(b, c).replace(d, e); }\n");
        let found = |n| check_against(&[file(path, text)], &[(path, n)]).len();
        assert_eq!([found(1), found(2), found(3)], [2, 0, 1]);
    }
}
