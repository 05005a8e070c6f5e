//! Checks of the community benchmarks: their files agree with each other, and no reference value changes.
#![allow(clippy::unwrap_used, reason = "tests")]

use asperity_reference::benchmark;
use asperity_verification::benchmarks::{ALL, pages};
use sha2::{Digest, Sha256};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// SHA-256 of the reference values of each version. A tagged version never changes: changed values need a new version.
const CHECKSUMS: [(&str, &str); 6] = [
    ("fault-bend/v1", "852adb823b205af22be11a2e3a4ec0751c2f56b6889390ad1ab427b0d696b1e3"),
    ("hertz/v1", "2846bfe3450c5ecb52e2645066b14b5e6f8ef229783f3f4bab2e0e38403dd0a0"),
    ("partial-slip/v1", "4a52d40f4c5058f84a789550838c8181a591f22d7c36bc975d1a680339e6a47f"),
    ("sandwich-state/v1", "b832702393e93085d800997083e9e23fa8381db1f094dec33ce5dcf763482791"),
    ("sandwich/v1", "3e19dc5bf58aa656d9aa90df6656f649547a70a2301e8116b30817f09dc31f68"),
    ("seas-bp1-quick/v1", "791b54898d7c8ed1a886b17d7300de9b094c1f94eab232f62cf5d6a45c5db7ec"),
];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/src/benchmarks")
}

#[test]
fn reference_values_are_those_of_their_version() {
    for (name, known) in CHECKSUMS {
        let bytes = fs::read(root().join(name).join("reference.json")).unwrap();
        let found: String = Sha256::digest(&bytes).iter().map(|b| format!("{b:02x}")).collect();
        assert_eq!(found, known, "{name} is published: give other values another version");
    }
}

#[test]
fn the_lists_of_benchmarks_agree() {
    let sums: BTreeSet<&str> = CHECKSUMS.iter().map(|row| row.0).collect();
    let made: BTreeSet<&str> = ALL.iter().map(|maker| maker.name).collect();
    let embedded: BTreeSet<&str> = benchmark::all().iter().map(|r| r.benchmark.as_str()).collect();
    let entries = fs::read_dir(root()).unwrap().map(|e| e.unwrap().path()).filter(|p| p.is_dir());
    let folders: BTreeSet<String> = entries
        .flat_map(|folder| {
            let name = folder.file_name().unwrap().to_str().unwrap().to_owned();
            let versions = fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name());
            versions.map(move |v| format!("{name}/{}", v.to_str().unwrap())).collect::<Vec<_>>()
        })
        .collect();
    assert_eq!(sums, made);
    assert_eq!(made, embedded);
    assert_eq!(made, folders.iter().map(String::as_str).collect());
}

#[test]
fn tables_templates_and_pages_follow_from_reference_values_and_results() {
    for maker in ALL {
        for file in pages::derived(&root().join(maker.name)).unwrap() {
            if std::env::var_os("UPDATE_TABLES").is_some() {
                fs::write(&file.path, &file.text).unwrap();
            }
            let found = fs::read_to_string(&file.path).unwrap_or_default();
            assert!(found == file.text, "UPDATE_TABLES=1 rewrites {}", file.path.display());
        }
    }
}

#[test]
fn a_page_has_the_parts_of_a_specification() {
    const PARTS: [&str; 8] = [
        "## Domain and material",
        "## Equations",
        "## Conditions",
        "## Quantities",
        "## Format of a result",
        "Report also",
        "## Reference values",
        "## Results",
    ];
    for maker in ALL {
        let folder = root().join(maker.name);
        let page = fs::read_to_string(folder.join("README.md")).unwrap();
        assert!(page.starts_with(&format!("# Benchmark {}\n", maker.name)), "{}", maker.name);
        for part in PARTS {
            assert!(page.contains(part), "{} has no {part}", maker.name);
        }
        assert!(page.contains(&format!("--benchmark {}\n", maker.name)), "{}", maker.name);
        let reference = benchmark::find(maker.name).unwrap();
        for quantity in &reference.quantities {
            assert!(
                page.matches(&format!("`{}`", quantity.name)).count() > 2,
                "{}: {}",
                maker.name,
                quantity.name
            );
        }
        assert!(folder.join("sketch.svg").is_file() && page.contains("(sketch.svg)"), "{}", maker.name);
    }
}
