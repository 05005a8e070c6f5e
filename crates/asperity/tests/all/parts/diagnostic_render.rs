use asperity_plan::reading::diagnostic::render::*;
use asperity_plan::reading::diagnostic::{Diagnostic, Diagnostics, line_column};

fn rendered(text: &str, errors: Vec<Diagnostic>) -> String {
    let report = format!("{:?}", report("s.toml", text, &Diagnostics(errors)));
    assert!(report.lines().all(|line| line.chars().count() < 2 * LONGEST_LINE), "{report}");
    report
}

#[test]
fn a_place_far_along_a_line_is_shown_with_what_stands_around_it() {
    for column in [100, 1000, 65_534, 65_535, 65_536, 70_000, 200_000] {
        let text = format!("schema = 1\ntitle = \"{}µ\" wrong # and so on\nnext = 2\n", "x".repeat(column));
        let at = text.find("wrong").unwrap();
        let shown = rendered(&text, vec![Diagnostic::at(at..at + 5, "what is wrong", "what is right")]);
        let place = line_column(&text, at);
        // The title, its quotes, the key and the character of two bytes stand before it.
        assert_eq!(place, (2, column + 9 + 1 + 2 + 1));
        assert!(shown.contains(&format!("s.toml:2:{}", place.1)), "{shown}");
        assert!(shown.contains("wrong # and so on"), "{shown}");
    }
}

#[test]
fn long_lines_beside_the_place_are_left_out_and_long_places_are_cut() {
    let long = "é".repeat(40_000);
    let text = format!("# {long}\nwrong = 1\n# {long}\nlist = [{long}]\n");
    let (first, list) = (text.find("wrong").unwrap(), text.find('[').unwrap());
    let error = Diagnostic::at(first..first + 5, "first", "").and(list..text.len() - 1, "second");
    let shown = rendered(&text, vec![error.clone()]);
    assert!(shown.contains("s.toml:2:1") && shown.contains("list = [éé"), "{shown}");
    assert!(rendered(&text, vec![error.clone(), error]).contains("2 errors"));
}
