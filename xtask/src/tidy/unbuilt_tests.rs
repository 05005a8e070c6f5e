//! Rule that a library without a build for tests has none in its sources: nothing would run them.

use super::problem::Problem;
use super::tree::File;
use crate::code::mask;

/// Marks of tests.
const MARKS: [&str; 2] = ["#[cfg(test)]", "#[test]"];

/// Checks the sources beside each manifest that builds no tests of its library.
pub fn check(files: &[File]) -> Vec<Problem> {
    let folders = files.iter().filter_map(|file| {
        let folder = file.path.strip_suffix("Cargo.toml")?;
        (!tested(&file.text)).then_some(folder)
    });
    let beside = |folder: &str| {
        let sources = format!("{folder}src/");
        files.iter().filter(move |file| file.path.starts_with(&sources) && file.path.ends_with(".rs"))
    };
    folders.flat_map(beside).flat_map(marked).collect()
}

/// True unless a manifest builds no tests of its library.
fn tested(manifest: &str) -> bool {
    let manifest: toml::Table = manifest.parse().unwrap_or_default();
    let test = manifest.get("lib").and_then(|lib| lib.get("test"));
    test.and_then(toml::Value::as_bool).unwrap_or(true)
}

/// Tests of a source.
fn marked(file: &File) -> impl Iterator<Item = Problem> {
    let code: String = mask::code(&file.text).into_iter().collect();
    let lines: Vec<usize> = code
        .lines()
        .enumerate()
        .filter(|(_, line)| MARKS.iter().any(|mark| line.contains(mark)))
        .map(|(at, _)| at + 1)
        .collect();
    let message = "a test that is never built: the library has `test = false`; move it to `tests`";
    lines.into_iter().map(move |line| Problem::new(&file.path, line, message))
}

#[cfg(test)]
mod tests {
    use super::{File, check};

    fn file(path: &str, text: &str) -> File {
        File { path: path.into(), text: text.into() }
    }

    #[test]
    fn a_test_in_a_library_without_tests_is_caught() {
        let source = "fn f() {}\n// #[test] in words\n#[cfg(test)]\nmod tests {}\n";
        let files = [
            file("crates/a/Cargo.toml", "[lib]\ntest = false\n"),
            file("crates/a/src/lib.rs", source),
            file("crates/a/tests/all.rs", source),
            file("crates/b/Cargo.toml", "[lib]\nname = \"b\"\n[[bin]]\nname = \"c\"\ntest = false\n"),
            file("crates/b/src/lib.rs", source),
        ];
        let lines: Vec<_> = check(&files).into_iter().map(|p| (p.path, p.line)).collect();
        assert_eq!(lines, [("crates/a/src/lib.rs".into(), 3)]);
    }
}
