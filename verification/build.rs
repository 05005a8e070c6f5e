//! Records the compiler that the suite is built with.

// A build script speaks to cargo by printing.
#![allow(clippy::print_stdout)]

use std::process::Command;

fn main() {
    let compiler = std::env::var("RUSTC").unwrap_or_else(|_| "rustc".to_owned());
    let version = Command::new(compiler).arg("--version").output().ok();
    let version = version.and_then(|output| String::from_utf8(output.stdout).ok()).unwrap_or_default();
    println!("cargo:rustc-env=ASPERITY_COMPILER={}", version.trim());
    println!("cargo:rustc-env=ASPERITY_PROFILE={}", std::env::var("PROFILE").unwrap_or_default());
    println!("cargo:rerun-if-changed=build.rs");
}
