//! Numbers that users read, on the page of coverage: which claims would notice a wrong one.

use super::page::escape;
use crate::case::Outcome;
use crate::numbers::Number;
use std::fmt::Write as _;

/// The section about all numbers.
pub fn section(numbers: &[Number], outcomes: &[Outcome]) -> String {
    let without = numbers.iter().filter(|number| number.held(outcomes).is_empty()).count();
    let mut body = format!(
        "<h2 id=\"numbers\">Numbers in files</h2>\n<p>Columns and entries of the files of a run, and the claims of this run that \
         would notice a wrong one. Of {} numbers {without} have no evidence.</p>\n",
        numbers.len()
    );
    for of_file in numbers.chunk_by(|a, b| (&a.kind, &a.file) == (&b.kind, &b.file)) {
        let Number { kind, file, .. } = &of_file[0];
        let rows: String = of_file.iter().map(|number| row(number, outcomes)).collect();
        let _ = writeln!(
            body,
            "<section class=\"covered\"><h4>{}: {}</h4><dl>{rows}</dl></section>",
            escape(kind),
            escape(file)
        );
    }
    body
}

fn row(number: &Number, outcomes: &[Outcome]) -> String {
    let held = number.held(outcomes);
    let cases: Vec<String> = held
        .iter()
        .map(|(case, count)| {
            format!("<a href=\"cases/{case}.html\">{case}</a> <b class=\"good\">{count}</b>")
        })
        .collect();
    let cases = if cases.is_empty() {
        "<span class=\"none\">no evidence</span>".to_owned()
    } else {
        cases.join(", ")
    };
    format!("<div><dt>{}</dt><dd>{cases}</dd></div>\n", escape(&number.name))
}
