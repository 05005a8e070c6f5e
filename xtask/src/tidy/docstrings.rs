//! Rule that documentation comments begin with a noun or a verb.

use super::problem::Problem;

/// Words that begin a clause where a noun or a verb should name the thing.
const CLAUSES: [&str; 9] = ["What", "Where", "Whether", "When", "How", "Who", "Why", "That", "So"];

/// Checks the first line of each documentation comment of a source, and of each section of one.
pub fn check(path: &str, text: &str) -> Vec<Problem> {
    let (mut found, mut begins) = (Vec::new(), true);
    for (number, line) in text.lines().enumerate() {
        let line = line.trim_start();
        let Some(words) = line.strip_prefix("///").or_else(|| line.strip_prefix("//!")) else {
            begins = true;
            continue;
        };
        let first = words.trim_start().split(|c: char| !c.is_alphabetic()).next().unwrap_or_default();
        if begins && CLAUSES.contains(&first) {
            let message =
                format!("a documentation comment begins with a noun or a verb, not with \"{first}\"");
            found.push(Problem::new(path, number + 1, message));
        }
        begins = words.trim().is_empty() || words.trim_start().starts_with('#');
    }
    found
}

#[cfg(test)]
mod tests {
    use super::check;

    #[test]
    fn clauses_are_caught_at_the_beginning_and_not_within() {
        let text = "/// What it holds.\n/// Where it lies:\nfn f() {}\n\n/// # Errors\n/// When it fails.\nfn g() {}\n/// Position.\n";
        let lines: Vec<usize> = check("a.rs", text).iter().map(|problem| problem.line).collect();
        assert_eq!(lines, [1, 6]);
    }
}
