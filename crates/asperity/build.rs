//! Records the commit the program is built from, where there is one, and whether its sources had changed since.

// A build script speaks to cargo by printing.
#![allow(clippy::print_stdout, clippy::disallowed_macros)]

use std::path::Path;
use std::process::Command;

/// Sources of the program, relative to this package.
const SOURCES: [&str; 29] = [
    "src",
    "build.rs",
    "Cargo.toml",
    "../contact/src",
    "../contact/Cargo.toml",
    "../cycles/src",
    "../cycles/Cargo.toml",
    "../fem/src",
    "../fem/Cargo.toml",
    "../friction/src",
    "../friction/Cargo.toml",
    "../laws/src",
    "../laws/Cargo.toml",
    "../mechanics/src",
    "../mechanics/Cargo.toml",
    "../ode/src",
    "../ode/Cargo.toml",
    "../output/src",
    "../output/Cargo.toml",
    "../plan/src",
    "../plan/Cargo.toml",
    "../reference/src",
    "../reference/Cargo.toml",
    "../run/src",
    "../run/Cargo.toml",
    "../scene/src",
    "../scene/Cargo.toml",
    "../../Cargo.toml",
    "../../Cargo.lock",
];

fn main() {
    if let Some(commit) = git(&["rev-parse", "--short=12", "HEAD"]) {
        let changes = git(&[&["status", "--porcelain", "--"][..], &SOURCES].concat());
        let dirty = if changes.is_none_or(|c| c.is_empty()) { "" } else { "-dirty" };
        println!("cargo:rustc-env=ASPERITY_COMMIT={commit}{dirty}");
    }
    // What changes a source has the crate compiled anew in any case; what commits or takes back changes a reference or a source.
    for path in SOURCES {
        watch(Path::new(path));
    }
    let branch = git(&["symbolic-ref", "--quiet", "HEAD"]);
    for name in ["HEAD", "logs/HEAD"].into_iter().chain(branch.as_deref()) {
        if let Some(path) = git(&["rev-parse", "--git-path", name]) {
            watch(Path::new(&path));
        }
    }
}

/// A file that does not exist would have the crate compiled anew in every build; in a linked worktree `.git` is a file, and without a
/// repository there is none.
fn watch(path: &Path) {
    if path.exists() {
        println!("cargo:rerun-if-changed={}", path.display());
    }
}

/// Output of git, without the end of the line; none where it fails or is not there. It takes no lock that another git may want.
fn git(arguments: &[&str]) -> Option<String> {
    let git = Command::new("git").env("GIT_OPTIONAL_LOCKS", "0").args(arguments).output();
    let output = git.ok().filter(|o| o.status.success())?;
    Some(String::from_utf8(output.stdout).ok()?.trim().to_string())
}
