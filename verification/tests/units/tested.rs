use asperity_verification::report::test_files::{checks, groups, tests};

#[test]
fn names_of_tests_are_read_as_sentences() {
    let text = "    #[test]\n    fn a_scene_is_refused() {\n    #[test]\n#[cfg(x)]\nfn b() {";
    assert_eq!(tests(text), ["a scene is refused", "b"]);
    assert_eq!(checks("def check_field(path):\ndef other():\n"), ["check of field"]);
}

#[test]
fn every_group_has_tests() {
    for group in groups() {
        assert!(group.count() > 3, "{:?} has {} tests", group.capability, group.count());
    }
}
