//! Cycles of modules: files of one crate that use each other, directly or through others, and so can only be read together.

mod modules;
pub(super) mod paths;

use super::problem::Problem;
use super::source::{is_test_file, mask, regions};
use super::tree::File;
use modules::{Crate, Module};
use std::collections::{BTreeMap, BTreeSet};

/// Finds cycles.
pub fn check(files: &[File]) -> Vec<Problem> {
    circles(files).iter().map(problem).collect()
}

/// A cycle: the folder of the crate's sources, the files of the cycle, sorted, and one path around it.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Circle {
    folder: String,
    files: Vec<String>,
    round: Vec<String>,
}

fn problem(circle: &Circle) -> Problem {
    let message =
        format!("{} files use each other, among them {}", circle.files.len(), circle.round.join(" -> "));
    let first = circle.files.first().map_or("", String::as_str);
    Problem::new(&format!("{}/{first}", circle.folder), 0, message)
}

fn circles(files: &[File]) -> Vec<Circle> {
    let mut crates: BTreeMap<&str, Vec<(&str, Module)>> = BTreeMap::new();
    let roots: BTreeSet<&str> = files.iter().filter_map(|file| file.path.strip_suffix("/lib.rs")).collect();
    let programs = files.iter().filter_map(|file| file.path.strip_suffix("/main.rs"));
    let roots: BTreeSet<&str> = programs.chain(roots).filter(|root| root.ends_with("src")).collect();
    for file in files.iter().filter(|file| file.path.ends_with(".rs") && !is_test_file(&file.path)) {
        let Some(root) = roots.iter().find(|root| inside(&file.path, root).is_some()) else { continue };
        let name = inside(&file.path, root).unwrap_or("");
        // A program beside a library is a crate of one file.
        if name == "main.rs" && files.iter().any(|other| other.path == format!("{root}/lib.rs")) {
            continue;
        }
        let names = paths::names(&without_tests(&file.text));
        crates.entry(root).or_default().push((name, Module { path: module_path(name), names }));
    }
    crates.into_iter().flat_map(|(folder, modules)| of_crate(folder, modules)).collect()
}

fn inside<'a>(path: &'a str, root: &str) -> Option<&'a str> {
    path.strip_prefix(root)?.strip_prefix('/')
}

/// Masked code with test items blanked.
pub(super) fn without_tests(source: &str) -> Vec<char> {
    let mut code = mask::code(source);
    for region in regions::tests(&code) {
        code[region].fill(' ');
    }
    code
}

fn module_path(name: &str) -> Vec<String> {
    let mut path: Vec<String> = name.trim_end_matches(".rs").split('/').map(str::to_owned).collect();
    let last = path.last().map_or("", String::as_str);
    if last == "mod" || path.len() == 1 && (last == "lib" || last == "main") {
        path.pop();
    }
    path
}

fn of_crate(folder: &str, modules: Vec<(&str, Module)>) -> Vec<Circle> {
    let (files, modules): (Vec<&str>, Vec<Module>) = modules.into_iter().unzip();
    let edges = Crate::new(modules).edges();
    let reached: Vec<BTreeSet<usize>> = (0..files.len()).map(|from| reached(&edges, from)).collect();
    let mut found = Vec::new();
    for from in 0..files.len() {
        let circle: Vec<usize> = (0..files.len())
            .filter(|&to| reached[from].contains(&to) && reached[to].contains(&from))
            .collect();
        if circle.first() == Some(&from) {
            let round = round(&edges, from).into_iter().map(|i| files[i].to_owned()).collect();
            let files = circle.into_iter().map(|i| files[i].to_owned()).collect();
            found.push(Circle { folder: folder.to_owned(), files, round });
        }
    }
    found
}

/// Modules reachable from a module; it includes itself only if it lies on a cycle.
fn reached(edges: &[BTreeSet<usize>], from: usize) -> BTreeSet<usize> {
    let mut found = BTreeSet::new();
    let mut left: Vec<usize> = edges[from].iter().copied().collect();
    while let Some(next) = left.pop() {
        if found.insert(next) {
            left.extend(&edges[next]);
        }
    }
    found
}

