//! Rules about dependencies, and about libraries that may exist in one version only.

use super::problem::Problem;
use crate::stage::Failure;
use cargo_metadata::{Metadata, MetadataCommand};
use std::collections::BTreeSet;
use std::path::Path;

/// Workspace packages on which each package may depend, including tests and build scripts.
const ALLOWED: [(&str, &[&str]); 17] = [
    ("asperity-friction", &[]),
    ("asperity-fem", &[]),
    ("asperity-ode", &[]),
    ("asperity-vary", &[]),
    ("asperity-run", &["asperity-ode"]),
    ("asperity-scene", &["asperity-run"]),
    ("asperity-output", &["asperity-run"]),
    ("asperity-contact", &["asperity-fem", "asperity-friction"]),
    ("asperity-mechanics", &["asperity-fem", "asperity-friction", "asperity-contact", "asperity-run"]),
    ("asperity-cycles", &["asperity-fem", "asperity-friction", "asperity-ode", "asperity-run"]),
    ("asperity-laws", &["asperity-friction", "asperity-scene"]),
    ("asperity-plan", BELOW_PLANS),
    ("asperity-reference", &["asperity-laws", "asperity-output", "asperity-plan", "asperity-scene"]),
    ("asperity", PROGRAMS),
    ("asperity-verification", PROGRAMS),
    ("asperity-benches", PROGRAMS),
    ("xtask", &[]),
];

/// Packages that plans are made with.
const BELOW_PLANS: &[&str] = &[
    "asperity-fem",
    "asperity-friction",
    "asperity-ode",
    "asperity-run",
    "asperity-scene",
    "asperity-output",
    "asperity-contact",
    "asperity-mechanics",
    "asperity-cycles",
    "asperity-laws",
];

/// Packages that programs may use.
const PROGRAMS: &[&str] = &[
    "asperity-fem",
    "asperity-friction",
    "asperity-ode",
    "asperity-run",
    "asperity-scene",
    "asperity-output",
    "asperity-contact",
    "asperity-mechanics",
    "asperity-cycles",
    "asperity-laws",
    "asperity-plan",
    "asperity-reference",
    "asperity",
    "asperity-vary",
];

/// Libraries that work only on values.
pub const LIBRARIES: [&str; 10] = [
    "asperity-friction",
    "asperity-fem",
    "asperity-ode",
    "asperity-run",
    "asperity-scene",
    "asperity-contact",
    "asperity-mechanics",
    "asperity-cycles",
    "asperity-laws",
    "asperity-vary",
];

/// Packages that a library of values does not need: terminals, pictures, scene files.
const NOT_IN_LIBRARIES: [&str; 5] = ["clap", "miette", "plotters", "indicatif", "toml"];

/// The library that reads scene files.
const READER: (&str, &str) = ("asperity-scene", "toml");

/// Libraries that one package hides from the others.
const BEHIND: [(&str, &str); 1] = [("diffsol", "asperity-ode")];

/// Libraries of which two versions would mean two matrix types.
const SINGLE: [&str; 2] = ["faer", "nalgebra"];

/// A dependency of one package on another, possibly for tests only.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Edge {
    from: String,
    to: String,
    manifest: String,
}

/// Checks the dependency graph and the lock file.
pub fn check(root: &Path) -> Result<Vec<Problem>, Failure> {
    let metadata = MetadataCommand::new().manifest_path(root.join("Cargo.toml")).no_deps().exec()?;
    let edges = edges(root, &metadata);
    let members: Vec<String> = metadata.workspace_packages().iter().map(|p| p.name.to_string()).collect();
    let path = root.join("Cargo.lock");
    let lock = std::fs::read_to_string(&path).map_err(|source| Failure::Read { path, source })?;
    let mut found = direction(&members, &edges);
    found.extend(libraries(&edges));
    found.extend(hidden(&edges));
    found.extend(single_versions(&lock));
    Ok(found)
}

fn edges(root: &Path, metadata: &Metadata) -> Vec<Edge> {
    let mut edges = Vec::new();
    for package in metadata.workspace_packages() {
        let manifest = package.manifest_path.as_std_path();
        let manifest = manifest.strip_prefix(root).unwrap_or(manifest).display().to_string();
        for dependency in &package.dependencies {
            let to = dependency.name.clone();
            edges.push(Edge { from: package.name.to_string(), to, manifest: manifest.clone() });
        }
    }
    edges
}

fn direction(members: &[String], edges: &[Edge]) -> Vec<Problem> {
    let mut found = Vec::new();
    for member in members.iter().filter(|member| !ALLOWED.iter().any(|(name, _)| name == member)) {
        let message =
            format!("package {member} has no place in the dependency direction (xtask, tidy/graph.rs)");
        found.push(Problem::new("Cargo.toml", 0, message));
    }
    for edge in edges.iter().filter(|edge| members.contains(&edge.to)) {
        let allowed =
            ALLOWED.iter().find(|(name, _)| *name == edge.from).map_or(&[][..], |(_, allowed)| allowed);
        if !allowed.contains(&edge.to.as_str()) {
            let message = format!("{} must not depend on {}", edge.from, edge.to);
            found.push(Problem::new(&edge.manifest, 0, message));
        }
    }
    found
}

