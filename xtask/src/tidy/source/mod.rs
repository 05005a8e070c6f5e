//! Rules about Rust sources.

mod floats;

use super::graph::LIBRARIES;
use super::problem::Problem;
use crate::code::{mask, regions};
use std::ops::Range;

/// Magnitude below which a float literal must be a documented constant: it is a tolerance or a unit, and both need a reason.
const SMALL: f64 = 1e-3;

/// Number of lines from which a file should be split, and the largest number allowed.
const LONG: usize = 700;
const TOO_LONG: usize = 1000;

/// Marks of unfinished code and of tests that are not run.
const NOWHERE: [(&str, &str); 3] = [
    ("todo!", "unfinished code: a path that can be reached must work or be refused by the plan"),
    ("unimplemented!", "unfinished code: a path that can be reached must work or be refused by the plan"),
    ("#[ignore", "an ignored test is no test"),
];

/// Names that libraries of values never use, because they open files, read clocks or the environment, or print.
const NOT_IN_LIBRARIES: [&str; 12] = [
    "std::fs",
    "std::env",
    "std::time",
    "std::net",
    "std::process",
    "std::io::stdout",
    "std::io::stderr",
    "println!",
    "print!",
    "eprintln!",
    "eprint!",
    "dbg!",
];

/// Checks one source.
pub fn check(path: &str, source: &str) -> Vec<Problem> {
    let code = mask::code(source);
    let tests = if is_test_file(path) { regions::whole(&code) } else { regions::tests(&code) };
    let mut found: Vec<Problem> = length(path, source).into_iter().collect();
    for (word, why) in NOWHERE {
        found.extend(words(path, &code, word, &[], why));
    }
    if !path.starts_with("verification/cases/") {
        found.extend(small_floats(path, source, &code, &tests));
    }
    found.extend(words(
        path,
        &code,
        ".unwrap()",
        &tests,
        "unwrap outside tests: return an error or expect with a reason",
    ));
    if is_library(path) {
        for word in NOT_IN_LIBRARIES {
            let why = format!("`{word}` in a library that works on values");
            found.extend(words(path, &code, word, &tests, &why));
        }
    }
    found
}

/// True for integration tests, benches, and modules declared only under `cfg(test)`.
pub fn is_test_file(path: &str) -> bool {
    let mut parts = path.split('/').rev();
    let file = parts.next().unwrap_or("");
    file == "tests.rs"
        || parts.any(|folder| folder == "tests" || folder == "benches" && path.contains("/benches/"))
}

fn is_library(path: &str) -> bool {
    LIBRARIES
        .iter()
        .any(|name| path.starts_with(&format!("crates/{}/", name.trim_start_matches("asperity-"))))
}

fn length(path: &str, source: &str) -> Option<Problem> {
    let lines = source.lines().count();
    let problem = Problem::new(path, 0, format!("{lines} lines: divide the file (one concept a file)"));
    (lines >= LONG).then_some(Problem { warning: lines <= TOO_LONG, ..problem })
}

/// Problems at every position outside `allowed` where the code names `word`.
fn words(path: &str, code: &[char], word: &str, allowed: &[Range<usize>], why: &str) -> Vec<Problem> {
    let places = regions::occurrences(code, word).into_iter();
    // `print!` must not be found in `eprint!`.
    let begins = |&at: &usize| at == 0 || !mask::is_name(code[at - 1]) || !word.starts_with(mask::is_name);
    places
        .filter(begins)
        .filter(|at| !allowed.iter().any(|region| region.contains(at)))
        .map(|at| Problem::new(path, regions::line_of(code, at), why))
        .collect()
}

