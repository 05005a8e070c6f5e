//! Rules about every text file.

use super::problem::Problem;

/// Kinds of files that people write; others (snapshots, tables, pictures) come from programs and are not checked.
const WRITTEN: [&str; 12] =
    [".rs", ".toml", ".md", ".py", ".sh", ".yml", ".yaml", ".cff", ".css", "/run", ".gitignore", ".geo"];

/// Checks one file.
pub fn check(path: &str, text: &str) -> Vec<Problem> {
    let mut found = leads_outside(path, text);
    found.extend(unmerged(path, text));
    if WRITTEN.iter().any(|kind| path.ends_with(kind)) {
        found.extend(line_ends(path, text));
    }
    found
}

/// Refuses paths that lead outside the product. The words are assembled here, so that this file does not contain them.
fn leads_outside(path: &str, text: &str) -> Vec<Problem> {
    let names =
        [["..", "shared"].join("/"), ["", "work", "shared"].join("/"), ["", "work", "main"].join("/")];
    let mut found = Vec::new();
    for (number, line) in text.lines().enumerate() {
        if let Some(name) = names.iter().find(|name| line.contains(name.as_str())) {
            found.push(Problem::new(path, number + 1, format!("the path {name} is outside the workspace")));
        }
    }
    found
}

/// Refuses conflict markers of a merge; assembled here for the same reason.
fn unmerged(path: &str, text: &str) -> Vec<Problem> {
    let marks = ["<", ">"].map(|mark| mark.repeat(7) + " ");
    let lines = text.lines().enumerate();
    let marked = lines.filter(|(_, line)| marks.iter().any(|mark| line.starts_with(mark.as_str())));
    marked
        .map(|(number, _)| Problem::new(path, number + 1, "a conflict of a merge that was not resolved"))
        .collect()
}

fn line_ends(path: &str, text: &str) -> Vec<Problem> {
    let mut found = Vec::new();
    for (number, line) in text.split('\n').enumerate() {
        if line.ends_with('\r') {
            found.push(Problem::new(path, number + 1, "the line ends with a carriage return"));
        } else if line.ends_with([' ', '\t']) {
            found.push(Problem::new(path, number + 1, "white space at the end of the line"));
        }
    }
    if !text.is_empty() && !text.ends_with('\n') {
        found.push(Problem::new(path, text.lines().count(), "the last line has no line end"));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::check;

    #[test]
    fn paths_that_lead_outside_are_caught_in_any_text() {
        let text = format!("fine\nsee {}/DESIGN.md\n", ["..", "shared"].join("/"));
        assert_eq!(check("docs/a.svg", &text)[0].line, 2);
        assert_eq!(check("a.rs", &format!("// {}/x\n", ["", "work", "shared"].join("/"))).len(), 1);
        assert_eq!(check("a.rs", "// a shared folder\n"), []);
    }

    #[test]
    fn marks_of_merges_are_caught() {
        let text = format!("a\n{} HEAD\nb\n{} c\n", "<".repeat(7), ">".repeat(7));
        assert_eq!(check("a.md", &text).len(), 2);
    }

    #[test]
    fn line_ends_are_checked_in_written_files_only() {
        let text = "a \nb\r\nc\t\nd";
        let lines: Vec<usize> = check("a.md", text).iter().map(|problem| problem.line).collect();
        assert_eq!(lines, [1, 2, 3, 4]);
        assert_eq!(check("a.csv", text), []);
    }
}
