//! Rule that scenes in the suite, benches and tests are varied by key path, not by replacing text.

use super::problem::Problem;
use super::tree::File;
use crate::code::{mask, regions};

/// Functions that replace text and do not report a missing match.
const CALLS: [&str; 2] = [".replace(", ".replacen("];

const WHY: &str = "text replaced where it may be absent: vary scenes by key path (asperity_vary::SceneText)";

/// Files in which the replaced texts are not scenes, with a description of these texts.
const NO_SCENES: [(&str, &str); 7] = [
    ("verification/src/readme.rs", "pages of the book, in its tests"),
    ("verification/src/report/html.rs", "names of counts, as words"),
    ("verification/src/report/svg.rs", "digits at the ticks of an axis"),
    ("verification/tests/harness.rs", "a page of the report"),
    ("verification/cases/slider_cycles/mod.rs", "a name, as a title"),
    ("crates/fem/tests/all/abaqus.rs", "mesh files of Abaqus"),
    ("crates/fem/tests/all/gmsh.rs", "mesh files of Gmsh"),
];

/// Checks the sources of the suite, the benches and the tests.
pub fn check(files: &[File]) -> Vec<Problem> {
    let mut found = Vec::new();
    for file in files.iter().filter(|file| varies_scenes(&file.path)) {
        if NO_SCENES.iter().any(|(path, _)| *path == file.path) {
            continue;
        }
        let code = mask::code(&file.text);
        let places: Vec<usize> = CALLS.iter().flat_map(|call| regions::occurrences(&code, call)).collect();
        found.extend(places.iter().map(|&at| Problem::new(&file.path, regions::line_of(&code, at), WHY)));
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
    use super::{File, NO_SCENES, check};

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
        for path in ["crates/plan/src/a.rs", "xtask/src/a.rs", "benches/compare/a.py"] {
            assert_eq!(lines(path, text), [0usize; 0], "{path}");
        }
    }

    #[test]
    fn words_other_calls_and_files_without_scenes_pass() {
        let other = "// text.replace(a, b)\nfn f() { std::mem::replace(a, b); \".replace(\"; }\n";
        assert_eq!(lines("verification/cases/a/mod.rs", other), [0usize; 0]);
        assert_eq!(lines(NO_SCENES[0].0, "fn f() { page.replace(a, b); }\n"), [0usize; 0]);
    }
}
