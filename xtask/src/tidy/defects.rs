//! Rules about planted defects: each text that they change occurs once in the source, each case that they name exists,
//! and a claim detected each when it was last run.

use super::problem::Problem;
use super::tree::File;
use crate::defects::{Defect, FOLDER, RESULTS, Results};

/// Checks the defects against the files of the workspace.
pub fn check(files: &[File]) -> Vec<Problem> {
    let mut found = outcomes(files);
    for file in files.iter().filter(|f| f.path.starts_with(FOLDER) && f.path.ends_with(".toml")) {
        match Defect::read(&file.path, &file.text) {
            Ok(defect) => found.extend(misfits(&defect, files)),
            Err(error) => found.push(Problem::new(&file.path, 0, format!("no defect: {}", error.message()))),
        }
    }
    found
}

/// Checks that the stored results belong to the defects, and that each was detected.
fn outcomes(files: &[File]) -> Vec<Problem> {
    let text = files.iter().find(|f| f.path == RESULTS).map_or("{}", |f| f.text.as_str());
    let results = match Results::parse(text) {
        Ok(results) => results,
        Err(error) => return vec![Problem::new(RESULTS, error.line(), format!("no results: {error}"))],
    };
    let path = |name: &str| format!("{FOLDER}/{name}.toml");
    let exists = |name: &str| files.iter().any(|f| f.path == path(name));
    let mut found = Vec::new();
    for name in results.names().filter(|name| !exists(name)) {
        found.push(Problem::new(RESULTS, 0, format!("there is no defect `{name}`")));
    }
    for file in files {
        let name = file.path.strip_prefix(FOLDER).and_then(|p| p.strip_prefix('/')?.strip_suffix(".toml"));
        match name.map(|name| results.get(name)) {
            // A run takes minutes, so that a defect may have none for a while.
            Some(None) => {
                let message = "it has not been run yet: run `cargo xtask defects`";
                found.push(Problem { warning: true, ..Problem::new(&file.path, 0, message) });
            }
            Some(Some(outcome)) if !outcome.is_noticed() => {
                found.push(Problem::new(&file.path, 0, "no claim detects it: add one"));
            }
            _ => {}
        }
    }
    found
}

fn misfits(defect: &Defect, files: &[File]) -> Vec<Problem> {
    let mut found = Vec::new();
    let mut problem = |message: String| found.push(Problem::new(&defect.name, 0, message));
    if defect.change.is_empty() || defect.wrong.is_empty() || defect.why.is_empty() {
        problem("a defect says what is wrong and why, and changes something".into());
    }
    for change in &defect.change {
        let file = files.iter().find(|f| f.path == change.file);
        if file.and_then(|f| change.applied(&f.text)).is_none() {
            problem(format!("its old text does not occur exactly once in {}", change.file));
        }
    }
    for case in &defect.expected {
        let readme = format!("verification/cases/{case}/README.md");
        if !files.iter().any(|f| f.path == readme) {
            problem(format!("there is no case `{case}`"));
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::{File, check};

    fn problems(old: &str, case: &str) -> usize {
        let outcome = r#"{ "commit": "", "status": "ran", "cases": [],
            "noticed": [{ "case": "hertz_line", "claim": "p", "margin": 2.0 }] }"#;
        with_results(old, case, &format!("{{ \"d\": {outcome} }}"))
    }

    fn with_results(old: &str, case: &str, results: &str) -> usize {
        let file = |path: &str, text: &str| File { path: path.into(), text: text.into() };
        let defect = format!(
            "wrong = \"w\"\nwhy = \"y\"\nexpected = [\"{case}\"]\n[[change]]\nfile = \"a.rs\"\nold = \"{old}\"\nnew = \"n\"\n"
        );
        let files = [
            file("a.rs", "one two two\n"),
            file("verification/cases/hertz_line/README.md", "# Hertz\n"),
            file("verification/defects/d.toml", &defect),
            file("verification/defects/results.json", results),
        ];
        check(&files).iter().filter(|problem| !problem.warning).count()
    }

    #[test]
    fn a_text_that_occurs_not_or_twice_and_an_unknown_case_are_found() {
        assert_eq!(problems("one", "hertz_line"), 0);
        assert_eq!(problems("three", "hertz_line"), 1);
        assert_eq!(problems("two", "hertz_line"), 1);
        assert_eq!(problems("one", "hertz"), 1);
    }

    #[test]
    fn a_defect_that_was_not_noticed_and_a_result_of_none_are_found() {
        let outcome = r#"{ "commit": "", "status": "ran", "cases": [], "noticed": [] }"#;
        assert_eq!(with_results("one", "hertz_line", "{}"), 0);
        assert_eq!(with_results("one", "hertz_line", &format!("{{ \"d\": {outcome} }}")), 1);
        assert_eq!(with_results("one", "hertz_line", &format!("{{ \"e\": {outcome} }}")), 1);
        assert_eq!(with_results("one", "hertz_line", "[]"), 1);
    }
}
