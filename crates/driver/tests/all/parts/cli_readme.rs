use asperity_driver::cli::contents;
use asperity_driver::cli::readme::*;

#[test]
fn every_file_that_runs_write_has_a_meaning() {
    for name in contents::names().filter(|name| !["Thumbs.db", ".DS_Store"].contains(name)) {
        assert!(meaning(name).is_some(), "{name}");
    }
    assert_eq!(meaning("events_main.csv"), meaning("events_*.csv"));
}
