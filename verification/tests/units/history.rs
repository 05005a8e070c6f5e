use asperity_verification::report::history::*;
use std::collections::BTreeMap;

fn release(tag: &str, wall: f64, pairs: &[(&str, f64, f64)]) -> Release {
    let claims = pairs.iter().map(|(id, e, b)| ((*id).to_owned(), (Some(*e), Some(*b)))).collect();
    let cases = BTreeMap::from([("c".to_owned(), KeptCase { wall, claims })]);
    Release { schema: SCHEMA, tag: tag.to_owned(), cases, ..Release::default() }
}

#[test]
fn a_release_is_read_as_it_was_written() {
    let kept = release("v0.1.0", 3.0, &[("a", 1e-9, 1e-8), ("b", 0.5, 1.0)]);
    let text = kept.text().unwrap();
    assert_eq!(serde_json::from_str::<Release>(&text).unwrap(), kept);
    assert!(text.lines().any(|line| line.trim() == "\"a\": [1e-9,1e-8],"), "{text}");
}

#[test]
fn releases_are_sorted_by_number() {
    assert!(version("v0.9.1") < version("v0.10.0"));
}

#[test]
fn changed_bounds_grown_errors_and_lost_claims_are_listed() {
    let before = release("v1", 3.0, &[("a", 0.5, 1.0), ("b", 1e-9, 1.0), ("gone", 0.5, 1.0)]);
    let now = release("now", 9.0, &[("a", 0.55, 2.0), ("b", 1e-8, 1.0), ("new", 0.5, 1.0)]);
    let mut changes = Changes::default();
    changes.add("c", &before.cases["c"], &now.cases["c"]);
    assert_eq!(changes.bounds.len(), 1);
    assert_eq!((changes.bounds[0].before, changes.bounds[0].now), (1.0, 2.0));
    assert!(changes.errors.is_empty(), "errors far below their bounds are noise");
    assert_eq!((changes.costs.len(), changes.new), (1, 1));
    assert_eq!(changes.gone, [("c".to_owned(), "gone".to_owned())]);
}
