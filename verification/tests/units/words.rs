use asperity_verification::claim::Evidence;
use asperity_verification::report::words::WORDS;

#[test]
fn every_kind_of_evidence_is_explained() {
    for kind in Evidence::ALL {
        assert!(WORDS.iter().any(|(anchor, ..)| *anchor == kind.name()), "{}", kind.name());
    }
}