/// Shortest path from a module back to itself.
fn round(edges: &[BTreeSet<usize>], from: usize) -> Vec<usize> {
    let mut ways = vec![vec![from]];
    let mut seen = BTreeSet::new();
    loop {
        let mut longer = Vec::new();
        for way in &ways {
            for &next in way.last().map_or(&BTreeSet::new(), |&last| &edges[last]) {
                let way = || way.iter().copied().chain([next]).collect();
                if next == from {
                    return way();
                }
                if seen.insert(next) {
                    longer.push(way());
                }
            }
        }
        if longer.is_empty() {
            return Vec::new();
        }
        ways = longer;
    }
}

#[cfg(test)]
mod tests {
    use super::{check, circles};
    use crate::tidy::tree::File;

    fn files(list: &[(&str, &str)]) -> Vec<File> {
        list.iter()
            .map(|(path, text)| File { path: format!("crates/x/src/{path}"), text: (*text).to_owned() })
            .collect()
    }

    fn rounds(list: &[(&str, &str)]) -> Vec<String> {
        circles(&files(list)).iter().map(|circle| circle.round.join(" -> ")).collect()
    }

    #[test]
    fn a_planted_circle_is_caught_and_named() {
        let planted = [
            ("lib.rs", "mod a;\nmod b;\nmod c;\n"),
            ("a.rs", "use crate::b::B;\npub struct A(B);\n"),
            ("b.rs", "pub struct B;\nfn f() { super::c::g() }\n"),
            ("c.rs", "use super::a;\npub fn g() -> a::A {}\n"),
        ];
        assert_eq!(rounds(&planted), ["a.rs -> b.rs -> c.rs -> a.rs"]);
        let found = check(&files(&planted));
        assert_eq!(found.len(), 1);
        assert!(
            found[0].message.contains("3 files") && found[0].message.contains("a.rs -> b.rs -> c.rs -> a.rs")
        );
    }

    #[test]
    fn names_passed_on_count_for_the_file_that_defines_them() {
        // The folder re-exports `A`, and `b` imports it from there: no cycle, although the folder names both.
        let passed = [
            ("lib.rs", "mod m;\n"),
            ("m/mod.rs", "mod a;\nmod b;\npub use a::*;\npub use b::B;\n"),
            ("m/a.rs", "pub struct A;\n"),
            ("m/b.rs", "use super::A;\npub struct B(A);\n"),
        ];
        assert_eq!(rounds(&passed), [""; 0]);
        // A re-export is not a use.
        let facade = [
            ("lib.rs", "mod m;\n"),
            ("m/b.rs", "use super::M;\npub struct B(M);\n"),
            ("m/mod.rs", "mod b;\npub use b::B;\npub struct M;\n"),
        ];
        assert_eq!(rounds(&facade), [""; 0]);
        // The folder uses an item of its file, and the file uses an item of its folder.
        let mutual = [
            ("lib.rs", "mod m;\n"),
            ("m/a.rs", "use super::M;\npub fn g() {}\n"),
            ("m/mod.rs", "mod a;\npub struct M;\nfn f() { a::g() }\n"),
        ];
        assert_eq!(rounds(&mutual), ["m/a.rs -> m/mod.rs -> m/a.rs"]);
    }

    #[test]
    fn names_of_other_crates_that_are_passed_on_count_for_nothing() {
        let list = [
            ("lib.rs", "mod a;\nmod b;\n"),
            ("a.rs", "pub use other::Name;\nuse crate::b::B;\npub struct A(B);\n"),
            ("b.rs", "use crate::a::Name;\npub struct B(Name);\n"),
        ];
        assert_eq!(rounds(&list), [""; 0]);
    }

    #[test]
    fn tests_and_comments_close_no_circle() {
        let list = [
            ("lib.rs", "mod a;\nmod b;\n"),
            (
                "a.rs",
                "//! See [`crate::b::B`].\npub struct A;\n#[cfg(test)]\nmod tests { use crate::b::B; }\n",
            ),
            ("b.rs", "use crate::a::A;\npub struct B(A);\n"),
        ];
        assert_eq!(rounds(&list), [""; 0]);
    }
}
