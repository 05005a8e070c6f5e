use asperity_verification::report::sources::{files, includes};

#[test]
fn scenes_that_a_program_includes_are_found() {
    assert_eq!(includes("x = include_str!(\"../a.toml\"); include_str!(\"README.md\")"), ["../a.toml"]);
}

#[test]
fn sources_of_every_case_are_at_hand() {
    for case in asperity_verification::cases::ALL {
        assert!(files(case).keys().any(|path| path.ends_with("mod.rs")), "{}", case.name);
    }
}
