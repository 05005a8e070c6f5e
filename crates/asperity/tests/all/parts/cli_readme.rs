use asperity::cli::entries::*;
use std::ffi::OsStr;

const PAGE: &str = include_str!("../../../../../docs/src/outputs.md");

#[test]
fn every_file_that_runs_write_is_known_once_and_on_the_page_of_outputs() {
    for (k, entry) in all().iter().enumerate() {
        let name = entry.name.split('*').collect::<Vec<_>>().join("main");
        let known = named(OsStr::new(&name)).unwrap();
        assert_eq!(known.name, entry.name, "{name}");
        assert!(all()[..k].iter().all(|other| other.name != entry.name), "{name}");
        let hidden = entry.name.starts_with('.') || entry.name == "Thumbs.db";
        let begin = entry.name.split('*').next().unwrap();
        assert!(hidden || PAGE.contains(begin), "{} is not on the page of outputs", entry.name);
    }
}
