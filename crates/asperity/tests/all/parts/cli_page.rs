use asperity::cli::begin::PAGE;
use asperity::cli::page::elements::{escape, number, value};
use asperity::cli::page::{Texts, page, write};
use serde_json::json;

#[test]
fn numbers_have_six_digits() {
    let found = [0.0, 1.0, 0.1 + 0.2, -2.5e-3, 1e7, 123_456_789.0, 6.62607015e-34, f64::NAN].map(number);
    assert_eq!(found, ["0", "1", "0.3", "-0.0025", "1e7", "1.23457e8", "6.62607e-34", "NaN"]);
    assert_eq!([99.99999, 999_999.96].map(number), ["100", "1000000"]);
}

#[test]
fn values_become_tables_of_their_keys() {
    assert_eq!(escape("a < b & \"c\""), "a &lt; b &amp; &quot;c&quot;");
    assert_eq!(value(&json!([1, 2.5, null, true])), "1, 2.5, none, yes");
    let html = value(&json!([{ "first_key": 1 }, { "other": "<x>" }]));
    assert_eq!(html.matches("<tr>").count(), 3, "{html}");
    assert!(html.contains("<th>first key</th>") && html.contains("<td>&lt;x&gt;</td>"), "{html}");
    let many: Vec<_> = (0..300).map(|k| json!({ "k": k })).collect();
    assert!(value(&json!(many)).contains("and 100 more"));
}

#[test]
fn a_page_has_what_its_directory_has() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("plots")).unwrap();
    std::fs::write(folder.path().join("plots/slip.svg"), "<svg><rect/></svg>").unwrap();
    std::fs::write(folder.path().join("plots/slip.png"), "no text").unwrap();
    std::fs::write(folder.path().join("events.csv"), "onset [s],surface\n1.23456789e9,main\n").unwrap();
    let warning = json!({ "message": "cells > zone", "help": "refine", "place": { "line": 7, "column": 1 } });
    let report = json!({ "title": "a < b", "kind": "faults", "status": "stopped", "warnings": [warning],
        "outcome": { "stopped": { "reason": "no state" } }, "counts": { "steps": 12 } });
    let texts = Texts { plan: "plan of & all", scene: "title = \"a < b\"" };
    write(folder.path(), &report, &texts).unwrap();
    let html = std::fs::read_to_string(folder.path().join(PAGE)).unwrap();
    for part in [
        "<title>a &lt; b</title>",
        "<strong>stopped</strong>",
        "no state",
        "line 7: <span class=\"warning\">cells &gt; zone</span>; refine",
        "<svg><rect/></svg><figcaption>",
        "<td class=\"number\">1.23457e9</td><td>main</td>",
        "<tr><th>steps</th><td class=\"number\">12</td></tr>",
        "plan of &amp; all",
        "title = &quot;a &lt; b&quot;",
        "<a href=\"events.csv\">events.csv</a>: catalogue of events",
    ] {
        assert!(html.contains(part), "{part} is not in {html}");
    }
    assert!(!html.contains("no text") && !html.contains("<h2>Energy</h2>"));
}

#[test]
fn a_page_of_an_empty_directory_is_a_page() {
    let html = page(std::path::Path::new("nowhere"), &json!({}), &Texts { plan: "", scene: "" });
    assert!(html.starts_with("<!doctype html>") && html.ends_with("</html>\n"), "{html}");
}
