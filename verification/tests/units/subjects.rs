use asperity_verification::report::subjects::{all, parse, subject};

#[test]
fn subjects_are_the_headings_of_the_lists() {
    let found = parse("### Bodies\n<!-- cases a b -->\n| x |\n### Faults\n\n<!-- cases c -->\n");
    assert_eq!(found[0].names, ["a", "b"]);
    assert_eq!(subject(&found, "c"), "Faults");
    assert_eq!(subject(&found, "d"), "Other");
}

#[test]
fn every_case_has_a_subject() {
    let subjects = all();
    for case in asperity_verification::cases::ALL {
        assert_ne!(subject(&subjects, case.name), "Other", "{}", case.name);
    }
}
