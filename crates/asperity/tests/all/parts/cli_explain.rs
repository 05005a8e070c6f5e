use asperity::cli::explain::*;

#[test]
fn markdown_becomes_plain_text() {
    assert_eq!(plain("A [friction law](laws.md) of `kind`."), "A friction law of `kind`.");
    assert_eq!(plain("Direction `[x, y, z]`, \\[m\\]."), "Direction `[x, y, z]`, [m].");
}

#[test]
fn long_text_is_folded_below_its_beginning() {
    let text = folded("  key: ", &"word ".repeat(40));
    assert!(text.lines().count() == 3 && text.lines().all(|line| line.chars().count() <= WIDTH), "{text}");
    assert!(text.lines().nth(1).unwrap().starts_with("       word"), "{text}");
}
