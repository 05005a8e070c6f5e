//! Cycles of modules: files of one crate that use each other, directly or through others, and so can only be read together.

mod cycle;
mod folders;
mod modules;
pub(super) mod paths;

use super::problem::Problem;
use super::source::is_test_file;
use super::tree::File;
use crate::code::{mask, regions};
use cycle::Circle;
use modules::{Crate, Module};
use std::collections::{BTreeMap, BTreeSet};

/// Finds cycles of files, and cycles of folders.
pub fn check(files: &[File]) -> Vec<Problem> {
    let (of_files, of_folders) = circles(files);
    let of_files = of_files.iter().map(|circle| problem("files", circle));
    let of_folders = of_folders.iter().map(|circle| problem("folders", circle));
    of_files.chain(of_folders).collect()
}

fn problem(what: &str, circle: &Circle) -> Problem {
    let message =
        format!("{} {what} use each other, among them {}", circle.members.len(), circle.round.join(" -> "));
    let first = circle.members.first().map_or("", String::as_str);
    Problem::new(&format!("{}/{first}", circle.folder), 0, message)
}

fn circles(files: &[File]) -> (Vec<Circle>, Vec<Circle>) {
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
    let found = crates.into_iter().map(|(folder, modules)| crate_circles(folder, modules));
    let (of_files, of_folders): (Vec<_>, Vec<_>) = found.unzip();
    (of_files.concat(), of_folders.concat())
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

/// Cycles of the files of a crate, and those of its folders.
fn crate_circles(folder: &str, modules: Vec<(&str, Module)>) -> (Vec<Circle>, Vec<Circle>) {
    let (files, modules): (Vec<&str>, Vec<Module>) = modules.into_iter().unzip();
    let paths: Vec<Vec<String>> = modules.iter().map(|module| module.path.clone()).collect();
    let edges = Crate::new(modules).edges();
    let of_files = cycle::all(folder, &edges, |i| files[i].to_owned());
    (of_files, folders::circles(folder, &paths, &edges))
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
        circles(&files(list)).0.iter().map(|circle| circle.round.join(" -> ")).collect()
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
        // Each of the three is a folder as well.
        assert_eq!(found.len(), 2);
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
    fn folders_that_use_each_other_are_caught_although_no_files_do() {
        let list = [
            ("lib.rs", "mod a;\nmod b;\n"),
            ("a.rs", "pub mod x;\npub struct A(crate::b::y::Y);\n"),
            ("a/x.rs", "pub struct X;\n"),
            ("b/mod.rs", "pub mod y;\npub mod z;\n"),
            ("b/y.rs", "pub struct Y;\n"),
            ("b/z.rs", "use crate::a::x::X;\npub struct Z(X);\n"),
        ];
        assert_eq!(rounds(&list), [""; 0]);
        let found = check(&files(&list));
        assert_eq!(found.len(), 1);
        assert!(
            !found[0].warning
                && found[0].message.contains("2 folders use each other, among them a -> b -> a")
        );
    }

    #[test]
    fn parts_of_a_folder_within_a_folder_are_compared_with_each_other() {
        let list = [
            ("lib.rs", "mod m;\n"),
            ("m/mod.rs", "mod a;\nmod b;\n"),
            ("m/a/mod.rs", "mod x;\npub struct A;\n"),
            ("m/a/x.rs", "use crate::m::b::B;\npub struct X(B);\n"),
            ("m/b.rs", "use super::a::A;\npub struct B(A);\n"),
        ];
        assert!(check(&files(&list)).iter().any(|p| p.message.ends_with("m/a -> m/b -> m/a")));
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
