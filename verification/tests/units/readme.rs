use asperity_verification::readme::{HEADINGS, problems, title};

fn good() -> String {
    let body: Vec<String> = HEADINGS.iter().map(|h| format!("## {h}\nText.\n")).collect();
    format!("# A title\n\n{}", body.join("\n"))
}

#[test]
fn the_fixed_headings_pass() {
    assert_eq!(problems(&good()), Vec::<String>::new());
    assert_eq!(title(&good()), "A title");
}

/// The good text with one line changed, which it holds once.
fn with(line: &str, other: &str) -> String {
    let text = good();
    let (before, after) = text.split_once(line).unwrap();
    format!("{before}{other}{after}")
}

#[test]
fn a_missing_reordered_or_empty_section_is_named() {
    assert!(problems(&with("## Literature\n", "## Papers\n"))[0].contains("Papers"));
    assert_eq!(problems(&with("## Problem\nText.", "## Problem\n")).len(), 1);
    assert_eq!(problems(&with("# A title", "A title")).len(), 1);
}
