//! Every case of the list has the fixed shape.
#![allow(clippy::unwrap_used, reason = "tests")]

use asperity_verification::{cases, readme};
use std::collections::BTreeSet;
use std::path::Path;

#[test]
fn every_folder_is_in_the_list_and_the_list_names_folders() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
    let folders: BTreeSet<String> = std::fs::read_dir(root)
        .unwrap()
        .map(|entry| entry.unwrap())
        .filter(|entry| entry.file_type().unwrap().is_dir())
        .map(|entry| entry.file_name().into_string().unwrap())
        .collect();
    let names: BTreeSet<String> = cases::ALL.iter().map(|case| case.name.to_owned()).collect();
    assert_eq!(names, folders);
    assert_eq!(names.len(), cases::ALL.len(), "a name stands twice in the list");
}

#[test]
fn every_case_has_the_fixed_headings_and_covers_something() {
    for case in cases::ALL {
        assert_eq!(readme::problems(case.readme), Vec::<String>::new(), "{}", case.name);
        assert!(!case.covers.is_empty(), "{} covers nothing", case.name);
    }
}
