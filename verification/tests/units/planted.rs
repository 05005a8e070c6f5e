use asperity_verification::report::defects::{Defects, Definition, Result, whole};
use asperity_verification::report::provenance::Provenance;
use serde_json::json;

#[test]
fn results_of_the_repository_are_read() {
    let defects = Defects::read();
    assert!(!defects.results.is_empty());
    assert!(defects.results.keys().all(|name| defects.definitions.contains_key(name)));
    let found = serde_json::from_value::<Result>(
        json!({ "status": "ran", "noticed": [{ "case": "hertz_line", "claim": "p", "margin": 6.0 }] }),
    );
    assert_eq!(found.unwrap().by_case()["hertz_line"], (1, 6.0));
}

#[test]
fn the_page_tells_what_was_noticed_and_what_was_not() {
    let mut defects = Defects::default();
    let words = Definition { wrong: "the sign is lost".into(), ..Definition::default() };
    defects.definitions.insert("sign".into(), words);
    assert!(whole(&defects, &Provenance::default()).contains("no result yet"));
    let missed = Result { status: "ran".into(), noticed: Vec::new() };
    defects.results.insert("sign".into(), missed);
    let page = whole(&defects, &Provenance::default());
    assert!(page.contains("not noticed") && page.contains("The sign is lost."));
}
