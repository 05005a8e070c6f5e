//! Required structure of a case's README, which is shown on its page of the report.

/// Second-level headings of every case README: exactly these, in this order.
pub const HEADINGS: [&str; 6] = [
    "Problem",
    "Why it is here",
    "Reference and its uncertainty",
    "What is claimed",
    "What this case does not show",
    "Literature",
];

/// Problems of a README, one sentence each; empty if there are none.
pub fn problems(text: &str) -> Vec<String> {
    let mut found = Vec::new();
    if !text.starts_with("# ") {
        found.push("the first line is not a title (`# ...`)".to_owned());
    }
    let sections = sections(text);
    let headings: Vec<&str> = sections.iter().map(|(heading, _)| *heading).collect();
    if headings != HEADINGS {
        found.push(format!("its `##` headings are {headings:?}, not {HEADINGS:?}"));
    }
    for (heading, body) in sections {
        if body.iter().all(|line| line.trim().is_empty()) {
            found.push(format!("the section `## {heading}` is empty"));
        }
    }
    found
}

/// Title, the text of the first-level heading; empty if there is none.
pub fn title(text: &str) -> &str {
    text.lines().find_map(|line| line.strip_prefix("# ")).unwrap_or("").trim()
}

/// Second-level headings with the lines below each; headings in fenced blocks are ignored.
fn sections(text: &str) -> Vec<(&str, Vec<&str>)> {
    let mut sections: Vec<(&str, Vec<&str>)> = Vec::new();
    let mut fenced = false;
    for line in text.lines() {
        if line.starts_with("```") {
            fenced = !fenced;
        }
        match line.strip_prefix("## ") {
            Some(heading) if !fenced => sections.push((heading.trim(), Vec::new())),
            _ => {
                if let Some((_, body)) = sections.last_mut() {
                    body.push(line);
                }
            }
        }
    }
    sections
}