fn libraries(edges: &[Edge]) -> Vec<Problem> {
    let of_library = edges.iter().filter(|edge| LIBRARIES.contains(&edge.from.as_str()));
    of_library
        .filter(|edge| NOT_IN_LIBRARIES.contains(&edge.to.as_str()))
        .filter(|edge| (edge.from.as_str(), edge.to.as_str()) != READER)
        .map(|edge| {
            let message = format!("{} works on values and must not depend on {}", edge.from, edge.to);
            Problem::new(&edge.manifest, 0, message)
        })
        .collect()
}

fn hidden(edges: &[Edge]) -> Vec<Problem> {
    let mut found = Vec::new();
    for (library, owner) in BEHIND {
        for edge in edges.iter().filter(|edge| edge.to == library && edge.from != owner) {
            let message = format!("{} must not depend on {library}: it is behind {owner}", edge.from);
            found.push(Problem::new(&edge.manifest, 0, message));
        }
    }
    found
}

fn single_versions(lock: &str) -> Vec<Problem> {
    let mut found = Vec::new();
    for name in SINGLE {
        let versions = versions(lock, name);
        if versions.len() > 1 {
            let list: Vec<&str> = versions.into_iter().collect();
            found.push(Problem::new(
                "Cargo.lock",
                0,
                format!("{name} exists in versions {}", list.join(", ")),
            ));
        }
    }
    found
}

/// Versions of one package in a lock file, whose entries have `name` followed by `version`.
fn versions<'a>(lock: &'a str, name: &str) -> BTreeSet<&'a str> {
    let wanted = format!("name = \"{name}\"");
    let lines: Vec<&str> = lock.lines().collect();
    let entries = lines.windows(2).filter(|pair| pair[0] == wanted);
    entries.filter_map(|pair| pair[1].strip_prefix("version = \"")?.strip_suffix('"')).collect()
}

#[cfg(test)]
mod tests {
    use super::{ALLOWED, Edge, direction, hidden, libraries, single_versions};

    fn edge(from: &str, to: &str) -> Edge {
        Edge { from: from.to_owned(), to: to.to_owned(), manifest: "Cargo.toml".to_owned() }
    }

    fn members() -> Vec<String> {
        ALLOWED.iter().map(|(name, _)| (*name).to_owned()).collect()
    }

    #[test]
    fn dependencies_against_the_direction_are_caught() {
        for (from, to) in [
            ("asperity-fem", "asperity-friction"),
            ("asperity-friction", "asperity-fem"),
            ("asperity-fem", "asperity-contact"),
            ("asperity-contact", "asperity-plan"),
            ("asperity-plan", "asperity"),
            ("asperity-ode", "asperity-friction"),
            ("asperity-fem", "asperity-ode"),
            ("asperity-output", "asperity-fem"),
            ("asperity-mechanics", "asperity-output"),
            ("asperity-contact", "asperity-mechanics"),
            ("asperity-cycles", "asperity-mechanics"),
            ("asperity-cycles", "asperity-scene"),
            ("asperity-mechanics", "asperity-cycles"),
            ("asperity", "asperity-verification"),
            ("asperity-plan", "asperity-reference"),
            ("asperity-run", "asperity-scene"),
            ("xtask", "asperity-fem"),
        ] {
            assert_eq!(direction(&members(), &[edge(from, to)]).len(), 1, "{from} -> {to}");
        }
        let fine = [edge("asperity-contact", "asperity-fem"), edge("asperity-fem", "faer")];
        assert_eq!(direction(&members(), &fine), []);
    }

    #[test]
    fn a_package_without_a_place_is_caught() {
        assert_eq!(direction(&["asperity-new".to_owned()], &[]).len(), 1);
    }

    #[test]
    fn terminals_and_pictures_in_a_library_are_caught() {
        assert_eq!(libraries(&[edge("asperity-fem", "plotters"), edge("asperity", "plotters")]).len(), 1);
        assert_eq!(libraries(&[edge("asperity-friction", "clap")]).len(), 1);
    }

    #[test]
    fn a_hidden_library_is_caught_outside_its_package() {
        let edges = [edge("asperity-ode", "diffsol"), edge("asperity", "diffsol")];
        assert_eq!(hidden(&edges), hidden(&edges[1..]));
        assert_eq!(hidden(&edges).len(), 1);
    }

    #[test]
    fn a_second_version_of_a_matrix_library_is_caught() {
        let one = "[[package]]\nname = \"faer\"\nversion = \"0.24.4\"\n";
        assert_eq!(single_versions(one), []);
        let two = format!("{one}\n[[package]]\nname = \"faer\"\nversion = \"0.23.0\"\n");
        assert!(single_versions(&two)[0].message.contains("0.23.0, 0.24.4"));
    }
}