fn small_floats(path: &str, source: &str, code: &[char], tests: &[Range<usize>]) -> Vec<Problem> {
    let constants = regions::documented_constants(source, code);
    let allowed = |at: usize| tests.iter().chain(&constants).any(|region| region.contains(&at));
    floats::floats(code)
        .into_iter()
        .filter(|float| float.value != 0.0 && float.value.abs() < SMALL && !allowed(float.at))
        .map(|float| {
            let message =
                format!("the small literal {:e} needs a constant with a documented reason", float.value);
            Problem::new(path, regions::line_of(code, float.at), message)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::check;

    const LIBRARY: &str = "crates/fem/src/a.rs";

    fn lines(path: &str, source: &str) -> Vec<usize> {
        check(path, source).iter().map(|problem| problem.line).collect()
    }

    #[test]
    fn a_small_literal_is_caught_wherever_it_decides_something() {
        assert_eq!(lines(LIBRARY, "fn f(x: f64) -> bool {\n    x < 1e-9\n}\n"), [2]);
        assert_eq!(lines(LIBRARY, "fn f() {\n    const T: f64 = 1e-9;\n}\n"), [2], "no reason");
        assert_eq!(lines(LIBRARY, "fn f(x: f64) -> bool { x < 0.0005 }\n"), [1]);
        assert_eq!(
            lines(LIBRARY, "/// D.\nconst fn f() -> f64 {\n    1e-9\n}\n"),
            [3],
            "a function is no constant"
        );
        assert_eq!(
            lines(LIBRARY, "#[cfg(test)]\nmod tests { const A: f64 = 1e-9; }\nconst B: f64 = 1e-9;\n"),
            [3]
        );
    }

    #[test]
    fn documented_constants_tests_and_large_literals_pass() {
        for source in [
            "/// Reason.\npub const T: f64 = 1e-9;\n",
            "/// Reason.\n#[allow(dead_code)]\npub(crate) const T: f64 = 1e-9;\n",
            "/// Reason.\nconst T: [(f64, [f64; 2]); 2] = [\n    (1e-9, [0.0; 2]),\n    (1e-6, [0.0; 2]),\n];\n",
            "/// Reason.\nconst T: Two = Two { a: 1e-9, b: Three { c: 1e-6 } };\n",
            "/// Reason.\nstatic T: f64 = 1e-9;\n",
            "#[cfg(test)]\nmod tests {\n    fn f() -> f64 { 1e-9 }\n}\n",
            "#[test]\nfn f() { g(1e-9); }\n",
            "fn f() -> f64 { 0.001 + 0.0 + 1e9 } // 1e-9\n",
            "fn f() -> &'static str { \"1e-9\" }\n",
        ] {
            assert_eq!(check(LIBRARY, source), [], "{source}");
        }
        for path in [
            "crates/fem/tests/a.rs",
            "benches/benches/a.rs",
            "verification/cases/a/mod.rs",
            "crates/fem/src/tests.rs",
        ] {
            assert_eq!(check(path, "fn f() -> f64 { 1e-9 }\n"), [], "{path}");
        }
    }

    #[test]
    fn unfinished_code_and_ignored_tests_are_caught_everywhere() {
        let macros = ["todo", "unimplemented"].map(|name| format!("fn f() {{ {name}!() }}\n"));
        assert_eq!(lines(LIBRARY, &macros[0]), [1]);
        assert_eq!(lines("crates/fem/tests/a.rs", &macros[1]), [1]);
        assert_eq!(lines("crates/fem/tests/a.rs", &format!("#[test]\n#[{}]\nfn f() {{}}\n", "ignore")), [2]);
        assert_eq!(lines(LIBRARY, "// a todo! in words\n"), [0usize; 0]);
    }

    #[test]
    fn unwrap_is_caught_outside_tests_only() {
        let source = "fn f() { g().unwrap(); }\n#[cfg(test)]\nmod tests { fn h() { g().unwrap(); } }\n";
        assert_eq!(lines(LIBRARY, source), [1]);
        assert_eq!(lines("verification/cases/a/mod.rs", source), [1]);
        assert_eq!(lines("crates/fem/tests/a.rs", source), [0usize; 0]);
        assert_eq!(lines(LIBRARY, "fn f() { g().unwrap_or(1); }\n"), [0usize; 0]);
    }

    #[test]
    fn files_clocks_and_printing_are_caught_in_libraries_only() {
        for line in [
            "use std::fs;",
            "use std::time::Instant;",
            "let x = std::env::var(y);",
            "eprintln!(\"x\");",
            "print!(\"x\");",
        ] {
            assert_eq!(lines("crates/contact/src/a.rs", line), [1], "{line}");
            assert_eq!(lines("crates/plan/src/a.rs", line), [0usize; 0], "{line}");
            assert_eq!(lines("crates/contact/tests/a.rs", line), [0usize; 0], "{line}");
        }
        assert_eq!(lines(LIBRARY, "let x = env!(\"A\");"), [0usize; 0]);
    }

    #[test]
    fn long_files_warn_and_longer_ones_fail() {
        let found = |lines: usize| check(LIBRARY, &"\n".repeat(lines));
        assert_eq!(found(699), []);
        assert!(found(700)[0].warning && found(1000)[0].warning);
        assert!(!found(1001)[0].warning);
    }
}
