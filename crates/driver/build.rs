//! Records the commit the program is built from, where there is one.

// A build script speaks to cargo by printing.
#![allow(clippy::print_stdout, clippy::disallowed_macros)]

use std::path::Path;
use std::process::Command;

fn main() {
    let commit = git(&["describe", "--always", "--dirty", "--abbrev=12"]);
    if let Some(commit) = commit {
        println!("cargo:rustc-env=ASPERITY_COMMIT={commit}");
    }
    // A file that does not exist would have the crate compiled anew in every build; in a linked worktree `.git` is a file,
    // and without a repository there is none.
    println!("cargo:rerun-if-changed=build.rs");
    for name in ["HEAD", "logs/HEAD"] {
        if let Some(path) = git(&["rev-parse", "--git-path", name]).filter(|path| Path::new(path).exists()) {
            println!("cargo:rerun-if-changed={path}");
        }
    }
}

/// What git prints, without the end of the line; none where it fails or is not there.
fn git(arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").args(arguments).output().ok().filter(|o| o.status.success())?;
    Some(String::from_utf8(output.stdout).ok()?.trim().to_string())
}
