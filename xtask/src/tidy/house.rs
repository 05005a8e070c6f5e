//! Rules about particular files: the README and the READMEs of the cases.

use super::problem::Problem;
use super::tree::File;

/// The two commands that a new user needs.
const COMMANDS: [&str; 2] = ["cargo run --release -- run scenes/sandwich.toml", "cargo xtask verify"];

/// Headings of a case's README, in this order. The harness renders them; this copy keeps xtask free of physics.
const HEADINGS: [&str; 6] = [
    "Problem",
    "Why it is here",
    "Reference and its uncertainty",
    "What is claimed",
    "What this case does not show",
    "Literature",
];

/// Checks the files that have a fixed shape.
pub fn check(files: &[File]) -> Vec<Problem> {
    let mut found = readme(files);
    let cases = files.iter().filter(|file| case_folder(&file.path).is_some());
    for module in cases.clone().filter(|file| file.path.ends_with("/mod.rs")) {
        let readme = module.path.replace("/mod.rs", "/README.md");
        if !files.iter().any(|file| file.path == readme) {
            found.push(Problem::new(&module.path, 0, format!("the case has no {readme}")));
        }
    }
    for file in cases.filter(|file| file.path.ends_with("/README.md")) {
        found.extend(headings(file));
    }
    found
}

/// The folder of a case's direct child: `verification/cases/<folder>/<file>`.
fn case_folder(path: &str) -> Option<&str> {
    let (folder, file) = path.strip_prefix("verification/cases/")?.split_once('/')?;
    (!file.contains('/')).then_some(folder)
}

fn readme(files: &[File]) -> Vec<Problem> {
    let Some(readme) = files.iter().find(|file| file.path == "README.md") else {
        return vec![Problem::new("README.md", 0, "there is no README")];
    };
    let missing = COMMANDS.iter().filter(|command| !readme.text.lines().any(|line| line.trim() == **command));
    missing.map(|command| Problem::new("README.md", 0, format!("no line says `{command}`"))).collect()
}

fn headings(file: &File) -> Vec<Problem> {
    let mut fenced = false;
    let mut found = Vec::new();
    for line in file.text.lines() {
        if line.starts_with("```") {
            fenced = !fenced;
        }
        if let (Some(heading), false) = (line.strip_prefix("## "), fenced) {
            found.push(heading.trim());
        }
    }
    if found == HEADINGS {
        return Vec::new();
    }
    vec![Problem::new(&file.path, 0, format!("the headings are {found:?}, not {HEADINGS:?}"))]
}

#[cfg(test)]
mod tests {
    use super::{COMMANDS, File, HEADINGS, check};

    fn file(path: &str, text: &str) -> File {
        File { path: path.to_owned(), text: text.to_owned() }
    }

    fn house(case: &str) -> Vec<File> {
        let readme = format!("# x\n```\n{}\n{}\n```\n", COMMANDS[0], COMMANDS[1]);
        vec![
            file("README.md", &readme),
            file("verification/cases/mod.rs", ""),
            file("verification/cases/a/mod.rs", ""),
            file("verification/cases/a/README.md", case),
        ]
    }

    fn good() -> String {
        HEADINGS.map(|heading| format!("## {heading}\n")).concat()
    }

    #[test]
    fn a_readme_without_a_command_is_caught() {
        assert_eq!(check(&house(&good())), []);
        let mut files = house(&good());
        files[0].text = files[0].text.replace("xtask verify", "test");
        assert_eq!(check(&files).len(), 1);
        assert_eq!(check(&files[1..]).len(), 1);
    }

    #[test]
    fn a_case_without_a_readme_or_with_other_headings_is_caught() {
        assert_eq!(check(&house(&good())[..3]).len(), 1);
        assert_eq!(check(&house(&good().replace("Literature", "Papers"))).len(), 1);
    }
}
