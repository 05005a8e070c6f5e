use asperity_reference::benchmark::*;

#[test]
fn every_reference_is_read_and_sound() {
    assert_eq!(all().len(), TEXTS.len());
    for reference in all() {
        assert_eq!(reference.problems(), Vec::<String>::new(), "{}", reference.benchmark);
    }
}
