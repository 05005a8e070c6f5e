//! Rule that libraries of values share one clippy configuration, which forbids files, clocks and printing.

use super::graph::LIBRARIES;
use super::problem::Problem;
use super::tree::File;

/// The configuration that the others copy: clippy reads one file per package and has no includes.
const FIRST: &str = "crates/fem/clippy.toml";

/// Checks that every library of values has the same configuration as the first.
pub fn check(files: &[File]) -> Vec<Problem> {
    let text = |path: &str| files.iter().find(|file| file.path == path).map(|file| file.text.as_str());
    let first = text(FIRST);
    let paths = LIBRARIES.map(|name| format!("crates/{}/clippy.toml", name.trim_start_matches("asperity-")));
    let others = paths.iter().filter(|path| first.is_none() || text(path) != first);
    others
        .map(|path| Problem::new(path, 0, format!("a library of values has the lints of {FIRST}")))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::{File, LIBRARIES, check};

    #[test]
    fn a_library_with_other_lints_or_none_is_caught() {
        let file = |name: &str| File {
            path: format!("crates/{}/clippy.toml", name.trim_start_matches("asperity-")),
            text: "disallowed-macros = []\n".to_owned(),
        };
        let mut files: Vec<File> = LIBRARIES.into_iter().map(file).collect();
        assert_eq!(check(&files), []);
        assert_eq!(check(&files[..LIBRARIES.len() - 1]).len(), 1);
        files[0].text.clear();
        assert_eq!(check(&files).len(), 1);
        assert_eq!(check(&[]).len(), LIBRARIES.len());
    }
}
