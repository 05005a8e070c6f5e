//! Cycles of folders: parts of a crate that use each other, although no two of their files do.

use super::cycle::{self, Circle};
use std::collections::{BTreeMap, BTreeSet};

/// Finds cycles among the parts of each folder of a crate. A part is a module with everything below it, so that
/// `foo.rs` and the files of `foo/` are one part. The file of the folder itself is none of its parts.
pub fn circles(folder: &str, paths: &[Vec<String>], edges: &[BTreeSet<usize>]) -> Vec<Circle> {
    let parents: BTreeSet<&[String]> =
        paths.iter().flat_map(|path| (0..path.len()).map(|depth| &path[..depth])).collect();
    parents.into_iter().flat_map(|parent| among_parts(folder, parent, paths, edges)).collect()
}

fn among_parts(
    folder: &str,
    parent: &[String],
    paths: &[Vec<String>],
    edges: &[BTreeSet<usize>],
) -> Vec<Circle> {
    let part = |path: &Vec<String>| path.strip_prefix(parent)?.first().cloned();
    let parts: Vec<String> = paths.iter().filter_map(part).collect::<BTreeSet<_>>().into_iter().collect();
    let number: BTreeMap<&String, usize> = parts.iter().enumerate().map(|(i, part)| (part, i)).collect();
    let mut between = vec![BTreeSet::new(); parts.len()];
    for (from, targets) in edges.iter().enumerate() {
        let Some(from) = part(&paths[from]) else { continue };
        let targets = targets.iter().filter_map(|&to| part(&paths[to])).filter(|to| *to != from);
        between[number[&from]].extend(targets.map(|to| number[&to]));
    }
    let name = |i: usize| parent.iter().chain([&parts[i]]).cloned().collect::<Vec<_>>().join("/");
    cycle::all(folder, &between, name)
}
