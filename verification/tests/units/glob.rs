use asperity_verification::glob::matches;

#[test]
fn stars_match_any_run_and_question_marks_one_character() {
    for (pattern, name, expected) in [
        ("*", "sandwich", true),
        ("", "", true),
        ("", "a", false),
        ("sand*", "sandwich", true),
        ("*wich", "sandwich", true),
        ("s*w*h", "sandwich", true),
        ("s?ndwich", "sandwich", true),
        ("s?", "sandwich", false),
        ("*x*", "sandwich", false),
        ("*ab", "aab", true),
    ] {
        assert_eq!(matches(pattern, name), expected, "{pattern} {name}");
    }
}
